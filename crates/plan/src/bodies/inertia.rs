//! Inertia of the bodies of a scene.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Scene, Stepper};
use crate::shared::entry::Entry;
use crate::shared::model::{self, Model};
use crate::shared::{handover, impedance};
use asperity_mechanics::{Handover, Mass};
use asperity_scene::defaults;

/// Inertia of the bodies; `None` if the scene declares none. `loading` is the largest rate of the loads \[m/s\].
///
/// # Errors
/// [`Diagnostic`] for a material without density, and for loads as fast as the slip rate at which bodies gain inertia.
pub fn mass<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    loading: f64,
) -> Result<Option<Mass>, Diagnostic> {
    let Some(settings) = scene.inertia() else { return Ok(None) };
    let mut density = vec![0.0; model.mesh.blocks.len()];
    let mut velocity = vec![0.0; model.dofs()];
    for body in &model.bodies {
        let spec = &scene.bodies[&body.name];
        for block in body.blocks.clone() {
            let (name, material) = model::material(&model.mesh, scene, Entry::new(&body.name, spec), block)?;
            let stated = material.density.as_ref().map(|d| d.get_ref().0);
            density[block] = stated.ok_or_else(|| {
                let message =
                    format!("body `{}` has inertia, and its material `{name}` has no density", body.name);
                Diagnostic::at(
                    spec.material.span(),
                    message,
                    "add `density = \"2700 kg/m^3\"` to the material",
                )
            })?;
        }
        let given = spec.velocity.iter().flat_map(|v| v.get_ref()).map(|v| v.0);
        let given: Vec<f64> = given.collect();
        let dofs = velocity[body.dofs.clone()].chunks_exact_mut(model.idealisation.components());
        dofs.filter(|_| !given.is_empty()).for_each(|node| node.copy_from_slice(&given));
    }
    let handover = match *scene.time.stepper.get_ref() {
        Stepper::Auto => {
            let handover::Bounds { above, below, kinetic } = handover::bounds(scene, loading)?;
            let wait = 2.0 * model.scale / impedance::slowest(model, &density);
            Some(Handover { above, below, kinetic, wait })
        }
        _ => None,
    };
    Ok(Some(Mass {
        density,
        velocity,
        radius: settings.spectral_radius.map_or(defaults::SPECTRAL_RADIUS, |r| *r.get_ref()),
        tolerance: settings.tolerance.map_or(defaults::INERTIA_TOLERANCE, |t| *t.get_ref()),
        handover,
    }))
}
