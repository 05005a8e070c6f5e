//! Plans a scene with faults: the problem to integrate and the method.

mod apart;
mod asked;
mod assemble;
mod backslip;
mod bends;
mod cells;
pub(crate) mod checks;
mod condensed;
mod coulomb;
pub mod cover;
mod diffusion;
pub mod fields;
mod floor;
mod heated;
mod held;
mod medium;
mod meet;
mod meshed;
mod mirror;
pub mod patches;
mod place;
mod placed;
mod plates;
mod point;
mod pressing;
mod prestress;
mod pulses;
mod radiation;
mod receivers;
mod resolved;
mod rock;
mod sampled;
mod sense;
mod start_doubts;
mod steady;
mod untouched;
mod upright;
mod weight;

pub(crate) use asked::nothing_slides;
pub(crate) use assemble::views;
pub(crate) use backslip::fastest as fastest_plates;
pub(crate) use meshed::Meshed;
pub use place::places;
pub(crate) use placed::{Placed, in_space, slides};
pub(crate) use pulses::{doubts as pulse_doubts, pulses};
pub(crate) use resolved::resolved;

use super::bodies::BodiesView;
use super::plan::Plan;
use super::receivers::Receivers;
use super::stresses::BodyStresses;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Creep, Fault as Spec, Kinematics, Scene};
use crate::shared::checks::of_model::{self, machines};
use crate::shared::held::Held;
use crate::shared::loading::{self, Stage};
use crate::shared::model::{self, Model, cuts, forecast, locking, meshes};
use crate::shared::setup::Setups;
use crate::shared::{amounts, resolution};
use apart::Spaced;
use asperity_cycles::medium::{Bodies, Conditions, Loads, Place, Point, Refusal, Spring, least_bytes};
use asperity_cycles::operator::{Form, Operator};
use asperity_cycles::{Loading, deficit};
use asperity_fem::table::Table;
use asperity_mechanics::Travel;
use asperity_run::Warning;
use assemble::{Around, Surrounded, plan_of, turns};
use condensed::Condensed;
use fields::Fields;
use held::Asked;
use medium::Media;
use point::{Given, base_law, placed_at};
use prestress::Prestress;

/// Plans a scene whose stepper is "fault-ode".
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan(scene: &Scene) -> Result<Plan, Diagnostic> {
    plan_with(scene, Form::Fitting)
}

/// Plans such a scene with set-ups that are kept.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan_beside(scene: &Scene, setups: &Setups) -> Result<Plan, Diagnostic> {
    plan_of_kind(scene, (Form::Fitting, setups))
}

/// Plans such a scene with the operator in the given form.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan_with(scene: &Scene, form: Form) -> Result<Plan, Diagnostic> {
    plan_of_kind(scene, (form, &Setups::none()))
}

fn plan_of_kind(scene: &Scene, form: (Form, &Setups)) -> Result<Plan, Diagnostic> {
    match scene.kinematics.get_ref() {
        Kinematics::Antiplane | Kinematics::PlaneStrain => plan_in::<2>(scene, form),
        Kinematics::ThreeD => plan_in::<3>(scene, form),
        other => Err(Diagnostic::at(
            scene.kinematics.span(),
            format!("faults in {} are not integrated yet", other.words()),
            "\"antiplane\", \"plane-strain\" and \"3d\" are",
        )),
    }
}

/// Refuses faults with so many points that the condensed matrix alone exceeds the memory, before the cell matrices are computed.
/// In a mirror, motions across the faults are no unknowns.
fn admit<const D: usize>(
    asked: Asked<'_, D>,
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

fn plan_in<const D: usize>(scene: &Scene, form: (Form, &Setups)) -> Result<Plan, Diagnostic> {
    match &scene.medium {
        Some(medium) => rock::plan::<D>(scene, medium, form),
        None => between_bodies::<D>(scene, form),
    }
}

/// Note on bodies of which one stands for both.
const MIRRORED: &str =
    "the bodies and their loads are antisymmetric about the fault: one side is condensed for both";

/// The stage before that presses the bodies, if there is one, and the stage of the run; `None` for another number of stages.
fn parted(stages: &[Stage]) -> Option<(Option<&Stage>, &Stage)> {
    match stages {
        [stage] => Some((None, stage)),
        [pressing, stage] => Some((Some(pressing), stage)),
        _ => None,
    }
}

/// The bodies, which must be linear.
fn linear<const D: usize>(scene: &Scene) -> Result<Model<D>, Diagnostic> {
    let model = model::build::<D>(scene)?;
    match model.bodies.iter().find(|b| b.nonlinear.is_some()) {
        Some(body) => Err(asked::not_linear(scene, &body.name)),
        None => Ok(model),
    }
}

/// Plans faults between bodies.
fn between_bodies<const D: usize>(
    scene: &Scene,
    (form, setups): (Form, &Setups),
) -> Result<Plan, Diagnostic> {
    let mut model = linear::<D>(scene)?;
    let stages = loading::stages(scene, &model)?;
    let (pressing, stage) = parted(&stages).ok_or_else(|| asked::stages(scene))?;
    let mut warnings = scene.warnings.clone();
    warnings.extend(locking::doubts(scene, &model)?);
    let (placed, mut notes) = all_points(scene, &model, &mut warnings)?;
    let points: Vec<Point<D>> = placed.iter().map(|p| p.point.clone()).collect();
    let named: Vec<(&String, &Spec)> = scene.faults.iter().collect();
    if points.iter().all(|p| p.creep.is_some()) {
        return Err(asked::nothing_slides(&named, &placed));
    }
    // If weight or a stage before presses the bodies, normal tractions are known only once their equations are solved.
    let known = stage.weight.is_empty() && pressing.is_none();
    let early = known.then(|| resolved(scene, &placed, &mut warnings)).transpose()?;
    let (of_bodies, held) = (of_model::of(scene, &model)?, Held::by(&model));
    warnings.extend(upright::held_above(scene, &model));
    let conditions = conditions(scene, stage, model.idealisation.components());
    let at_rest = vec![0.0; model.dofs()];
    // Weight acts while the bodies are pressed, or else before the start.
    let weight = if pressing.is_none() { stage.weight.clone() } else { Vec::new() };
    let mut loads = loads(stage, &at_rest, weight);
    let mirror = if conditions.keep { None } else { mirror::of(&model, &points) };
    let asked = Asked { scene, model: &model, loads: &loads, points: &points };
    admit(asked, conditions, mirror.is_some())?;
    let bodies = model.take_stiffness();
    let faults: Vec<usize> = placed.iter().map(|p| p.fault).collect();
    let asked = Asked { scene, model: &model, loads: &loads, points: &points };
    let inputs = setups.hash(|key| condensed::of_stiffness(key, &bodies));
    let pressed = pressing
        .map(|stage| pressing::solve(asked, stage, &faults, (&bodies, conditions), (setups, &inputs)))
        .transpose()?;
    if let Some(pressed) = &pressed {
        loads = self::loads(stage, &pressed.displacement, Vec::new());
    }
    let free: Vec<usize> = (0..points.len()).filter(|&k| points[k].creep.is_none()).collect();
    let asked = Asked { scene, model: &model, loads: &loads, points: &points };
    let (creeping, mut placed): (Vec<_>, Vec<_>) = placed.into_iter().partition(|p| p.point.creep.is_some());
    let how = (conditions, mirror.as_ref(), form);
    let mut condensed = condensed::of((asked, &placed), bodies, how, (setups, inputs))?;
    notes.extend(condensed.mirrored.then(|| MIRRORED.to_string()));
    let plates = backslip::plates(scene, &placed, conditions.tangents);
    let (opening, weight) = (condensed.opening.take(), condensed.weight.take());
    let (bytes, bodies) = (condensed.bytes, condensed.bodies.take());
    let receivers = receivers(scene, (&model, &points), bodies.as_ref(), (&plates, conditions.tangents))?;
    let bodies = bodies.filter(|_| displaced(scene, stage));
    let driven = driven(scene, (&model, stage), (&placed, &creeping), (condensed, &plates));
    warnings.extend(driven.warnings);
    notes.extend(backslip::notes(scene));
    notes.extend(weight::press(scene, (&model, stage), weight.as_ref(), &mut placed)?);
    if let Some(pressed) = &pressed {
        notes.extend(pressing::start(scene, pressed, &free, &mut placed)?);
    }
    let resolution = early.map_or_else(|| resolved(scene, &placed, &mut warnings), Ok)?;
    asked::opens(&named, &placed, opening.as_ref().map_or(&[], |o| o.points()))?;
    let sides = placed.iter().map(|p| [p.point.place.minus, p.point.place.plus]).collect();
    let areas = placed.iter().map(|p| p.point.place.area).collect();
    let around = Around {
        medium: "condensed onto the faults",
        dofs: model.dofs(),
        creeping: creeping.len(),
        memory_bytes: held.with_faults(bytes),
        bodies: bodies.map(|bodies| BodiesView::new((bodies, plates), &model, sides, shown(scene))),
        sampling: sampled::of::<D>(scene, stage, pressed.as_ref(), areas)?,
        stresses: stresses::<D>(scene)?,
        resolution,
        warnings,
        notes,
        prescribed: checks::counted(scene, &creeping),
        machines: machines(stage, &checks::surfaces(scene, &placed)),
        loading: stage.largest_rate().max(backslip::fastest(scene)),
        checks: of_bodies,
    };
    let Driven { operator, loading, .. } = driven;
    let surrounded = Surrounded { operator, placed, opening, loading, end: stage.end };
    Ok(Plan { receivers, ..plan_of(scene, surrounded, around, &Meshed { model: &model })? })
}

/// Positions in the bodies whose motion is written.
fn receivers<const D: usize>(
    scene: &Scene,
    around: (&Model<D>, &[Point<D>]),
    bodies: Option<&Bodies>,
    lag: (&[f64], usize),
) -> Result<Receivers, Diagnostic> {
    match bodies.filter(|_| !scene.output.receivers.is_empty()) {
        Some(bodies) => receivers::of(scene, around, bodies, lag),
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
struct Driven {
    operator: Box<dyn Operator>,
    loading: Loading,
    warnings: Vec<Warning>,
}

/// Operator and loads of faults in their surroundings, with warnings about loads and creep; points either slide or creep, and
/// those that slide may lag behind plates with these rates \[m/s\].
fn driven<const D: usize>(
    scene: &Scene,
    (model, stage): (&Model<D>, &Stage),
    (placed, creeping): (&[Placed<D>], &[Placed<D>]),
    (condensed, plates): (Condensed, &[f64]),
) -> Driven {
    let of_sides = plates::check(scene, (model, stage), (placed, creeping), &condensed);
    let Condensed { operator, mut loading, .. } = condensed;
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
    Driven { operator, loading, warnings }
}

/// Points of all faults, and notes on them.
pub(crate) fn all_points<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    warnings: &mut Vec<Warning>,
) -> Result<(Vec<Placed<D>>, Vec<String>), Diagnostic> {
    let mut placed: Vec<Placed<D>> = Vec::new();
    apart::check(scene, &apart::faces::cells(scene, model)?, Spaced::Apart)?;
    let mut notes = meshes::notes(scene)?;
    notes.extend(cuts::notes(scene, &model.mesh));
    notes.extend(meshes::left_out(model));
    for (k, (name, spec)) in scene.faults.iter().enumerate() {
        placed.extend(points_of(scene, model, (name, spec), k, (&mut *warnings, &mut notes))?);
    }
    for fault in &scene.faults {
        notes.extend(bends::note(model, (fault.0, fault.1))?);
    }
    untouched::check(scene, model, &placed)?;
    notes.extend(meet::join(scene, model, &mut placed)?);
    Ok((placed, notes))
}

fn points_of<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    (name, spec): (&str, &Spec),
    fault: usize,
    (warnings, notes): (&mut Vec<Warning>, &mut Vec<String>),
) -> Result<Vec<Placed<D>>, Diagnostic> {
    let base = base_law(spec)?;
    let mut placed = Vec::new();
    let media = Media::new(scene, model, spec)?;
    let spacings = resolution::spacings(model, model::sides(model, &spec.minus)?);
    let stress = Prestress::new(scene, (name, spec));
    let weighs = scene.bodies.values().any(|b| b.gravity.is_some());
    let (places, doubtful) = place::places(model, name, spec)?;
    warnings.extend(doubtful);
    let fields = Fields::read(scene, (name, spec, &base), &places)?;
    for place in places {
        let creep = spec.creep.as_ref().filter(|c| creeps(c, &place, CLOSE * model.scale));
        let given = stress.as_ref().filter(|_| creep.is_none());
        let given = Given {
            medium: media.at(&place),
            spacing: spacings.get(&place.minus).copied().unwrap_or_default(),
            stress: given.map(|s| s.start(model, &place, weighs)).transpose()?,
            // With backslip, what creeps does so with the plates, behind which it does not lag.
            creep: creep.map(|c| if c.is_backslip() { 0.0 } else { c.rate.get_ref().0 }),
            components: model.idealisation.components(),
        };
        placed.push(placed_at(spec, (fault, &base, &fields), place, given)?);
    }
    fields.describe(&placed, (warnings, notes));
    asked::creep((name, spec), &placed)?;
    asked::profiles(scene, (name, spec), &placed, warnings)?;
    warnings.extend(patches::covered((name, spec), &placed)?);
    Ok(placed)
}

/// Distance from the boundary of the creeping part within which a point counts as on it, relative to the size of the
/// model: rounding.
const CLOSE: f64 = 1e-12;

/// True if slip is prescribed at a point; includes points within `close` \[m\] of the boundary.
fn creeps<const D: usize>(creep: &Creep, place: &Place<D>, close: f64) -> bool {
    if let Some(beyond) = &creep.beyond {
        return place.along >= beyond.get_ref().0 - close;
    }
    let ranges = creep.outside.as_ref().map(|o| o.get_ref().ranges()).unwrap_or_default();
    place.at.iter().zip(ranges).any(|(x, range)| {
        let (from, to) = range.map_or((None, None), |r| (r.from, r.to));
        from.is_some_and(|l| *x <= l.0 + close) || to.is_some_and(|l| *x >= l.0 - close)
    })
}
