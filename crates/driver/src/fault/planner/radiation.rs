//! Radiation damping that is missing where friction weakens.

use super::checks::weakens;
use super::placed::Placed;
use crate::scene::model::{Fault as Spec, Scene, Stepper};
use crate::warning::Warning;

/// A warning for each fault in equilibrium whose friction weakens at points without damping. With inertia, bodies radiate waves by themselves.
pub(super) fn missing<const D: usize>(scene: &Scene, placed: &[Placed<D>]) -> Vec<Warning> {
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
                     bound, and the run ends"
                ),
                "add `damping = \"radiation\"` to the fault, and a `density` to its rock",
            )
        })
    };
    scene.faults.iter().enumerate().filter_map(of).collect()
}
