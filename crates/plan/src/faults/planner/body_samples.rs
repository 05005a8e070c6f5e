//! Points, sets and springs of bodies around faults whose values are sampled.

use super::super::sampling::{SampledBodies, Sampling};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Scene, Stepper};
use crate::shared::loading::{Spring, Stage};
use crate::shared::model::samples;
use crate::shared::{initial_stress, model, views};
use asperity_cycles::medium::PressedBodies;
use asperity_fem::dof::Channel;
use asperity_fem::table::Table;
use asperity_mechanics::SpringStart;

/// True if values of the bodies are sampled: at points, on sets, or of springs that load sides. Bodies that have mass in ruptures move
/// otherwise there.
pub(super) fn asked(scene: &Scene, stage: &Stage) -> bool {
    let output = &scene.output;
    let any = !output.points.is_empty() || !output.forces.is_empty() || !stage.springs.is_empty();
    any && *scene.time.stepper.get_ref() == Stepper::FaultOde
}

/// Points, sets and springs of the bodies of a scene that are sampled; `areas` are those of the points of the faults \[m²; m\].
///
/// # Errors
/// [`Diagnostic`] for a point outside its body or a set that does not exist.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    stage: &Stage,
    pressed: Option<&PressedBodies>,
    areas: Vec<f64>,
) -> Result<Option<Sampling>, Diagnostic> {
    if !asked(scene, stage) {
        return Ok(None);
    }
    // The blocks of the model of the plan have become its stiffness.
    let model = model::build::<D>(scene)?;
    let wanted = samples::find(scene, &model)?;
    let initial_stress = model.bodies.iter().map(|b| initial_stress::body_field(scene, &b.name)).collect();
    let unit = if views::per_length(model.idealisation) { "N/m" } else { "N" };
    let start = pressed.map_or_else(|| vec![0.0; model.dofs()], |p| p.displacement.clone());
    let spring = |spring: &Spring| {
        let force = pressed.map_or(0.0, |p| spring.dofs.iter().map(|&d| p.supports[d]).sum());
        SpringStart { force, load_point: 0.0, displacement: start[spring.dofs[0]] }
    };
    let springs = stage.springs.iter().map(spring).collect();
    let mut loaded = stage.clone();
    if pressed.is_some() {
        // Weight is part of the forces then; without, it acts before displacements are counted.
        let forces = stage.weight.clone();
        loaded
            .loads
            .push((None, Channel { prescribed: Vec::new(), forces, amplitude: Table::constant(1.0) }));
    }
    let beside = wanted.beside(&model, &loaded);
    let bodies =
        SampledBodies { model, initial_stress, wanted, stage: stage.clone(), beside, start, springs };
    let number = scene.stages.iter().position(|s| s.name == stage.name).unwrap_or(0);
    Ok(Some(Sampling::new(bodies, areas, unit, number)))
}
