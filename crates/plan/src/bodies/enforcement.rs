//! Contact enforcement declared in a scene, in SI units.

use crate::reading::scene::model::{Enforcement as Spec, EnforcementKind, Spanned};
use crate::reading::scene::units::{Penalty, Penetration};
use asperity_mechanics::PlannedEnforcement;
use asperity_scene::defaults;

/// Enforcement for a slave body with this ratio of Young's modulus to element size \[Pa/m\] and this element size
/// \[m\].
#[must_use]
pub fn enforced(spec: &Spec, young_per_size: f64, size: f64) -> PlannedEnforcement {
    match *spec.kind.get_ref() {
        EnforcementKind::Penalty => PlannedEnforcement::Penalty,
        EnforcementKind::AugmentedLagrangian => {
            PlannedEnforcement::AugmentedLagrangian { unit: young_per_size }
        }
        EnforcementKind::Uzawa => PlannedEnforcement::Uzawa {
            // The scene check ensures that it is given.
            tolerance: spec.penetration.as_ref().map_or(0.0, |p| match *p.get_ref() {
                Penetration::Value(value) => value,
                Penetration::Sizes(factor) => factor * size,
            }),
            most: spec.augmentations.as_ref().map_or(defaults::AUGMENTATIONS, |m| *m.get_ref()),
        },
    }
}

/// Value of a penalty \[Pa/m\].
#[must_use]
pub fn in_pascal_per_metre(penalty: &Spanned<Penalty>, young_per_size: f64) -> f64 {
    match *penalty.get_ref() {
        Penalty::Value(value) => value,
        Penalty::YoungPerSize(factor) => factor * young_per_size,
    }
}
