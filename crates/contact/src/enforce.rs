//! Enforcement of the contact constraint: normal traction from gap.

use crate::measure::NormalPoint;

/// Penalty: `f_n = E_n <-g_n>`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penalty {
    /// Normal penalty E_n \[Pa/m\].
    pub stiffness: f64,
    /// Gaps up to this one count as closed, with f_n = 0, so that their stiffness is present \[m\].
    pub closure: f64,
}

impl Penalty {
    /// Normal tractions of all points from their gaps \[m\].
    pub fn enforce(&self, gap: &[f64], out: &mut [NormalPoint]) {
        for (g, o) in gap.iter().zip(out) {
            let closed = *g <= self.closure;
            *o = NormalPoint {
                closed,
                traction: if closed { self.stiffness * (-g).max(0.0) } else { 0.0 },
                stiffness: if closed { self.stiffness } else { 0.0 },
            };
        }
    }
}
