//! Checks of a plan of bodies and interfaces.

use super::PlannedInterface;
use super::cohesive::{self, pressed};
use crate::checks::{Checks, Cost, InterfaceCheck, MachineCheck, WeakeningCheck, rates};
use crate::diagnostic::Diagnostic;
use crate::fault::{Coarsest, critical_slope, spacings};
use crate::laws;
use crate::loading::Stage;
use crate::model::checks::{Driven, body_name, field_bytes, machines};
use crate::model::{self, Model};
use crate::scene::model::{Interface as Spec, Scene};
use asperity_fem::mesh::Side;
use asperity_fem::surface;
use asperity_mechanics::solver::Solver;

/// Values of the fields of bodies at a node (displacement and Mises stress) and in a cell (stress, Mises stress and the body).
const VALUES: [usize; 2] = [3 + 1, 6 + 2];

/// Checks of a plan.
///
/// # Errors
/// [`Diagnostic`] at a set without faces.
pub(super) fn of<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    (interfaces, stages): (&[PlannedInterface], &[Stage]),
    (memory_bytes, solver): (usize, &Solver),
) -> Result<Checks, Diagnostic> {
    let mut checks = model::checks::of(scene, model)?;
    let surfaces: Vec<Driven> =
        interfaces.iter().map(|i| driven(scene, model, i)).collect::<Result<_, _>>()?;
    let machines = stages.last().map_or_else(Vec::new, |stage| machines(stage, &surfaces));
    for (k, planned) in interfaces.iter().enumerate() {
        let spec = &scene.interfaces[&planned.name];
        let normal = pressed(scene, model, stages, (&planned.name, spec)).filter(|normal| *normal > 0.0);
        let sides = model::sides(model, &spec.slave)?;
        checks.interfaces.push(InterfaceCheck {
            interface: planned.name.clone(),
            points: planned.slave.len(),
            faces: [planned.slave_faces.len(), planned.master_faces.len()],
            area: surfaces[k].area,
            damping: planned.damping,
            weakening: weakening(model, (spec, sides), normal),
            machine: machines.get(k).copied().flatten().map(|k| machine(k, spec, normal)),
        });
    }
    let fields = scene.output.fields.as_ref().map_or(1, |n| *n.get_ref()) * stages.len();
    checks.cost = Cost {
        memory_bytes: Some(memory_bytes),
        steps: stages.iter().map(|s| s.steps).sum(),
        step_seconds: solver.operations.map(rates::of_bodies),
        fields: Some(fields),
        field_bytes: Some(field_bytes(model, VALUES)),
        profiles: Some(scene.output.profiles.as_ref().map_or(10, |n| *n.get_ref()) * stages.len()),
        ..Cost::default()
    };
    Ok(checks)
}

/// The surface of an interface, as springs see it.
fn driven<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    planned: &PlannedInterface,
) -> Result<Driven, Diagnostic> {
    let spec = &scene.interfaces[&planned.name];
    let rubs = planned.law.as_ref().is_some_and(|law| !law.bonded());
    let sides = model::sides(model, &spec.slave)?;
    let area: f64 = surface::areas(&model.mesh, sides, model.idealisation).values().sum();
    let mut sum = [0.0; 3];
    // In antiplane motion every axis of motion lies in the surface.
    if model.idealisation.components() == D {
        let normals = surface::integrate(&model.mesh, sides, model.idealisation, |p, v| {
            v[..D].copy_from_slice(&p.normal);
        });
        normals.into_iter().for_each(|(dof, value)| sum[dof % D] += value);
    }
    let size = surface::length(&sum);
    let normal = if size > 0.0 { sum.map(|c| c / size) } else { sum };
    Ok(Driven { bodies: [body_name(&spec.slave), body_name(&spec.master)], normal, area, rubs })
}

/// Lengths of friction that weakens, and the distance of points where it is largest.
fn weakening<const D: usize>(
    model: &Model<D>,
    (spec, sides): (&Spec, &[Side]),
    normal: Option<f64>,
) -> Option<WeakeningCheck> {
    let [zone, nucleation] = cohesive::lengths(model, spec)?;
    let (node, spacing) = spacings(model, sides).into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let at = std::array::from_fn(|c| model.mesh.nodes[node].get(c).copied().unwrap_or(0.0));
    let under = |one: f64| {
        let length = one / normal?;
        Some(Coarsest { length, spacing, points: length / spacing, at, along: 0.0 })
    };
    Some(WeakeningCheck {
        spacing,
        at,
        one_point: [zone / spacing, nucleation / spacing],
        normal,
        cohesive_zone: under(zone),
        nucleation: under(nucleation),
    })
}

/// The springs of an interface and the critical stiffness.
fn machine(stiffness: f64, spec: &Spec, normal: Option<f64>) -> MachineCheck {
    let law = spec.law.as_ref().and_then(|law| laws::choose(law).ok());
    let slope = law.and_then(|law| critical_slope(&law)).filter(|slope| *slope > 0.0);
    MachineCheck {
        stiffness,
        critical: normal.zip(slope).map(|(normal, slope)| normal * slope),
        critical_normal: slope.map(|slope| stiffness / slope),
    }
}
