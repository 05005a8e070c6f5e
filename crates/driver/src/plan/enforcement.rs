//! The enforcement that a scene declares, in SI.

use crate::scene::model::{Enforcement as Spec, EnforcementKind, Spanned};
use crate::scene::units::{Penalty, Penetration};
use asperity_mechanics::Enforced;

/// Augmentations a step may take where the scene does not say. At 1 E/h each leaves a third to a half of the penetration, at
/// 100 E/h a hundredth; more than so many mean that the penalty is too small for the method.
const AUGMENTATIONS: usize = 40;

/// Declaration of a scene for a slave body of this modulus over element size \[Pa/m\] and element size \[m\].
#[must_use]
pub fn enforced(spec: &Spec, young_per_size: f64, size: f64) -> Enforced {
    match *spec.kind.get_ref() {
        EnforcementKind::Penalty => Enforced::Penalty,
        EnforcementKind::AugmentedLagrangian => Enforced::AugmentedLagrangian { unit: young_per_size },
        EnforcementKind::Uzawa => Enforced::Uzawa {
            // The check of the scene has seen that it is there.
            tolerance: spec.penetration.as_ref().map_or(0.0, |p| match *p.get_ref() {
                Penetration::Value(value) => value,
                Penetration::Sizes(factor) => factor * size,
            }),
            most: spec.augmentations.as_ref().map_or(AUGMENTATIONS, |m| *m.get_ref()),
        },
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
