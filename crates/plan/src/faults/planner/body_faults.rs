//! Faults between bodies, planned in phases: the ground with the points of its faults, the loads on it, its bodies pressed, its bodies
//! condensed onto the points that slide, and the plan.

use super::super::bodies::{BodiesView, LaggingPoints};
use super::super::plan::Plan;
use super::super::receivers::Receivers;
use super::super::sampling::Sampling;
use super::super::stresses::BodyStresses;
use super::assemble::{SlidingFaults, SurroundingsView, plan_of, tangents};
use super::backslip::{self, PlateRates};
use super::condensation::{Condensation, HashedStiffness};
use super::condensation_refusals::CondensationInput;
use super::condensed::{self, CondensedBodies};
use super::fault_faces::FaultFaces;
use super::fault_resolution::resolved;
use super::history::LoadHistory;
use super::loaded_bodies::LoadedBodies;
use super::operator::OperatorSource;
use super::placed_point::{FaultPoints, PlacedPoint};
use super::points::all_points;
use super::pressing;
use super::remarks::Remarks;
use super::{
    body_samples, checks, coulomb, mirror, plates, receivers, requests, sense, up_direction, weight,
};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::amounts;
use crate::shared::checks::model_checks::{self, machines};
use crate::shared::checks::{Checks, meetings};
use crate::shared::entry::Entry;
use crate::shared::loading::{self, Stage};
use crate::shared::memory::ModelMemory;
use crate::shared::model::{self, Model, forecast, locking};
use crate::shared::resolution::Resolution;
use asperity_cycles::medium::{
    Bodies, Conditions, Initial, Loads, Mirror, Point, PressedBodies, Refusal, Spring, least_bytes,
};
use asperity_cycles::operator::Operator;
use asperity_cycles::{Loading, deficit};
use asperity_fem::table::Table;
use asperity_mechanics::Travel;
use asperity_run::Warning;

/// Plans faults between bodies.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub(super) fn plan<const D: usize>(scene: &Scene, source: OperatorSource<'_>) -> Result<Plan, Diagnostic> {
    let mut ground = Ground::<D>::read(scene)?;
    let mut loaded = GroundLoads::new(&ground)?;
    let bodies = HashedStiffness::new(ground.model.take_stiffness(), source.setups);
    let pressed = loaded.press(&ground, &bodies, source)?;
    let points = ground.part();
    let asked = ground.asked(&loaded.loads);
    let condensed = condensed::condense_bodies(asked, &points.sliding, bodies, loaded.condensation(source))?;
    ground.plan(&loaded, points, pressed.as_ref(), condensed)
}

/// The bodies of a scene with the stages of its run, and the points of its faults.
struct Ground<'s, const D: usize> {
    scene: &'s Scene,
    model: Model<D>,
    /// The stage that presses the bodies, if there is one.
    pressing: Option<Stage>,
    /// The stage of the run.
    stage: Stage,
    /// Points of all faults, until they are parted into those that slide and those that creep.
    placed: Vec<PlacedPoint<D>>,
    /// The same as the condensation takes them.
    points: Vec<Point<D>>,
    /// Resolution of friction, where the normal tractions are known before the bodies are condensed.
    resolution: Option<Vec<Resolution>>,
    checks: Checks,
    held: ModelMemory,
    remarks: Remarks,
}

/// Points that slide by their law, in their order among all points, and points that creep.
struct PartedPoints<const D: usize> {
    sliding: Vec<PlacedPoint<D>>,
    creeping: Vec<PlacedPoint<D>>,
    /// Numbers of those that slide among all points.
    free: Vec<usize>,
}

impl<const D: usize> PartedPoints<D> {
    fn all(&self) -> FaultPoints<'_, D> {
        FaultPoints { sliding: &self.sliding, creeping: &self.creeping }
    }
}

impl<'s, const D: usize> Ground<'s, D> {
    fn read(scene: &'s Scene) -> Result<Self, Diagnostic> {
        let model = linear::<D>(scene)?;
        let (pressing, stage) =
            parted(loading::stages(scene, &model)?).ok_or_else(|| requests::stages(scene))?;
        let mut remarks = Remarks { warnings: scene.warnings.clone(), notes: Vec::new() };
        remarks.warnings.extend(locking::doubts(scene, &model)?);
        let placed = all_points(scene, &model, &mut remarks)?;
        let points: Vec<Point<D>> = placed.iter().map(|p| p.point.clone()).collect();
        if points.iter().all(|p| p.creep.is_some()) {
            return Err(requests::nothing_slides(&Entry::all(&scene.faults), &placed));
        }
        // If weight or a stage before presses the bodies, normal tractions are known only once their equations are solved.
        let known = stage.weight.is_empty() && pressing.is_none();
        let resolution = known.then(|| resolved(scene, &placed, &mut remarks.warnings)).transpose()?;
        let (checks, held) = (model_checks::checks(scene, &model)?, ModelMemory::new(&model));
        remarks.warnings.extend(up_direction::held_above(scene, &model));
        remarks.warnings.extend(meetings::doubts(scene, &model));
        Ok(Self { scene, model, pressing, stage, placed, points, resolution, checks, held, remarks })
    }

    /// The ground under these loads, as the condensation sees it.
    fn asked<'a>(&'a self, loads: &'a Loads) -> CondensationInput<'a, D> {
        CondensationInput { scene: self.scene, model: &self.model, loads, points: &self.points }
    }

    /// Parts the points into those that slide and those that creep.
    fn part(&mut self) -> PartedPoints<D> {
        let free = (0..self.points.len()).filter(|&k| self.points[k].creep.is_none()).collect();
        let placed = std::mem::take(&mut self.placed);
        let (creeping, sliding) = placed.into_iter().partition(|p| p.point.creep.is_some());
        PartedPoints { sliding, creeping, free }
    }

    /// The plan, from the bodies condensed onto the points that slide.
    fn plan(
        mut self,
        loaded: &GroundLoads,
        mut points: PartedPoints<D>,
        pressed: Option<&PressedBodies>,
        mut condensed: CondensedBodies,
    ) -> Result<Plan, Diagnostic> {
        let scene = self.scene;
        self.remarks.notes.extend(condensed.mirrored.then(|| MIRRORED.to_string()));
        let plates = backslip::plates(scene, &points.sliding, loaded.conditions.tangents);
        let initial = InitialLoads { weight: condensed.weight.take(), pressed };
        let bodies = condensed.bodies.take();
        let receivers = self.receivers(&loaded.loads, bodies.as_ref(), &plates)?;
        let (opening, bytes) = (condensed.opening.take(), condensed.bytes);
        let driven = driven(scene, self.loaded_bodies(), points.all(), condensed, &plates);
        self.remarks.warnings.extend(driven.warnings);
        self.remarks.notes.extend(backslip::notes(scene));
        self.load(&initial, &mut points)?;
        let PartedPoints { sliding, creeping, .. } = points;
        let known = self.resolution.take();
        let resolution = known.map_or_else(|| resolved(scene, &sliding, &mut self.remarks.warnings), Ok)?;
        requests::opens(&Entry::all(&scene.faults), &sliding, opening.as_ref().map_or(&[], |o| o.points()))?;
        let around = SurroundingsView {
            medium: "condensed onto the faults",
            dofs: self.model.dofs(),
            creeping: creeping.len(),
            memory_bytes: self.held.with_faults(bytes),
            bodies: self.view(bodies, &sliding, plates.rates),
            sampling: self.sampling(pressed, &sliding)?,
            stresses: stresses::<D>(scene)?,
            resolution,
            prescribed: checks::counted(scene, &creeping),
            machines: machines(&self.stage, &checks::surfaces(scene, &sliding)),
            loading: self.stage.largest_rate().max(backslip::fastest(scene)),
            remarks: self.remarks,
            checks: self.checks,
        };
        let DrivenFaults { operator, loading, .. } = driven;
        let surrounded = SlidingFaults { placed: sliding, operator, opening, loading, end: self.stage.end };
        Ok(Plan { receivers, ..plan_of(scene, surrounded, around, &FaultFaces { model: &self.model })? })
    }

    fn loaded_bodies(&self) -> LoadedBodies<'_, D> {
        LoadedBodies { model: &self.model, stage: &self.stage }
    }

    /// Positions in the bodies whose motion is written.
    fn receivers(
        &self,
        loads: &Loads,
        bodies: Option<&Bodies>,
        plates: &PlateRates,
    ) -> Result<Receivers, Diagnostic> {
        match bodies.filter(|_| !self.scene.output.receivers.is_empty()) {
            Some(bodies) => receivers::plan(self.asked(loads), bodies, plates),
            None => Ok(Receivers::default()),
        }
    }

    /// Adds what presses and shears the points before the run to their initial tractions.
    fn load(&mut self, initial: &InitialLoads<'_>, points: &mut PartedPoints<D>) -> Result<(), Diagnostic> {
        let PartedPoints { sliding, free, .. } = points;
        let pressed = weight::press(self.scene, self.loaded_bodies(), initial.weight.as_ref(), sliding)?;
        self.remarks.notes.extend(pressed);
        if let Some(pressed) = initial.pressed {
            self.remarks.notes.extend(pressing::start(self.scene, pressed, free, sliding)?);
        }
        Ok(())
    }

    /// The bodies as the output needs them, if displacements of all of them are needed.
    fn view(
        &self,
        bodies: Option<Bodies>,
        sliding: &[PlacedPoint<D>],
        plates: Vec<f64>,
    ) -> Option<BodiesView> {
        let bodies = bodies.filter(|_| displaced(self.scene, &self.stage))?;
        let sides = sliding.iter().map(|p| [p.point.place.minus, p.point.place.plus]).collect();
        Some(BodiesView::new(bodies, &self.model, LaggingPoints { sides, plates }, shown(self.scene)))
    }

    /// Points, sets and springs of the bodies that are sampled.
    fn sampling(
        &self,
        pressed: Option<&PressedBodies>,
        sliding: &[PlacedPoint<D>],
    ) -> Result<Option<Sampling>, Diagnostic> {
        let areas = sliding.iter().map(|p| p.point.place.area).collect();
        body_samples::plan::<D>(self.scene, &self.stage, pressed, areas)
    }
}

/// Loads that press and shear the points of faults before the run.
struct InitialLoads<'a> {
    weight: Option<Initial>,
    pressed: Option<&'a PressedBodies>,
}

/// Loads on the ground, and how its bodies are condensed.
struct GroundLoads {
    conditions: Conditions,
    loads: Loads,
    /// Mirror of the bodies, if one side may represent both.
    mirror: Option<Mirror>,
}

impl GroundLoads {
    /// Loads before anything presses the bodies.
    fn new<const D: usize>(ground: &Ground<'_, D>) -> Result<Self, Diagnostic> {
        let stage = &ground.stage;
        let conditions = conditions(ground.scene, stage, ground.model.idealisation.components());
        // Weight acts while the bodies are pressed, or else before the start.
        let weight = if ground.pressing.is_none() { stage.weight.clone() } else { Vec::new() };
        let loads = loads(stage, &vec![0.0; ground.model.dofs()], weight);
        let mirror = if conditions.keep { None } else { mirror::find(&ground.model, &ground.points) };
        admit(ground.asked(&loads), conditions, mirror.is_some())?;
        Ok(Self { conditions, loads, mirror })
    }

    /// Choices for condensing the bodies, with an operator from this source.
    fn condensation<'a>(&'a self, source: OperatorSource<'a>) -> Condensation<'a> {
        Condensation { conditions: self.conditions, mirror: self.mirror.as_ref(), source }
    }

    /// Presses the bodies, if a stage does so, and takes the loads of the run from there on.
    fn press<const D: usize>(
        &mut self,
        ground: &Ground<'_, D>,
        bodies: &HashedStiffness,
        source: OperatorSource<'_>,
    ) -> Result<Option<PressedBodies>, Diagnostic> {
        let Some(pressing) = &ground.pressing else { return Ok(None) };
        let faults: Vec<usize> = ground.placed.iter().map(|p| p.fault).collect();
        let asked = ground.asked(&self.loads);
        let pressed = pressing::solve(asked, pressing, &faults, bodies, self.condensation(source))?;
        self.loads = loads(&ground.stage, &pressed.displacement, Vec::new());
        Ok(Some(pressed))
    }
}

/// Note on bodies of which one represents both.
const MIRRORED: &str =
    "the bodies and their loads are antisymmetric about the fault: one side is condensed for both";

/// The bodies, which must be linear.
fn linear<const D: usize>(scene: &Scene) -> Result<Model<D>, Diagnostic> {
    let model = model::build::<D>(scene)?;
    match model.bodies.iter().find(|b| b.nonlinear.is_some()) {
        Some(body) => Err(requests::not_linear(scene, &body.name)),
        None => Ok(model),
    }
}

/// The stage before that presses the bodies, if there is one, and the stage of the run; `None` for another number of stages.
fn parted(mut stages: Vec<Stage>) -> Option<(Option<Stage>, Stage)> {
    let stage = stages.pop()?;
    let pressing = stages.pop();
    stages.is_empty().then_some((pressing, stage))
}

/// Refuses faults with so many points that the condensed matrix alone exceeds the memory, before the cell matrices are computed.
/// In a mirror, motions across the faults are no unknowns.
fn admit<const D: usize>(
    asked: CondensationInput<'_, D>,
    conditions: Conditions,
    mirrored: bool,
) -> Result<(), Diagnostic> {
    let points = asked.points;
    let free = points.iter().filter(|p| p.creep.is_none()).count();
    let opening = points.iter().filter(|p| p.creep.is_none() && p.opens).count();
    let components = if mirrored { 1 } else { conditions.components };
    let needed = least_bytes(components, conditions.tangents, free, opening);
    forecast::fits(asked.scene, needed)?;
    if needed > conditions.memory {
        return Err(asked.error(&Refusal::Memory { needed, allowed: conditions.memory, points: free }));
    }
    Ok(())
}

/// Loads on the bodies during a stage that starts from displacements `u0` \[m\]: changes since its start.
fn loads(stage: &Stage, u0: &[f64], weight: Vec<(usize, f64)>) -> Loads {
    let drawn = |s: &loading::Spring| match s.rate.drawn(stage.start, stage.end) {
        Travel::Steady { rate, .. } => Table::new(vec![0.0, stage.end], vec![0.0, rate * stage.end]),
        Travel::Table(table) => table,
    };
    let spring =
        |s: &loading::Spring| Spring { dofs: s.dofs.clone(), stiffness: s.stiffness, drawn: drawn(s) };
    let mut constraints = stage.constraints(u0);
    for channel in &mut constraints.channels {
        channel.amplitude = channel.amplitude.clone().since(stage.start);
    }
    constraints.channels.retain(|channel| !channel.amplitude.is_zero());
    Loads { constraints, springs: stage.springs.iter().map(spring).collect(), weight, end: stage.end }
}

/// Settings for the condensation of the bodies of a scene.
fn conditions(scene: &Scene, stage: &Stage, components: usize) -> Conditions {
    let keep = displaced(scene, stage) || !scene.output.receivers.is_empty();
    Conditions { components, tangents: tangents(scene), memory: amounts::memory(scene), keep }
}

/// True if displacements of whole bodies are needed during the run or at its end.
fn displaced(scene: &Scene, stage: &Stage) -> bool {
    shown(scene) || scene.output.coulomb.is_some() || body_samples::asked(scene, stage)
}

/// True if displacements of the bodies are written.
fn shown(scene: &Scene) -> bool {
    scene.output.bodies.as_ref().is_some_and(|b| *b.get_ref())
}

/// Planes on which stresses of the bodies are resolved, if the scene asks for changes of Coulomb stress.
fn stresses<const D: usize>(scene: &Scene) -> Result<Option<BodyStresses>, Diagnostic> {
    let Some(spec) = &scene.output.coulomb else { return Ok(None) };
    // The blocks of the model of the plan have become its stiffness.
    let plane = coulomb::plane::<D>(scene, spec.get_ref())?;
    Ok(Some(BodyStresses::new(plane, model::build::<D>(scene)?)))
}

/// Operator of faults between bodies, and what loads them.
struct DrivenFaults {
    operator: Box<dyn Operator>,
    loading: Loading,
    warnings: Vec<Warning>,
}

/// Operator and loads of faults in their surroundings, with warnings about loads and creep; points that slide may lag behind plates.
fn driven<const D: usize>(
    scene: &Scene,
    bodies: LoadedBodies<'_, D>,
    points: FaultPoints<'_, D>,
    condensed: CondensedBodies,
    plates: &PlateRates,
) -> DrivenFaults {
    let of_sides = plates::check(scene, bodies, points, &condensed);
    let CondensedBodies { operator, mut loading, .. } = condensed;
    let end = bodies.stage.end;
    let mut of_backslip = None;
    if plates.rates.iter().any(|rate| *rate != 0.0) {
        let deficit = deficit(operator.as_ref(), &plates.rates, end);
        let histories = [&loading, &deficit].map(|loading| LoadHistory { loading, end });
        of_backslip = backslip::doubts(scene, points.sliding, operator.as_ref(), histories);
        loading.append(deficit);
    }
    let mut warnings = sense::check(scene, points, LoadHistory { loading: &loading, end });
    if warnings.is_empty() {
        // One warning per cause.
        warnings.extend(of_backslip.or(of_sides));
    }
    warnings.extend(weight::hangs(scene, bodies));
    DrivenFaults { operator, loading, warnings }
}
