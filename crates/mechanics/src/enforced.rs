//! Enforcement of the constraints of interfaces, in SI, and the unknowns that it adds to the system.

use asperity_contact::Enforcement;

/// Enforcement of the constraints of an interface.
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
