//! Initial tractions on faults whose bodies are pressed in a stage before.
//!
//! The bodies are in equilibrium at the end of that stage. The sides of a fault are joined meanwhile, or slide past each other
//! without friction. f_n and τ at the end are those with which the faults begin to slide; states of friction are those of steady slip
//! at `v_initial`, or at `rate`. What the stage holds stays held, or is drawn by a spring that takes over the force.

use super::condensation::{Condensation, HashedStiffness};
use super::condensation_refusals::CondensationInput;
use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::check;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Fault as Spec, Scene, Stage as StageSpec};
use crate::shared::entry::Entry;
use crate::shared::loading::Stage;
use asperity_cycles::Problem;
use asperity_cycles::medium::{PressedBodies, Pressing, press};
use asperity_fem::dof::Channel;
use asperity_fem::table::Table;
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use asperity_run::report::Part;
use std::collections::BTreeMap;

/// Fraction of the largest normal traction below which a traction is rounding of the solution.
const NOTHING: f64 = 1e-9;

/// Largest f_n over the stiffness of the rock: beyond it strains are not small.
const MOST: f64 = 0.1;

/// The bodies at the end of the stage that presses them.
///
/// # Errors
/// [`Diagnostic`] if nothing holds the bodies, or if supports do not agree with the faults.
pub(super) fn solve<const D: usize>(
    asked: CondensationInput<'_, D>,
    stage: &Stage,
    faults: &[usize],
    bodies: &HashedStiffness,
    Condensation { conditions, source, .. }: Condensation<'_>,
) -> Result<PressedBodies, Diagnostic> {
    let names: Vec<&String> = asked.scene.faults.keys().collect();
    let slides = |fault: &usize| stage.frictionless.contains(names[*fault]);
    let pressing = Pressing {
        fixed: stage.fixed.clone(),
        load: load(stage, asked.model.dofs()),
        slides: faults.iter().map(slides).collect(),
    };
    let setups = source.setups;
    let inputs = bodies.hash.as_ref().and_then(|hash| {
        let shape = (conditions.components, conditions.tangents);
        setups.hash(|key| key.value(hash).value(&pressing).value(&asked.points).value(&shape))
    });
    let press = || press(&bodies.stiffness, &pressing, asked.points, conditions).map_err(|e| asked.error(&e));
    setups.part(Part::Pressing, inputs, press)
}

/// Displacements and forces at the end of a stage that starts without any, weight included.
fn load(stage: &Stage, dofs: usize) -> Channel {
    let (mut prescribed, mut forces) = (BTreeMap::new(), BTreeMap::new());
    let add = |sum: &mut BTreeMap<usize, f64>, list: &[(usize, f64)], by: f64| {
        list.iter().for_each(|(dof, value)| *sum.entry(*dof).or_insert(0.0) += by * value);
    };
    for channel in stage.constraints(&vec![0.0; dofs]).channels {
        let amplitude = channel.amplitude.value(stage.end);
        add(&mut prescribed, &channel.prescribed, amplitude);
        add(&mut forces, &channel.forces, amplitude);
    }
    add(&mut forces, &stage.weight, 1.0);
    Channel {
        prescribed: prescribed.into_iter().collect(),
        forces: forces.into_iter().collect(),
        amplitude: Table::constant(1.0),
    }
}

/// Sets the initial tractions of the points that slide, numbers `free` of those that were pressed, and describes them.
///
/// # Errors
/// [`Diagnostic`] if a point is not pressed.
pub(super) fn start<const D: usize>(
    scene: &Scene,
    pressed: &PressedBodies,
    free: &[usize],
    placed: &mut [PlacedPoint<D>],
) -> Result<Vec<String>, Diagnostic> {
    let Some(stage) = check::pressing::stage(scene) else { return Ok(Vec::new()) };
    let (tractions, count) = (&pressed.tractions, pressed.tractions.normal.len());
    let small = NOTHING * tractions.normal.iter().fold(0.0, |l: f64, f| l.max(f.abs()));
    for (&k, point) in free.iter().zip(placed.iter_mut()) {
        point.normal = tractions.normal[k];
        let by_floor = point.floor.is_some_and(|floor| point.normal < floor);
        if point.normal <= small && !by_floor {
            return Err(not_pressed(scene, stage, point));
        }
        if point.normal > MOST * point.medium.stiffness {
            return Err(crushed(scene, stage, point));
        }
        if point.shear.is_none() {
            let second = tractions.shear.get(count + k).copied().unwrap_or(0.0);
            // Rounding has no direction.
            let of = |shear: f64| if shear.abs() <= small { 0.0 } else { shear };
            point.pressed_shear = Some([tractions.shear[k], second].map(of));
        }
    }
    let named = scene.faults.iter().enumerate();
    Ok(named
        .map(|(k, (name, spec))| words(stage, Entry::new(name, spec), placed.iter().filter(|p| p.fault == k)))
        .collect())
}

fn not_pressed<const D: usize>(scene: &Scene, stage: &StageSpec, point: &PlacedPoint<D>) -> Diagnostic {
    let name = scene.faults.keys().nth(point.fault).map_or("", String::as_str);
    let at = coordinates::in_words(&point.point.place.at);
    Diagnostic::at(
        stage.duration.span(),
        format!(
            "stage `{}` does not press fault `{name}` at {at}: its normal traction is {:.3e} Pa there",
            stage.name, point.normal
        ),
        "push the bodies together by `{ to = .. }` or `pressure`, and hold no point of the fault on both sides across it; or `normal_floor` at the fault",
    )
}

fn crushed<const D: usize>(scene: &Scene, stage: &StageSpec, point: &PlacedPoint<D>) -> Diagnostic {
    let name = scene.faults.keys().nth(point.fault).map_or("", String::as_str);
    let (normal, share) = (point.normal, point.normal / point.medium.stiffness);
    Diagnostic::at(
        stage.duration.span(),
        format!(
            "stage `{}` presses fault `{name}` with {normal:.3e} Pa, {share:.2} times the stiffness of its rock: strains are taken as small, and would not be",
            stage.name
        ),
        "check the units of what presses",
    )
}

/// Description of the tractions of a fault.
fn words<'a, const D: usize>(
    stage: &StageSpec,
    Entry { name, spec }: Entry<'_, Spec>,
    points: impl Iterator<Item = &'a PlacedPoint<D>> + Clone,
) -> String {
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
        format!("{low:.4} to {high:.4}")
    };
    let normal = range(&mut points.clone().map(|p| p.normal / 1e6));
    let frictionless = stage.frictionless.iter().any(|f| f.get_ref() == name);
    let sides = if frictionless { "slides without friction" } else { "is joined" };
    let mut text = format!(
        "stage `{}`: fault `{name}` {sides}, and is pressed with {normal} MPa at its end, from where the time of the run counts",
        stage.name
    );
    if spec.shear.is_some() || spec.has_shear_along() {
        text += "; its shear traction is as given";
    } else {
        let shear = range(&mut points.filter_map(|p| Some(p.pressed_shear?[0] / 1e6)));
        text += &format!(", and sheared with {shear} MPa");
    }
    text
}

/// Refuses a fault that has been joined and that friction would let slip as fast as in an event from the start.
///
/// # Errors
/// [`Diagnostic`] at the stage that presses, if a point slips as fast as events begin, or faster, at the start.
pub(super) fn rests<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    Problem { fault, start: unknowns, settings, .. }: &Problem,
) -> Result<(), Diagnostic> {
    let pressed = placed.iter().any(|p| p.pressed_shear.is_some());
    let Some(stage) = check::pressing::stage(scene).filter(|_| pressed) else { return Ok(()) };
    let rate = fault.slip_rates(unknowns);
    let speed = |p: usize| rate.size(p);
    let fast = (0..placed.len()).max_by(|&a, &b| speed(a).total_cmp(&speed(b)));
    let Some(p) = fast.filter(|&p| speed(p) >= settings.thresholds.on || !speed(p).is_finite()) else {
        return Ok(());
    };
    let name = scene.faults.keys().nth(placed[p].fault).map_or("", String::as_str);
    let [first, second] = placed[p].pressed_shear.unwrap_or_default();
    Err(Diagnostic::at(
        stage.duration.span(),
        format!(
            "fault `{name}` is joined in stage `{}`, which shears it by {:.3} of its normal traction at {}: friction lets it slip at {:.1e} m/s at once",
            stage.name,
            first.hypot(second) / placed[p].pressed(),
            coordinates::in_words(&placed[p].point.place.at),
            speed(p)
        ),
        format!(
            "let it slide without friction while it is pressed, `frictionless = [\"{name}\"]` in the stage, or hold less of the bodies along it"
        ),
    ))
}

/// Warnings about slip rates at the start of faults that have been pressed: these follow from friction, whose states are those of
/// `v_initial`, and of `rate` only the sense counts.
pub(super) fn unused_rates<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Vec<Warning> {
    let of = |(k, (name, spec)): (usize, (&String, &Spec))| {
        let pressed = placed.iter().find(|p| p.fault == k && p.pressed_shear.is_some())?;
        let same = match &pressed.law {
            LawChoice::RateAndState { v_initial, .. } => *v_initial == spec.rate.get_ref().0.abs(),
            // Without states, slip at `rate` is what friction is taken from.
            _ => true,
        };
        (!same && !spec.rate.span().is_empty()).then(|| {
            let message = format!(
                "`rate` of fault `{name}` is not used but for its sign: it is pressed and sheared before, and slips as friction then lets it"
            );
            let help = "`v_initial` of the law sets the states at the start; give `rate` the same size, or `shear` to start from `rate`";
            Warning::at(spec.rate.span(), message, help)
        })
    };
    scene.faults.iter().enumerate().filter_map(of).collect()
}
