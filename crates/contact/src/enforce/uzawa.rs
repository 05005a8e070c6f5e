//! Multipliers, and their update between solutions.
//!
//! With multipliers λ_n and λ_t the normal tractions are `f_n = <λ_n - E_n g_n>`, and the tangential ones are those of the
//! friction law at the trial `t^e = λ_t + E_t Δu`. If `λ_n = f_n` and `λ_t = t`, the gap of a closed point is zero, and so is
//! `E_t (Δu - Δλ) = t - λ_t`: slip is the whole tangential motion, whatever the penalties. At the start of a step the
//! multipliers are the committed tractions. Without augmentation the step is thus a penalty step about a state that violates no
//! constraint.
//!
//! Simo, J. C. and Laursen, T. A. (1992), An augmented Lagrangian treatment of contact problems involving friction,
//! Computers and Structures 42, 97-116.

use crate::spec::Enforcement;

/// Multipliers of all points.
#[derive(Clone, Debug)]
pub(crate) struct Multipliers {
    /// Largest violation \[m\] and most augmentations per step, if the multipliers are updated between solutions.
    pub moved: Option<(f64, usize)>,
    /// λ_n \[Pa\].
    pub normal: Vec<f64>,
    /// λ_t \[Pa\], components in the carried frame; empty without a law.
    pub shear: Vec<[f64; 2]>,
}

impl Multipliers {
    pub(crate) fn from_enforcement(enforcement: &Enforcement, points: usize) -> Option<Self> {
        let moved = match *enforcement {
            Enforcement::Penalty => return None,
            Enforcement::Uzawa { tolerance, most } => Some((tolerance, most)),
            Enforcement::AugmentedLagrangian { .. } => None,
        };
        Some(Self { moved, normal: vec![0.0; points], shear: Vec::new() })
    }
}

/// λ_t, if there are multipliers.
pub(crate) fn tangential(multipliers: Option<&Multipliers>) -> Option<&[[f64; 2]]> {
    multipliers.map(|m| m.shear.as_slice())
}
