//! Damping that is far from that of radiation, or missing where friction weakens.

use super::checks::weakens;
use super::placed_point::PlacedPoint;
use crate::reading::scene::model::{DampingSpec, Fault as Spec, Scene, Stepper};
use asperity_run::Warning;

/// Warnings about damping that no rock has, and about damping that is missing.
pub(super) fn doubts<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Vec<Warning> {
    let of = |(k, (name, spec)): (usize, (&String, &Spec))| {
        let given = spec.damping.as_ref()?;
        let DampingSpec::Value(value) = *given.get_ref() else { return None };
        let radiated = placed.iter().filter(|p| p.fault == k).map(|p| p.medium.radiation);
        crate::doubts::damping(&format!("fault `{name}`"), given.span(), value, radiated)
    };
    let far = scene.faults.iter().enumerate().filter_map(of);
    far.chain(missing(scene, placed)).collect()
}

/// A warning for each fault in equilibrium whose friction weakens at points without damping. With inertia, bodies radiate waves by themselves.
fn missing<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Vec<Warning> {
    if *scene.time.stepper.get_ref() != Stepper::FaultOde {
        return Vec::new();
    }
    let of = |(k, (name, spec)): (usize, (&String, &Spec))| {
        let bare = placed.iter().filter(|p| p.fault == k && p.damping == 0.0 && weakens(p)).count();
        (bare > 0).then(|| {
            Warning::at(
                spec.law.span(),
                format!(
                    "friction of fault `{name}` weakens at {bare} points, and nothing is radiated there: in an instability slip rates grow without \
                     bound, and the run stops where one reaches the speed of shear waves"
                ),
                "add `damping = \"radiation\"` to the fault, and a `density` to its rock",
            )
        })
    };
    scene.faults.iter().enumerate().filter_map(of).collect()
}
