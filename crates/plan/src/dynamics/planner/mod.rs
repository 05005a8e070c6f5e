//! Plans a scene with the stepper "explicit".

mod doubts;
mod faults;
mod forced_rupture;
mod masses;
mod outputs;
mod rupture;
mod steps;

pub use rupture::ruptures;

use super::plan::{AnyPlan, Plan};
use crate::faults::planner::{self as of_faults, FaultFaces, PlacedPoint, Remarks};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Kinematics, Scene};
use crate::shared::checks::model_checks::{self, field_bytes};
use crate::shared::checks::{Cost, meetings, rates};
use crate::shared::entry::Entry;
use crate::shared::loading::{Stage, courses};
use crate::shared::memory::ModelMemory;
use crate::shared::model::{self, Model, counts, cuts, forecast, locking, meshes};
use crate::shared::{loading, rate_bound, unbalance, views};
use asperity_mechanics::dynamics::{Problem, StableStep};
use asperity_scene::defaults;
use steps::StepChoice;

/// Plans a scene whose stepper is "explicit".
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan(scene: &Scene) -> Result<AnyPlan, Diagnostic> {
    Ok(match scene.kinematics.get_ref().dimension() {
        2 => AnyPlan::Two(Box::new(plan_in::<2>(scene)?)),
        _ => AnyPlan::Three(Box::new(plan_in::<3>(scene)?)),
    })
}

/// Refuses faults in kinematics whose jumps they do not describe.
fn admit(scene: &Scene) -> Result<(), Diagnostic> {
    let kinematics = scene.kinematics.get_ref();
    let known = matches!(kinematics, Kinematics::Antiplane | Kinematics::PlaneStrain | Kinematics::ThreeD);
    if scene.faults.is_empty() || known {
        return Ok(());
    }
    Err(Diagnostic::at(
        scene.kinematics.span(),
        format!("faults in {} are not stepped", kinematics.words()),
        "\"antiplane\", \"plane-strain\" and \"3d\" are",
    ))
}

/// Steps of bodies with mass, and what they follow from.
struct StepPlan {
    /// Density of each block of cells \[kg/m³\].
    density: Vec<f64>,
    viscosity: f64,
    stable: StableStep,
    counted: StepChoice,
}

impl StepPlan {
    fn choose<const D: usize>(scene: &Scene, model: &Model<D>, stage: &Stage) -> Result<Self, Diagnostic> {
        let density = masses::densities(scene, model)?;
        let viscosity = steps::viscosity(scene);
        let stable = masses::stable(scene, model, &density, viscosity)?;
        let counted = steps::choose(scene, stage, &stable)?;
        Ok(Self { density, viscosity, stable, counted })
    }
}

/// Points of faults that slide, and those that are locked or creep.
struct SplitPoints<const D: usize> {
    sliding: Vec<PlacedPoint<D>>,
    locked: Vec<PlacedPoint<D>>,
}

impl<const D: usize> SplitPoints<D> {
    fn find(scene: &Scene, model: &Model<D>, remarks: &mut Remarks) -> Result<Self, Diagnostic> {
        if scene.faults.is_empty() {
            remarks.notes.extend(meshes::notes(scene)?);
            remarks.notes.extend(cuts::notes(scene, &model.mesh));
            remarks.notes.extend(meshes::left_out(model));
            return Ok(Self { sliding: Vec::new(), locked: Vec::new() });
        }
        let (locked, sliding) = faults::apart(of_faults::all_points(scene, model, remarks)?);
        if sliding.is_empty() && !locked.is_empty() {
            return Err(of_faults::nothing_slides(&Entry::all(&scene.faults), &locked));
        }
        Ok(Self { sliding, locked })
    }
}

fn plan_in<const D: usize>(scene: &Scene) -> Result<Plan<D>, Diagnostic> {
    admit(scene)?;
    let model = model::build::<D>(scene)?;
    let stages = loading::stages(scene, &model)?;
    let mut remarks = Remarks { warnings: scene.warnings.clone(), notes: Vec::new() };
    remarks.warnings.extend(locking::doubts(scene, &model)?);
    remarks.warnings.extend(meetings::doubts(scene, &model));
    if scene.faults.is_empty() {
        remarks.warnings.extend(unbalance::waves(scene, &model, &stages[0]));
    }
    let StepPlan { density, viscosity, stable, counted } = StepPlan::choose(scene, &model, &stages[0])?;
    let SplitPoints { sliding, locked } = SplitPoints::find(scene, &model, &mut remarks)?;
    crate::doubts::add(&mut remarks.warnings, doubts::check(scene, &sliding, &stages[0], &counted));
    remarks.warnings.extend(doubts::outdamped(scene, &model, viscosity, counted.dt));
    remarks.warnings.extend(courses::passed_over(&scene.stages[0], counted.dt, courses::WAVES));
    let resolution = of_faults::resolved(scene, &sliding, &mut remarks.warnings)?;
    let (faults, points) = of_faults::views(scene, &FaultFaces { model: &model }, &sliding, D == 3)?;
    let receivers = outputs::receivers(scene, &model, &sliding)?;
    remarks.notes.extend(outputs::notes(scene, counted.cadence.rows as f64 * counted.dt));
    let memory_bytes = ModelMemory::new(&model).in_steps(stable.highest.kept, model.dofs());
    forecast::fits(scene, memory_bytes)?;
    let mut checks = model_checks::checks(scene, &model)?;
    checks.faults = of_faults::checks::faults(scene, &sliding, &faults, &resolution);
    crate::doubts::add(&mut remarks.warnings, of_faults::checks::small_patches(scene, &checks.faults));
    of_faults::checks::prescribe(&mut checks.faults, &of_faults::checks::counted(scene, &locked));
    checks.cost = cost(&model, &counted, points.len(), memory_bytes);
    let fault = faults::assemble(scene, &sliding, &locked)?;
    remarks.warnings.extend(doubts::unlike(scene, &sliding, true));
    let duration = counted.steps as f64 * counted.dt;
    if let Some(fault) = &fault {
        crate::doubts::add(&mut remarks.warnings, doubts::pulses(scene, &sliding, fault, duration));
    }
    let fastest = rate_bound::bound(sliding.iter().map(|p| p.medium.waves));
    let absorbing = masses::absorbing(scene, &model, &density)?;
    if absorbing.is_empty() {
        remarks.warnings.extend(doubts::returned(
            &model,
            &sliding,
            fastest,
            doubts::QuietTime { place: scene.stages[0].duration.span(), what: "the stage", duration },
        ));
    }
    Ok(Plan {
        title: scene.title.clone(),
        stiffest: masses::middle(&model, &stable),
        steps: counted.steps,
        dt: counted.dt,
        step_reason: counted.why,
        cadence: counted.cadence,
        faults,
        points,
        resolution,
        rupture_rate: scene.output.rupture_rate.as_ref().map_or(defaults::RUPTURED, |v| v.get_ref().0),
        fastest,
        receivers,
        epoch: outputs::epoch(scene)?,
        mesh: views::mesh_view(&model, false),
        axes: (0..model.idealisation.components()).map(|c| model.idealisation.axis(c)).collect(),
        per_length: views::per_length(model.idealisation),
        kinematics: scene.kinematics.get_ref().words(),
        memory_bytes,
        warnings: remarks.warnings,
        notes: remarks.notes,
        checks,
        problem: Problem {
            courant: counted.courant,
            viscosity,
            fault,
            absorbing,
            velocity: Vec::new(),
            stages,
            density,
            model,
        },
        stable,
    })
}

/// Values of a field at a node, velocity and displacement, and in a cell.
const VALUES: [usize; 2] = [6, 0];

/// Cost of a run with these steps.
fn cost<const D: usize>(model: &Model<D>, counted: &StepChoice, points: usize, memory_bytes: usize) -> Cost {
    let components = model.idealisation.components();
    let dofs = counts(&model.mesh).iter().map(|c| c.cells as usize * c.kind.nodes() * components).sum();

    let times = |each: usize| Some(counted.steps / each);
    Cost {
        memory_bytes: Some(memory_bytes),
        steps: Some(counted.steps),
        step_seconds: Some(rates::wave_step(dofs, points)),
        fields: times(counted.cadence.fields),
        field_bytes: Some(field_bytes(model, VALUES)),
        profiles: times(counted.cadence.profiles),
        rows: times(counted.cadence.rows),
        ..Cost::default()
    }
}
