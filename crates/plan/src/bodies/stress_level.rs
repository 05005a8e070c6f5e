//! Check that bodies lie below the level of their lithostatic stress.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{InitialStress, Scene, Spanned, StressKind};
use crate::shared::initial_stress::vertical;
use crate::shared::model::{Model, bounds};
use asperity_scene::lengths::brief;

/// Height above the level of a lithostatic stress that counts as rounding, relative to the size of the scene.
const ROUNDING: f64 = 1e-9;

/// Refuses bodies that reach above the level of their lithostatic stress, where the stress would be tensile.
///
/// # Errors
/// [`Diagnostic`] at the level.
pub fn check<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<(), Diagnostic> {
    for body in &model.bodies {
        let spec = &scene.bodies[&body.name];
        let Some(InitialStress::Varying(stress)) = spec.initial_stress.as_ref().map(Spanned::get_ref) else {
            continue;
        };
        let (Some((axis, acceleration)), Some(level)) = (vertical(scene, spec), &stress.level) else {
            continue;
        };
        if *stress.kind.get_ref() != StressKind::Lithostatic {
            continue;
        }
        let (min, max) = bounds(&model.mesh.nodes[body.nodes.clone()]);
        let highest =
            if acceleration < 0.0 { max[axis] - level.get_ref().0 } else { level.get_ref().0 - min[axis] };
        if highest > ROUNDING * model.scale {
            return Err(Diagnostic::at(
                level.span(),
                format!(
                    "body `{}` reaches {} above the `level` of its lithostatic stress",
                    body.name,
                    brief(highest)
                ),
                "the level is the height at which the vertical stress is the overburden: the upper side of the body, or higher",
            ));
        }
    }
    Ok(())
}
