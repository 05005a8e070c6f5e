//! Checks of a plan of bodies and interfaces.

use super::PlannedInterface;
use super::assembly::Assembly;
use super::cohesive::{self, Shortest, pressed};
use super::friction::Friction;
use super::surfaces::FacingSurfaces;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::checks::model_checks::{self, DrivenSurface, body_name, field_bytes, machines};
use crate::shared::checks::{Checks, Cost, InterfaceCheck, MachineCheck, WeakeningCheck, rates};
use crate::shared::model::{self, Model};
use crate::shared::resolution::{Coarsest, Softening, critical_slope, softening};
use asperity_fem::surface;
use asperity_mechanics::solver::Solver;
use asperity_scene::defaults;

/// Values of the fields of bodies at a node (displacement and Mises stress) and in a cell (stress, Mises stress and the body).
const VALUES: [usize; 2] = [3 + 1, 6 + 2];

/// Checks of a plan.
///
/// # Errors
/// [`Diagnostic`] at a set without faces.
pub(super) fn collect<const D: usize>(
    assembly: &Assembly<'_, D>,
    memory_bytes: usize,
    solver: &Solver,
) -> Result<Checks, Diagnostic> {
    let Assembly { scene, model, stages, interfaces, frictions, .. } = assembly;
    let mut checks = model_checks::checks(scene, model)?;
    let driven: Vec<DrivenSurface> =
        interfaces.iter().map(|i| driven(scene, model, i)).collect::<Result<_, _>>()?;
    let machines = stages.last().map_or_else(Vec::new, |stage| machines(stage, &driven));
    for (k, planned) in interfaces.iter().enumerate() {
        let own = assembly.entry(planned);
        let friction = frictions[k].as_ref();
        let normal = pressed(scene, model, stages, own).filter(|normal| *normal > 0.0);
        let surfaces = FacingSurfaces::find(model, own)?;
        let nodes: Vec<usize> = planned.slave.iter().map(|point| point.0).collect();
        let shortest = cohesive::shortest(model, &surfaces, &nodes, friction);
        checks.interfaces.push(InterfaceCheck {
            interface: planned.name.clone(),
            points: planned.slave.len(),
            faces: [planned.slave_faces.len(), planned.master_faces.len()],
            area: driven[k].area,
            damping: planned.damping,
            weakening: shortest.map(|both| weakening(model, both, normal)),
            machine: machines.get(k).copied().flatten().map(|k| machine(k, friction, normal)),
        });
    }
    let fields = scene.output.fields.as_ref().map_or(defaults::FIELDS, |n| *n.get_ref()) * stages.len();
    checks.cost = Cost {
        memory_bytes: Some(memory_bytes),
        steps: stages.iter().map(|s| s.steps).sum(),
        step_seconds: solver.operations.map(rates::body_step),
        fields: Some(fields),
        field_bytes: Some(field_bytes(model, VALUES)),
        profiles: Some(
            scene.output.profiles.as_ref().map_or(defaults::PROFILES, |n| *n.get_ref()) * stages.len(),
        ),
        ..Cost::default()
    };
    Ok(checks)
}

/// The surface of an interface, as springs see it.
fn driven<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    planned: &PlannedInterface,
) -> Result<DrivenSurface, Diagnostic> {
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
    let bodies = [vec![body_name(&spec.slave)], spec.master.iter().map(body_name).collect()];
    Ok(DrivenSurface { bodies, normal, area, rubs })
}

/// Lengths of friction that weakens, and the distance of points, where the fewest points lie on the cohesive zone.
fn weakening<const D: usize>(model: &Model<D>, both: [Shortest; 2], normal: Option<f64>) -> WeakeningCheck {
    let at = |node: usize| std::array::from_fn(|c| model.mesh.nodes[node].get(c).copied().unwrap_or(0.0));
    let under = |s: Shortest| {
        let length = s.length / normal?;
        Some(Coarsest { length, spacing: s.spacing, points: length / s.spacing, at: at(s.node), along: 0.0 })
    };
    let [zone, nucleation] = both;
    WeakeningCheck {
        spacing: zone.spacing,
        at: at(zone.node),
        one_point: both.map(|s| s.length / s.spacing),
        normal,
        cohesive_zone: under(zone),
        nucleation: under(nucleation),
    }
}

/// The springs of an interface and the largest critical stiffness of its points.
fn machine(stiffness: f64, friction: Option<&Friction>, normal: Option<f64>) -> MachineCheck {
    let laws = friction.map_or(&[][..], Friction::laws);
    let slope = laws.iter().filter_map(critical_slope).reduce(f64::max).filter(|slope| *slope > 0.0);
    MachineCheck {
        stiffness,
        critical: normal.zip(slope).map(|(normal, slope)| normal * slope),
        critical_normal: slope.map(|slope| stiffness / slope),
        softening: laws.iter().map(softening).max().unwrap_or(Softening::None),
    }
}
