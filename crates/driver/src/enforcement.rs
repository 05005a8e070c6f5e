//! How interfaces enforce their constraints, in SI, and what that adds to the system.

use crate::scene::model::{Enforcement as Spec, EnforcementKind, Spanned};
use crate::scene::units::{Penalty, Penetration};
use asperity_contact::Enforcement;

/// Augmentations a step may take where the scene does not say. At 1 E/h each leaves a third to a half of the penetration, at
/// 100 E/h a hundredth; more than so many mean that the penalty is too small for the method.
const AUGMENTATIONS: usize = 40;

/// How an interface enforces its constraints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Enforced {
    /// A penalty.
    Penalty,
    /// Multipliers that move between solutions.
    Uzawa {
        /// Largest penetration \[m\].
        tolerance: f64,
        /// Augmentations a step may take.
        most: usize,
    },
    /// Multipliers as unknowns.
    AugmentedLagrangian {
        /// Young's modulus over element size of the slave body \[Pa/m\].
        unit: f64,
    },
}

impl Enforced {
    /// What a scene declares for a slave body of this modulus over element size \[Pa/m\] and element size \[m\].
    #[must_use]
    pub fn new(spec: &Spec, young_per_size: f64, size: f64) -> Self {
        match *spec.kind.get_ref() {
            EnforcementKind::Penalty => Self::Penalty,
            EnforcementKind::AugmentedLagrangian => Self::AugmentedLagrangian { unit: young_per_size },
            EnforcementKind::Uzawa => Self::Uzawa {
                // The check of the scene has seen that it is there.
                tolerance: spec.penetration.as_ref().map_or(0.0, |p| match *p.get_ref() {
                    Penetration::Value(value) => value,
                    Penetration::Sizes(factor) => factor * size,
                }),
                most: spec.augmentations.as_ref().map_or(AUGMENTATIONS, |m| *m.get_ref()),
            },
        }
    }

    /// Unknowns beside the displacements, of `points` slave points with so many tractions each.
    #[must_use]
    pub fn unknowns(self, points: usize, tractions: usize) -> usize {
        if matches!(self, Self::AugmentedLagrangian { .. }) { points * tractions } else { 0 }
    }

    /// For the contact crate; unknowns are numbered from `first`.
    #[must_use]
    pub fn declared(self, first: usize) -> Enforcement {
        match self {
            Self::Penalty => Enforcement::Penalty,
            Self::Uzawa { tolerance, most } => Enforcement::Uzawa { tolerance, most },
            Self::AugmentedLagrangian { unit } => Enforcement::AugmentedLagrangian { first, unit },
        }
    }
}

/// A penalty \[Pa/m\].
#[must_use]
pub fn in_pascal_per_metre(penalty: &Spanned<Penalty>, young_per_size: f64) -> f64 {
    match *penalty.get_ref() {
        Penalty::Value(value) => value,
        Penalty::YoungPerSize(factor) => factor * young_per_size,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_multipliers_that_are_unknowns_add_to_the_system() {
        let unit = 1e9;
        assert_eq!(Enforced::Penalty.unknowns(7, 3), 0);
        assert_eq!(Enforced::Uzawa { tolerance: 1e-9, most: 3 }.unknowns(7, 3), 0);
        assert_eq!(Enforced::AugmentedLagrangian { unit }.unknowns(7, 3), 21);
        let declared = Enforced::AugmentedLagrangian { unit }.declared(40);
        assert_eq!(declared, Enforcement::AugmentedLagrangian { first: 40, unit });
    }
}
