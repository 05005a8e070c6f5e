//! Shear traction imposed on a fault, smooth in space and time.

use asperity_fem::table::smooth_step;

/// Traction `Δτ(x, t) = amplitude(x) G(t)` with the smooth step G, see [`smooth_step`]. It is part of what loads the fault, like the initial
/// traction.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// Amplitude at each point, by components \[Pa\].
    pub amplitude: Vec<f64>,
    /// Duration of the growth \[s\].
    pub rise: f64,
}

impl Pulse {
    /// G(t) \[-\].
    #[must_use]
    pub fn growth(&self, time: f64) -> f64 {
        smooth_step(time, self.rise).0
    }
}
