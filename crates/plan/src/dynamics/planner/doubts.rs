//! Settings of runs with waves that are probably not intended.

use super::forced_rupture;
use super::steps::StepChoice;
use crate::doubts::{self as shared, PulsePoint};
use crate::faults::planner::{PlacedPoint, pulse_doubts};
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Fault as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::model::Model;
use crate::shared::words::time;
use asperity_fem::nonlinear::Material;
use asperity_laws as laws;
use asperity_mechanics::dynamics::Fault;
use asperity_mechanics::{CellBlock, Stage, bounds};
use asperity_run::Warning;
use asperity_scene::defaults;
use std::ops::Range;

/// Steps from which a run is taken for a slip of unit: a day at a thousand steps per second.
const MANY: usize = 100_000_000;

/// Share of the points of a fault that may start above their strength: a patch that nucleates is small.
const MOST: f64 = 0.5;

/// Shear over normal traction that no fault has which should rupture: friction is a hundred times as large even where it is lowest.
const TINY: f64 = 1e-4;

/// Shear over normal traction beyond which no friction of rock holds a fault.
const MOST_FRICTION: f64 = 1.0;

/// Time of the viscosity of steps over a relaxation time of rock, beyond which they are one: their effects have this ratio.
const OUTDAMPED: f64 = 0.02;

/// Share of its points that a forced rupture should weaken within a run.
const HALF: f64 = 0.5;

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
        all.extend(unheld(Entry::new(name, spec), &own));
        all.extend(ruptured(scene, Entry::new(name, spec), &own));
        all.extend(slow_front(Entry::new(name, spec), &own, *steps as f64 * dt));
        let Some(above) = own.iter().map(|p| above(p)).sum::<Option<usize>>() else {
            pushed = true;
            continue;
        };
        let begins = above > 0 || !spec.pulses.is_empty() || spec.forced_rupture.is_some();
        pushed |= begins;
        if above as f64 > MOST * own.len() as f64 {
            all.push(at_once(Entry::new(name, spec), above, own.len()));
        }
        all.extend(tiny(Entry::new(name, spec), &own));
        all.extend(begins.then(|| undriven(Entry::new(name, spec), &own)).flatten());
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

/// A time in which waves should not come back.
pub(super) struct QuietTime {
    /// Place in the scene that says so.
    pub place: Range<usize>,
    /// Name of what lasts as long.
    pub what: &'static str,
    /// Duration \[s\].
    pub duration: f64,
}

/// Warning about bodies whose sides all return the waves of a fault too soon. `speed` is that of shear waves \[m/s\].
pub(super) fn returned<const D: usize>(
    model: &Model<D>,
    placed: &[PlacedPoint<D>],
    speed: f64,
    QuietTime { place, what, duration }: QuietTime,
) -> Option<Warning> {
    let middle = &placed.get(placed.len() / 2)?.point.place;
    let (min, max) = bounds(&model.mesh.nodes);
    // To the side of the box of all bodies, along the normal and against it.
    let distance = |sign: f64| {
        let along = |c: usize| {
            let n = sign * middle.normal[c];
            let side = if n > 0.0 { max[c] } else { min[c] };
            if n == 0.0 { f64::INFINITY } else { (side - middle.at[c]) / n }
        };
        (0..D).map(along).fold(f64::INFINITY, f64::min)
    };
    let back = 2.0 * distance(1.0).min(distance(-1.0)) / speed;
    (back < duration).then(|| {
        Warning::at(
            place,
            format!(
                "no side absorbs waves: shear waves of the faults come back from the sides after {}, and {what} lasts {}",
                time(back),
                time(duration)
            ),
            "give sides where rock goes on `absorbing = true` among the conditions; in a wider model waves come back later",
        )
    })
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
        let (direct, length) = match &p.law {
            LawChoice::Rate { strength, .. } => (Some(strength.a * p.normal), None),
            LawChoice::RateAndState { strength, states, .. } => {
                (Some(strength.a * p.normal), states.iter().map(|s| s.l).reduce(f64::min))
            }
            LawChoice::Yielding { .. } => (None, None),
        };
        let begins = length.map(|l| p.rate.abs() * duration / l);
        let strength = strength(p).map(|strength| (strength, p.shear.unwrap_or_default()));
        PulsePoint { amplitude: 0.0, normal: p.normal, direct, strength, begins }
    };
    let pushed: Vec<PulsePoint> = placed.iter().map(of).collect();
    pulse_doubts(&named, fault.pulses.iter().map(|p| p.amplitude.as_slice()), &pushed, duration)
}

/// Position of the shear traction of a fault in the scene, or of its law without one.
fn shear_place(spec: &Spec) -> Range<usize> {
    spec.shear.as_ref().map_or_else(|| spec.law.span(), |s| s.span())
}

/// Warning about a fault that a shear traction loads which no friction holds.
fn unheld<const D: usize>(Entry { name, spec }: Entry<'_, Spec>, own: &[&PlacedPoint<D>]) -> Option<Warning> {
    let ratio = |p: &&PlacedPoint<D>| (p.shear.unwrap_or_default().abs() - cohesion(p)) / p.normal;
    let largest = own.iter().filter(|p| p.normal > 0.0).map(ratio).reduce(f64::max)?;
    (largest > MOST_FRICTION).then(|| {
        Warning::at(
            shear_place(spec),
            format!("the shear traction of fault `{name}` is up to {largest:.2} times its normal traction at the start: no friction holds it"),
            "check the units of `shear` and `normal`, and those of patches and profiles",
        )
    })
}

/// Warning about a fault that slips at the start as fast as one that has ruptured.
fn ruptured<const D: usize>(
    scene: &Scene,
    Entry { name, spec }: Entry<'_, Spec>,
    own: &[&PlacedPoint<D>],
) -> Option<Warning> {
    let limit = scene.output.rupture_rate.as_ref().map_or(defaults::RUPTURED, |v| v.get_ref().0);
    let fastest = own.iter().map(|p| p.rate.abs()).reduce(f64::max)?;
    (fastest >= limit).then(|| {
        Warning::at(
            spec.rate.span(),
            format!("fault `{name}` slips at {fastest:e} m/s at the start, and a point has ruptured at {limit:e} m/s: its rupture times are zero"),
            "a lower rate at the start, or a higher `rupture_rate`",
        )
    })
}

/// Warning about a forced rupture that weakens fewer than half of its points within the run of this duration \[s\].
fn slow_front<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    own: &[&PlacedPoint<D>],
    run: f64,
) -> Option<Warning> {
    let forced = spec.forced_rupture.as_ref()?;
    let arrivals = own.iter().map(|p| forced_rupture::arrival(forced, &p.point.place.at));
    let arrivals: Vec<f64> = arrivals.filter(|at| at.is_finite()).collect();
    let weakened = arrivals.iter().filter(|at| *at + forced.duration.get_ref().0 <= run).count();
    ((weakened as f64) < HALF * arrivals.len() as f64).then(|| {
        Warning::at(
            forced.speed.span(),
            format!(
                "the forced rupture of fault `{name}` weakens {weakened} of the {} points within its radius before the run ends after {run:e} s",
                arrivals.len()
            ),
            "check `speed`, its `duration` and that of the stage",
        )
    })
}

/// Warning about a fault whose shear traction lies below its residual strength at all points, so that no rupture spreads.
fn undriven<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    own: &[&PlacedPoint<D>],
) -> Option<Warning> {
    let driven = |p: &&PlacedPoint<D>| {
        let shear = p.shear.unwrap_or_default().abs();
        let residual = p.law.value("mu_k", laws::known()).map(|mu| mu * p.normal + cohesion(p));
        residual.is_none_or(|residual| shear > residual) && above(p) == Some(0)
    };
    (!own.iter().any(driven)).then(|| {
        Warning::at(
            shear_place(spec),
            format!("the shear traction of fault `{name}` lies below its residual strength, `mu_k` times `normal`, wherever the fault does not slip at once: no rupture spreads"),
            "a rupture spreads where `shear` lies between `mu_k` and `mu_s` times `normal`",
        )
    })
}

fn at_once(Entry { name, spec }: Entry<'_, Spec>, above: usize, points: usize) -> Warning {
    Warning::at(
        shear_place(spec),
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

/// Cohesion of a point \[Pa\].
fn cohesion<const D: usize>(p: &PlacedPoint<D>) -> f64 {
    p.law.value("cohesion", laws::known()).unwrap_or_default()
}

/// Strength of a point at rest \[Pa\]; `None` for laws that slip at every traction. The first parameter of laws with an elastic domain
/// is the coefficient at rest.
fn strength<const D: usize>(p: &PlacedPoint<D>) -> Option<f64> {
    let LawChoice::Yielding { own, .. } = &p.law else { return None };
    Some(own.first()? * p.normal + cohesion(p))
}

/// One if a point starts above its strength; `None` for laws that slip at every traction.
fn above<const D: usize>(p: &PlacedPoint<D>) -> Option<usize> {
    Some(usize::from(p.shear.unwrap_or_default().abs() > strength(p)?))
}

/// Warns of cells that relax about as fast as the viscosity of steps acts in them, which is added to theirs.
pub(super) fn outdamped<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    viscosity: f64,
    dt: f64,
) -> Option<Warning> {
    let time_of = |block: &CellBlock<D>| match block {
        CellBlock::Nonlinear(block) => match &block.model().material {
            Material::Maxwell(maxwell) => Some(maxwell.shortest_time()),
            _ => None,
        },
        CellBlock::Linear(_) => None,
    };
    let relaxes = model.blocks.iter().filter_map(time_of).reduce(f64::min)?;
    let damps = viscosity * dt;
    (damps > OUTDAMPED * relaxes).then(|| {
        let place = scene.time.viscosity.as_ref().map_or(scene.time.stepper.span(), |v| v.span());
        let message = format!(
            "stress relaxes within {}, and the viscosity of steps, of a time of {}, is added to that of the rock",
            time(relaxes),
            time(damps)
        );
        Warning::at(place, message, "`viscosity = 0` in `[time]`, or smaller cells: steps are then shorter")
    })
}
