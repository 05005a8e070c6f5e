//! Settings of runs with waves that are probably not intended.

use super::steps::StepChoice;
use crate::doubts::{self as shared, PulsePoint};
use crate::faults::planner::{PlacedPoint, pulse_doubts};
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Fault as Spec, Scene};
use crate::shared::entry::Entry;
use asperity_laws as laws;
use asperity_mechanics::Stage;
use asperity_mechanics::dynamics::Fault;
use asperity_run::Warning;

/// Steps from which a run is taken for a slip of unit: a day at a thousand steps per second.
const MANY: usize = 100_000_000;

/// Share of the points of a fault that may start above their strength: a patch that nucleates is small.
const MOST: f64 = 0.5;

/// Shear over normal traction that no fault has which should rupture: friction is a hundred times as large even where it is lowest.
const TINY: f64 = 1e-4;

/// Warns of very many steps, of faults that slip as a whole at once, and of faults that nothing moves.
pub(super) fn check<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    stage: &Stage,
    StepChoice { steps, dt, .. }: &StepChoice,
) -> Vec<Warning> {
    let mut all = Vec::new();
    if *steps > MANY {
        all.push(Warning::at(
            scene.stages[0].duration.span(),
            format!("the stage takes {steps} steps of {dt:.3e} s"),
            "steps follow waves: give a duration of seconds, or use the stepper \"fault-ode\"",
        ));
    }
    let mut pushed = stage.is_loaded() || !stage.motions.is_empty() || stage.has_loads();
    for (k, (name, spec)) in scene.faults.iter().enumerate() {
        let own: Vec<&PlacedPoint<D>> = placed.iter().filter(|p| p.fault == k).collect();
        let Some(above) = own.iter().map(|p| above(p)).sum::<Option<usize>>() else {
            pushed = true;
            continue;
        };
        pushed |= above > 0 || !spec.pulses.is_empty() || spec.forced_rupture.is_some();
        if above as f64 > MOST * own.len() as f64 {
            all.push(at_once(Entry::new(name, spec), above, own.len()));
        }
        all.extend(tiny(Entry::new(name, spec), &own));
    }
    if let (false, Some((_, first))) = (pushed, scene.faults.first_key_value()) {
        all.push(Warning::at(
            first.law.span(),
            "nothing moves the faults: no point starts above its strength, and nothing is imposed",
            "`pulses`, `forced_rupture`, or a patch of `shear` above `mu_s` times `normal`",
        ));
    }
    all
}

/// Warnings about faults between unlike rocks whose friction follows the normal traction at once.
pub(super) fn unlike<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>], delays: bool) -> Vec<Warning> {
    let remembers = |p: &PlacedPoint<D>| match &p.law {
        LawChoice::RateAndState { states, .. } => states.iter().any(|s| s.alpha > 0.0),
        _ => false,
    };
    let of = |(k, (name, spec)): (usize, (&String, &Spec))| {
        // In antiplane motion slip changes no normal traction.
        let own = placed.iter().filter(|p| p.fault == k && p.components > 1 && !remembers(p));
        let contrast = own.map(|p| p.medium.contrast).fold(0.0, f64::max);
        let bare = spec.normal_delay.is_none();
        if bare { shared::unlike(name, spec.law.span(), contrast, delays) } else { None }
    };
    scene.faults.iter().enumerate().filter_map(of).collect()
}

/// Doubts about the pulses of a run of this duration \[s\].
pub(super) fn pulses<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    fault: &Fault,
    duration: f64,
) -> Vec<Warning> {
    let named = Entry::all(&scene.faults);
    let of = |p: &PlacedPoint<D>| {
        let (direct, missing, length) = match &p.law {
            LawChoice::Rate { strength, .. } => (Some(strength.a * p.normal), None, None),
            LawChoice::RateAndState { strength, states, .. } => {
                let length = states.iter().map(|s| s.l).reduce(f64::min);
                (Some(strength.a * p.normal), None, length)
            }
            LawChoice::Yielding { own, .. } => {
                let strength = own.first().map(|mu| mu * p.normal);
                (None, strength.map(|s| s - p.shear.unwrap_or_default().abs()), None)
            }
        };
        let begins = length.map(|l| p.rate.abs() * duration / l);
        PulsePoint { amplitude: 0.0, normal: p.normal, direct, missing, begins }
    };
    let pushed: Vec<PulsePoint> = placed.iter().map(of).collect();
    pulse_doubts(&named, fault.pulses.iter().map(|p| p.amplitude.as_slice()), &pushed)
}

fn at_once(Entry { name, spec }: Entry<'_, Spec>, above: usize, points: usize) -> Warning {
    let place = spec.shear.as_ref().map_or_else(|| spec.law.span(), |s| s.span());
    Warning::at(
        place,
        format!("{above} of {points} points of fault `{name}` start above their strength and slip at once"),
        "a rupture spreads where `shear` is below `mu_s` times `normal` but in a patch",
    )
}

/// Warning about a shear traction that hardly loads a fault: a unit that was left out.
fn tiny<const D: usize>(Entry { name, spec }: Entry<'_, Spec>, own: &[&PlacedPoint<D>]) -> Option<Warning> {
    let given = spec.shear.as_ref()?;
    let traction = given.get_ref().0.abs();
    let least = own.iter().map(|p| p.normal).reduce(f64::min)?;
    (traction > 0.0 && traction < TINY * least).then(|| {
        Warning::at(
            given.span(),
            format!("the shear traction of fault `{name}` is {traction:e} Pa where the normal traction is {least:e} Pa or more: it hardly loads the fault"),
            "give it with a unit, such as \"70 MPa\"; without one it is in Pa",
        )
    })
}

/// One if a point starts above its strength; `None` for laws that slip at every traction. The first parameter of laws with an elastic
/// domain is the coefficient at rest.
fn above<const D: usize>(p: &PlacedPoint<D>) -> Option<usize> {
    let LawChoice::Yielding { own, .. } = &p.law else { return None };
    let cohesion = p.law.value("cohesion", laws::known()).unwrap_or_default();
    let strength = own.first()? * p.normal + cohesion;
    Some(usize::from(p.shear.unwrap_or_default().abs() > strength))
}
