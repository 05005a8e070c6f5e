//! Shear traction imposed on a fault, smooth in space and time.

/// Traction `Δτ(x, t) = amplitude(x) G(t)` with the smooth step G of the community's benchmarks: `G = exp((t - T)²/(t (t - 2T)))` for 0 < t < T,
/// then 1. It is part of what loads the fault, like the initial traction.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// Amplitude at each point, by components \[Pa\].
    pub amplitude: Vec<f64>,
    /// T \[s\].
    pub rise: f64,
}

impl Pulse {
    /// G(t) \[-\].
    #[must_use]
    pub fn growth(&self, time: f64) -> f64 {
        let rise = self.rise;
        if time <= 0.0 {
            0.0
        } else if time < rise {
            ((time - rise).powi(2) / (time * (time - 2.0 * rise))).exp()
        } else {
            1.0
        }
    }
}
