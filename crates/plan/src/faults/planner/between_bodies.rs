//! Faults between bodies, planned in phases: the ground with the points of its faults, the loads on it, its bodies pressed, its bodies
//! condensed onto the points that slide, and the plan.

use super::super::bodies::BodiesView;
use super::super::plan::Plan;
use super::super::receivers::Receivers;
use super::super::stresses::BodyStresses;
use super::assemble::{SlidingFaults, SurroundingsView, plan_of, turns};
use super::condensed::{self, CondensedBodies};
use super::held::CondensationInput;
use super::meshed::FaultFaces;
use super::placed::PlacedPoint;
use super::points::all_points;
use super::pressing;
use super::resolved::resolved;
use super::{asked, backslip, checks, coulomb, mirror, plates, receivers, sampled, sense, upright, weight};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::amounts;
use crate::shared::checks::Checks;
use crate::shared::checks::of_model::{self, machines};
use crate::shared::entry::Entry;
use crate::shared::held::ModelMemory;
use crate::shared::loading::{self, Stage};
use crate::shared::model::{self, Model, forecast, locking};
use crate::shared::resolution::Resolution;
use crate::shared::setup::Setups;
use asperity_cycles::medium::{
    Bodies, Conditions, Loads, Mirror, Point, PressedBodies, Refusal, Spring, least_bytes,
};
use asperity_cycles::operator::{Form, Operator};
use asperity_cycles::{Loading, deficit};
use asperity_fem::condense::Stiffness;
use asperity_fem::table::Table;
use asperity_mechanics::Travel;
use asperity_run::Warning;

/// Plans faults between bodies.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    (form, setups): (Form, &Setups),
) -> Result<Plan, Diagnostic> {
    let mut ground = Ground::<D>::read(scene)?;
    let mut loaded = GroundLoads::new(&ground)?;
    let bodies = ground.model.take_stiffness();
    let inputs = setups.hash(|key| condensed::hash_stiffness(key, &bodies));
    let pressed = loaded.press(&ground, &bodies, (setups, &inputs))?;
    let points = ground.part();
    let how = (loaded.conditions, loaded.mirror.as_ref(), form);
    let asked = ground.asked(&loaded.loads);
    let condensed = condensed::condense_bodies((asked, &points.sliding), bodies, how, (setups, inputs))?;
    ground.plan(&loaded.conditions, points, pressed.as_ref(), condensed)
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
    warnings: Vec<Warning>,
    notes: Vec<String>,
}

/// Points that slide by their law, in their order among all points, and points that creep.
struct PartedPoints<const D: usize> {
    sliding: Vec<PlacedPoint<D>>,
    creeping: Vec<PlacedPoint<D>>,
    /// Numbers of those that slide among all points.
    free: Vec<usize>,
}

impl<'s, const D: usize> Ground<'s, D> {
    fn read(scene: &'s Scene) -> Result<Self, Diagnostic> {
        let model = linear::<D>(scene)?;
        let (pressing, stage) =
            parted(loading::stages(scene, &model)?).ok_or_else(|| asked::stages(scene))?;
        let mut warnings = scene.warnings.clone();
        warnings.extend(locking::doubts(scene, &model)?);
        let (placed, notes) = all_points(scene, &model, &mut warnings)?;
        let points: Vec<Point<D>> = placed.iter().map(|p| p.point.clone()).collect();
        if points.iter().all(|p| p.creep.is_some()) {
            return Err(asked::nothing_slides(&Entry::all(&scene.faults), &placed));
        }
        // If weight or a stage before presses the bodies, normal tractions are known only once their equations are solved.
        let known = stage.weight.is_empty() && pressing.is_none();
        let resolution = known.then(|| resolved(scene, &placed, &mut warnings)).transpose()?;
        let (checks, held) = (of_model::checks(scene, &model)?, ModelMemory::new(&model));
        warnings.extend(upright::held_above(scene, &model));
        Ok(Self { scene, model, pressing, stage, placed, points, resolution, checks, held, warnings, notes })
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
        conditions: &Conditions,
        points: PartedPoints<D>,
        pressed: Option<&PressedBodies>,
        mut condensed: CondensedBodies,
    ) -> Result<Plan, Diagnostic> {
        let PartedPoints { sliding: mut placed, creeping, free } = points;
        let (scene, tangents) = (self.scene, conditions.tangents);
        self.notes.extend(condensed.mirrored.then(|| MIRRORED.to_string()));
        let plates = backslip::plates(scene, &placed, tangents);
        let (opening, weight) = (condensed.opening.take(), condensed.weight.take());
        let (bytes, bodies) = (condensed.bytes, condensed.bodies.take());
        let receivers = receivers(scene, (&self.model, &self.points), bodies.as_ref(), (&plates, tangents))?;
        let stage = &self.stage;
        let bodies = bodies.filter(|_| displaced(scene, stage));
        let driven = driven(scene, (&self.model, stage), (&placed, &creeping), (condensed, &plates));
        self.warnings.extend(driven.warnings);
        self.notes.extend(backslip::notes(scene));
        self.notes.extend(weight::press(scene, (&self.model, stage), weight.as_ref(), &mut placed)?);
        if let Some(pressed) = pressed {
            self.notes.extend(pressing::start(scene, pressed, &free, &mut placed)?);
        }
        let resolution = self.resolution.map_or_else(|| resolved(scene, &placed, &mut self.warnings), Ok)?;
        asked::opens(&Entry::all(&scene.faults), &placed, opening.as_ref().map_or(&[], |o| o.points()))?;
        let sides = placed.iter().map(|p| [p.point.place.minus, p.point.place.plus]).collect();
        let areas = placed.iter().map(|p| p.point.place.area).collect();
        let around = SurroundingsView {
            medium: "condensed onto the faults",
            dofs: self.model.dofs(),
            creeping: creeping.len(),
            memory_bytes: self.held.with_faults(bytes),
            bodies: bodies.map(|bodies| BodiesView::new((bodies, plates), &self.model, sides, shown(scene))),
            sampling: sampled::plan::<D>(scene, stage, pressed, areas)?,
            stresses: stresses::<D>(scene)?,
            resolution,
            warnings: self.warnings,
            notes: self.notes,
            prescribed: checks::counted(scene, &creeping),
            machines: machines(stage, &checks::surfaces(scene, &placed)),
            loading: stage.largest_rate().max(backslip::fastest(scene)),
            checks: self.checks,
        };
        let DrivenFaults { operator, loading, .. } = driven;
        let surrounded = SlidingFaults { operator, placed, opening, loading, end: stage.end };
        Ok(Plan { receivers, ..plan_of(scene, surrounded, around, &FaultFaces { model: &self.model })? })
    }
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

    /// Presses the bodies, if a stage does so, and takes the loads of the run from there on.
    fn press<const D: usize>(
        &mut self,
        ground: &Ground<'_, D>,
        bodies: &Stiffness,
        setups: (&Setups, &Option<String>),
    ) -> Result<Option<PressedBodies>, Diagnostic> {
        let Some(pressing) = &ground.pressing else { return Ok(None) };
        let faults: Vec<usize> = ground.placed.iter().map(|p| p.fault).collect();
        let asked = ground.asked(&self.loads);
        let pressed = pressing::solve(asked, pressing, &faults, (bodies, self.conditions), setups)?;
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
        Some(body) => Err(asked::not_linear(scene, &body.name)),
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
    let tangents = if turns(scene) { 2 } else { 1 };
    Conditions { components, tangents, memory: amounts::memory(scene), keep }
}

/// True if displacements of whole bodies are needed during the run or at its end.
fn displaced(scene: &Scene, stage: &Stage) -> bool {
    shown(scene) || scene.output.coulomb.is_some() || sampled::asked(scene, stage)
}

/// True if displacements of the bodies are written.
fn shown(scene: &Scene) -> bool {
    scene.output.bodies.as_ref().is_some_and(|b| *b.get_ref())
}

/// Positions in the bodies whose motion is written.
fn receivers<const D: usize>(
    scene: &Scene,
    around: (&Model<D>, &[Point<D>]),
    bodies: Option<&Bodies>,
    lag: (&[f64], usize),
) -> Result<Receivers, Diagnostic> {
    match bodies.filter(|_| !scene.output.receivers.is_empty()) {
        Some(bodies) => receivers::plan(scene, around, bodies, lag),
        None => Ok(Receivers::default()),
    }
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

/// Operator and loads of faults in their surroundings, with warnings about loads and creep; points either slide or creep, and
/// those that slide may lag behind plates with these rates \[m/s\].
fn driven<const D: usize>(
    scene: &Scene,
    (model, stage): (&Model<D>, &Stage),
    (placed, creeping): (&[PlacedPoint<D>], &[PlacedPoint<D>]),
    (condensed, plates): (CondensedBodies, &[f64]),
) -> DrivenFaults {
    let of_sides = plates::check(scene, (model, stage), (placed, creeping), &condensed);
    let CondensedBodies { operator, mut loading, .. } = condensed;
    let mut of_backslip = None;
    if plates.iter().any(|rate| *rate != 0.0) {
        let deficit = deficit(operator.as_ref(), plates, stage.end);
        of_backslip = backslip::doubts(scene, placed, operator.as_ref(), ([&loading, &deficit], stage.end));
        loading.append(deficit);
    }
    let mut warnings = sense::check(scene, (placed, creeping), &loading, stage.end);
    if warnings.is_empty() {
        // One warning per cause.
        warnings.extend(of_backslip.or(of_sides));
    }
    warnings.extend(weight::hangs(scene, model, stage));
    DrivenFaults { operator, loading, warnings }
}
