//! Enforcement of the contact constraint: normal traction from the gap by a penalty, optionally about multipliers.

mod unknowns;
mod uzawa;

use crate::measure::NormalPoint;
pub(crate) use unknowns::{Buffers, REGULAR, Unknowns};
pub(crate) use uzawa::{Multipliers, tangential};

/// Penalty: `f_n = E_n <-g_n>`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penalty {
    /// Normal penalty E_n \[Pa/m\].
    pub stiffness: f64,
    /// Gaps up to this value count as closed with f_n = 0, so that their stiffness enters the tangent \[m\].
    pub closure: f64,
}

impl Penalty {
    /// Computes the normal tractions of all points from their gaps \[m\].
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

    /// Computes the normal tractions about multipliers λ \[Pa\]: `f_n = <λ - E_n g_n>`.
    pub fn augmented(&self, gap: &[f64], multiplier: &[f64], out: &mut [NormalPoint]) {
        for ((g, l), o) in gap.iter().zip(multiplier).zip(out) {
            let push = l - self.stiffness * g;
            let closed = push >= -self.stiffness * self.closure;
            *o = NormalPoint {
                closed,
                traction: if closed { push.max(0.0) } else { 0.0 },
                stiffness: if closed { self.stiffness } else { 0.0 },
            };
        }
    }

    /// Computes the normal tractions of bonded points: `f_n = λ - E_n (g_n - g_0)` of either sign, by the partings of both gaps
    /// ([`crate::measure::Measure::partings`]). g_0 belongs to the gap at which a point was tied; it is infinite for points without
    /// a partner, which are free.
    pub fn bonded(&self, parted: &[f64], tied: &[f64], multiplier: Option<&[f64]>, out: &mut [NormalPoint]) {
        for (p, ((g, g0), o)) in parted.iter().zip(tied).zip(out).enumerate() {
            *o = if g0.is_finite() {
                let multiplier = multiplier.map_or(0.0, |m| m[p]);
                let traction = multiplier - self.stiffness * (g - g0);
                NormalPoint { closed: true, traction, stiffness: self.stiffness }
            } else {
                NormalPoint::default()
            };
        }
    }
}
