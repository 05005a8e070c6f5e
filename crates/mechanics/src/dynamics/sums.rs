//! Sums over nodes, for the energy.

/// Sums over nodes, for the energy.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    /// f·v before and after.
    pub internal: [f64; 2],
    /// v·M v of both half steps.
    pub kinetic: f64,
    /// u·f.
    pub elastic: f64,
    /// v·M v of the half step after.
    pub moving: f64,
    /// Powers of loads before and after.
    pub loads: [f64; 2],
    /// Powers of prescribed motions before and after.
    pub motions: [f64; 2],
    /// Powers that dashpots absorb, before and after.
    pub absorbed: [f64; 2],
}

impl Sums {
    pub fn plus(self, other: Self) -> Self {
        let both = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        Self {
            internal: both(self.internal, other.internal),
            kinetic: self.kinetic + other.kinetic,
            elastic: self.elastic + other.elastic,
            moving: self.moving + other.moving,
            loads: both(self.loads, other.loads),
            motions: both(self.motions, other.motions),
            absorbed: both(self.absorbed, other.absorbed),
        }
    }
}
