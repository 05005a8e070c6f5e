//! Plane waves in metal with linear hardening, in uniaxial strain (Wood 1952).

/// Density \[kg/m³\].
pub const DENSITY: f64 = 8000.0;
/// Bulk modulus \[Pa\].
const BULK: f64 = 200e9 / (3.0 * (1.0 - 2.0 * 0.25));
/// Shear modulus \[Pa\].
const SHEAR: f64 = 200e9 / (2.0 * (1.0 + 0.25));
/// Slope of the yield stress \[Pa\].
pub const HARDENING: f64 = 20e9;
/// Yield stress \[Pa\].
pub const YIELD: f64 = 200e6;

/// Speeds of both fronts and the states behind them, where the end of a bar moves at a given speed.
pub struct Wave {
    /// Speed below yield \[m/s\].
    pub elastic: f64,
    /// Speed above yield \[m/s\].
    pub plastic: f64,
    /// Stress \[Pa\] and velocity \[m/s\] behind the precursor.
    pub limit: (f64, f64),
    /// Stress behind the plastic front \[Pa\].
    pub stress: f64,
    /// Plastic strain there.
    pub strain: f64,
}

impl Wave {
    /// Waves from an end that moves at this speed \[m/s\], above the one at yield.
    pub fn new(end: f64) -> Wave {
        let speed = |modulus: f64| (modulus / DENSITY).sqrt();
        let elastic = speed(BULK + 4.0 / 3.0 * SHEAR);
        let plastic = speed(BULK + 4.0 * SHEAR * HARDENING / (3.0 * (3.0 * SHEAR + HARDENING)));
        let yielding = YIELD / (2.0 * SHEAR);
        let limit = (DENSITY * elastic * elastic * yielding, elastic * yielding);
        let beyond = (end - limit.1) / plastic;
        Wave {
            elastic,
            plastic,
            limit,
            stress: limit.0 + DENSITY * plastic * (end - limit.1),
            strain: 2.0 * SHEAR * beyond / (3.0 * SHEAR + HARDENING),
        }
    }

    /// Plastic work per volume behind the plastic front \[J/m³\].
    pub fn work(&self) -> f64 {
        (YIELD + 0.5 * HARDENING * self.strain) * self.strain
    }
}
