//! Enforcement of the constraints of interfaces, in SI units, and the unknowns that it adds to the system.

use asperity_contact::Enforcement;

/// Enforcement of the constraints of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlannedEnforcement {
    /// Penalty.
    Penalty,
    /// Multipliers that are updated between solutions.
    Uzawa {
        /// Largest admissible penetration \[m\].
        tolerance: f64,
        /// Most augmentations per step.
        most: usize,
    },
    /// Multipliers that are unknowns of the system.
    AugmentedLagrangian {
        /// Young's modulus over element size of the slave body \[Pa/m\].
        unit: f64,
    },
}

impl PlannedEnforcement {
    /// Number of unknowns in addition to the displacements, for `points` slave points with `tractions` tractions each.
    #[must_use]
    pub fn unknowns(self, points: usize, tractions: usize) -> usize {
        if matches!(self, Self::AugmentedLagrangian { .. }) { points * tractions } else { 0 }
    }

    /// Enforcement in the form of the contact crate. Unknowns are numbered from `first`.
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
        assert_eq!(PlannedEnforcement::Penalty.unknowns(7, 3), 0);
        assert_eq!(PlannedEnforcement::Uzawa { tolerance: 1e-9, most: 3 }.unknowns(7, 3), 0);
        assert_eq!(PlannedEnforcement::AugmentedLagrangian { unit }.unknowns(7, 3), 21);
        let declared = PlannedEnforcement::AugmentedLagrangian { unit }.declared(40);
        assert_eq!(declared, Enforcement::AugmentedLagrangian { first: 40, unit });
    }
}
