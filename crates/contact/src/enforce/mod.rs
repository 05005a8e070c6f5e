//! Enforcement of the contact constraint: normal traction from gap, by a penalty, and multipliers about which the penalty
//! acts.

mod unknown;
mod uzawa;

use crate::measure::NormalPoint;
pub(crate) use unknown::{Buffers, REGULAR, Unknowns};
pub(crate) use uzawa::{Multipliers, tangential};

/// Methods that bring gaps and slips to zero where they should be.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Enforcement {
    /// Tractions proportional to the penetration and to the elastic part of the tangential motion.
    #[default]
    Penalty,
    /// Tractions of that kind about multipliers, which become the tractions found until these change no more (Uzawa's
    /// method; Hestenes 1969, Powell 1969; with friction Simo and Laursen 1992).
    Uzawa {
        /// Largest penetration, and largest elastic part of the tangential motion of a step \[m\].
        tolerance: f64,
        /// Augmentations a step may take.
        most: usize,
    },
    /// Multipliers that are unknowns of the system (Alart and Curnier 1991): the constraints hold to rounding, and the
    /// penalties only tell on which side of a kink an iterate is.
    AugmentedLagrangian {
        /// First of the unknowns' degrees of freedom: one a slave point, or as many as there are dimensions with a law, one
        /// point after another.
        first: usize,
        /// Stiffness that makes a traction a length of the size of displacements: Young's modulus over the size of elements
        /// \[Pa/m\].
        unit: f64,
    },
}

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

    /// The same about multipliers λ \[Pa\]: `f_n = <λ - E_n g_n>`.
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

    /// Bonded points: `f_n = λ - E_n (g_n - g_0)` of either sign, g_0 the gap they were tied at \[m\], infinite where a point has
    /// no partner and is free.
    pub fn bonded(&self, gap: &[f64], tied: &[f64], multiplier: Option<&[f64]>, out: &mut [NormalPoint]) {
        for (p, ((g, g0), o)) in gap.iter().zip(tied).zip(out).enumerate() {
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
