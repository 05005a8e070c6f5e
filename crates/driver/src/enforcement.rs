//! How interfaces enforce their constraints, in SI, and what that adds to the system.

use crate::plan::PlannedInterface;
use crate::scene::check::brief;
use crate::scene::model::{Enforcement as Spec, EnforcementKind, Spanned};
use crate::scene::units::{Penalty, Penetration};
use crate::warning::Warning;
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

/// Penalty over Young's modulus and element size below which the interface is softer than the row of cells beside it: it yields as a layer of
/// the material would whose thickness is the element size over this factor.
const SOFT: f64 = 1.0;

/// Penalty over Young's modulus and element size above which rounding shows: positions are known to 1e-16 of the size of the scene, some
/// hundred elements, so that tractions have an error of 1e-14 times this factor, in Young's moduli. Here that is a hundredth of a MPa
/// in rock, and equations lose as many of their sixteen digits.
const STIFF: f64 = 1e7;

/// Penalties of an interface that are far from E/h.
#[must_use]
pub fn doubts(name: &str, spec: &Spec, young_per_size: f64, size: f64) -> Vec<Warning> {
    let keys = [("normal", Some(&spec.normal)), ("tangential", spec.tangential.as_ref())];
    let given = keys.into_iter().filter_map(|(key, penalty)| Some((key, penalty?)));
    given.filter_map(|(key, penalty)| doubt(name, (key, penalty), young_per_size, size)).collect()
}

fn doubt(
    name: &str,
    (key, penalty): (&str, &Spanned<Penalty>),
    young_per_size: f64,
    size: f64,
) -> Option<Warning> {
    let value = in_pascal_per_metre(penalty, young_per_size);
    let factor = value / young_per_size;
    let message = if factor < SOFT {
        format!(
            "the {key} penalty of interface `{name}` is {value:.3e} Pa/m, {factor:.1e} E/h of its slave body: it yields like a layer of {} of the \
             material",
            brief(size / factor)
        )
    } else if factor > STIFF {
        format!(
            "the {key} penalty of interface `{name}` is {value:.3e} Pa/m, {factor:.1e} E/h of its slave body: rounding of positions shows in the \
             tractions, and steps may not converge"
        )
    } else {
        return None;
    };
    let help = format!(
        "E/h is {young_per_size:.3e} Pa/m here, and from 10 to 1000 E/h are good values, such as `{key} = \"100 E/h\"`; is the unit right?"
    );
    Some(Warning::at(penalty.span(), message, help))
}

/// The enforcement of an interface in words.
#[must_use]
pub fn in_words(interface: &PlannedInterface) -> String {
    let kind = if interface.law.as_ref().is_some_and(|l| l.bonded()) { "tied" } else { "contact" };
    match interface.enforced {
        Enforced::Penalty => format!("penalty {kind}"),
        Enforced::Uzawa { tolerance, most } => format!(
            "{kind} by Uzawa's method to a penetration of {tolerance:.2e} m in at most {most} augmentations a step"
        ),
        Enforced::AugmentedLagrangian { .. } => {
            format!("{kind} by {} multipliers as unknowns (augmented Lagrangian)", interface.unknowns)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::model::here;

    #[test]
    fn penalties_far_from_the_stiffness_of_a_cell_are_doubtful() {
        let told = |factor: f64| {
            let spec = Spec {
                kind: here(EnforcementKind::Penalty),
                normal: here(Penalty::YoungPerSize(factor)),
                tangential: None,
                penetration: None,
                augmentations: None,
            };
            doubts("fault", &spec, 1e12, 1e-2).into_iter().map(|w| w.message).collect::<Vec<_>>()
        };
        assert!(told(1.0).is_empty() && told(1e7).is_empty());
        assert!(told(0.01)[0].contains("like a layer of 1 m of the material"), "{:?}", told(0.01));
        assert!(told(1e9)[0].contains("rounding"));
    }

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
