//! End of a run that cannot go on: the words about it, and if it met an instability.

use crate::report::{Outcome, Stop};
use asperity_contact::Interface;
use asperity_fem::term::Objection;
use asperity_mechanics::{Assembled, Failure, coordinates};

/// Remedies for an instability.
const REMEDY: &str = "the last state before it is kept. Stiffer bodies or supports, or a larger length of weakening (`l`, `d_c`), \
    are stable; events are followed where waves or inertia carry them: `[faults.NAME]`, or `kinematics = \"spring-slider\"` with \
    `damping` or `mass`";

/// Trials of steps that failed after which a run with a penalty far beyond the stiffness of its bodies ends: one set of contacts that changes
/// as a whole takes a few, and halving down to the smallest step 44.
const STALLED: usize = 20;
/// Steps to each of them up to which it does.
const SELDOM: usize = 4;

/// Parts of a metre in which a place is told: nanometres, so that rounding does not show.
const SHOWN: f64 = 1e9;

/// The outcome of a step that failed at its shortest, of length `dt` \[s\]; `free` tells of a motion nothing holds, `fast` whether slip has left
/// what loads drive behind.
pub fn failed<const D: usize>(
    system: &Assembled<'_, D>,
    stage: &str,
    failure: &Failure,
    dt: f64,
    free: Option<String>,
    fast: bool,
) -> Outcome {
    let (time, stage) = (system.time(), stage.to_string());
    let words = system.in_words(failure);
    if let Failure::Objected(objection) = failure {
        if objection.coarse {
            return coarse(system, stage, found(objection), &objection.reason);
        }
        let reason = if objection.shorter { format!("{words} (in {dt:.3e} s)") } else { words };
        return unstable(system, stage, found(objection), &reason);
    }
    let mut reason = words;
    if !failure.always() {
        reason += &format!("; the step was halved to {dt:.3e} s without success");
        if let Some(at) = weakest(system).or_else(|| fastest(system).filter(|_| fast)) {
            let reason = format!("{}: no equilibrium near the last one was found: {reason}", at.interface);
            return unstable(system, stage, at, &reason);
        }
    }
    // Shorter steps may fail otherwise than the first did: what that one found is told.
    if let Some(free) = free {
        reason += &format!("; {free}");
    }
    Outcome::Stopped { stage: Some(stage), time, reason, kind: Stop::NotConverged }
}

/// The outcome of a run whose iterations fail again and again for a penalty that is far too large, where they do.
pub fn stalled<const D: usize>(
    system: &Assembled<'_, D>,
    stage: &str,
    failure: &Failure,
    (steps, rejected): (usize, usize),
) -> Option<Outcome> {
    let by_accuracy = matches!(failure, Failure::Inaccurate { .. } | Failure::Objected(_));
    if by_accuracy || rejected < STALLED || steps > SELDOM * rejected {
        return None;
    }
    let blamed = system.blamed()?;
    let reason = format!(
        "{rejected} trials of steps failed, beside {steps} that stand: {blamed}. The last of them: {}",
        system.in_words(failure)
    );
    Some(Outcome::Stopped {
        stage: Some(stage.to_string()),
        time: system.time(),
        reason,
        kind: Stop::NotConverged,
    })
}

/// The outcome of a run whose error of slip asks for steps of `needed` \[s\], below the smallest allowed. `faster` tells whether slip
/// accelerates.
pub fn exhausted<const D: usize>(
    system: &Assembled<'_, D>,
    stage: &str,
    (needed, smallest): (f64, f64),
    faster: bool,
) -> Outcome {
    let stage = stage.to_string();
    let reason = if needed < smallest {
        format!(
            "the error of slip needs steps of {needed:.3e} s, below the smallest allowed, {smallest:.3e} s (`min_step`)"
        )
    } else {
        format!("slip needs steps shorter than the smallest allowed, {smallest:.3e} s (`min_step`)")
    };
    match fastest(system) {
        Some(at) if faster => unstable(system, stage, at, &reason),
        at => {
            let place =
                at.map_or_else(String::new, |at| format!("; the fastest point is {}", at.words::<D>()));
            let reason = format!("{reason}{place}; allow shorter ones, or a larger `tolerance`");
            Outcome::Stopped { stage: Some(stage), time: system.time(), reason, kind: Stop::SmallestStep }
        }
    }
}

/// Place of an instability.
struct Met {
    interface: String,
    position: [f64; 3],
    /// In the state that was not accepted \[m/s\].
    slip_rate: f64,
}

impl Met {
    /// Place and slip rate.
    fn words<const D: usize>(&self) -> String {
        let place = std::array::from_fn(|c| (self.position[c] * SHOWN).round() / SHOWN);
        format!("at {}, V = {:.3e} m/s", coordinates::in_words::<D>(&place), self.slip_rate)
    }
}

fn unstable<const D: usize>(system: &Assembled<'_, D>, stage: String, met: Met, what: &str) -> Outcome {
    if is_coarse(system, &met) {
        return coarse(system, stage, met, what);
    }
    let time = system.time();
    let reason = format!("instability {}: {what}; {REMEDY}", met.words::<D>());
    let Met { interface, position, slip_rate } = met;
    Outcome::Stopped {
        stage: Some(stage),
        time,
        reason,
        kind: Stop::Instability { interface, position, slip_rate },
    }
}

/// The outcome of a step in which a point would slide that its neighbours do not resolve.
fn coarse<const D: usize>(system: &Assembled<'_, D>, stage: String, met: Met, what: &str) -> Outcome {
    let remedy = system.resolved(&met.interface).map_or_else(String::new, |r| format!("; {}", r.limit));
    let reason = format!(
        "less than one point stands on the length over which friction falls {}: {what}{remedy}",
        met.words::<D>()
    );
    let Met { interface, position, .. } = met;
    Outcome::Stopped {
        stage: Some(stage),
        time: system.time(),
        reason,
        kind: Stop::UnderResolved { interface, position },
    }
}

/// True if a point is pressed more than its neighbours resolve, and the scene does not allow it: what loses its strength there is a point of the mesh.
fn is_coarse<const D: usize>(system: &Assembled<'_, D>, met: &Met) -> bool {
    let most = system.resolved(&met.interface).and_then(|r| r.refused_beyond);
    let normal = |i: &Interface<D>| {
        let point = (0..i.points().normal_traction.len()).find(|&p| i.place(p) == met.position)?;
        i.points().normal_traction.get(point).copied()
    };
    let mut own = system.interfaces().iter().filter(|i| asperity_fem::term::Term::name(*i) == met.interface);
    let normal = own.find_map(normal);
    most.zip(normal).is_some_and(|(most, normal)| normal > most)
}

fn found(objection: &Objection) -> Met {
    Met { interface: objection.term.clone(), position: objection.position, slip_rate: objection.rate }
}

fn at<const D: usize>(interface: &Interface<D>, point: usize, slip_rate: f64) -> Met {
    Met {
        interface: asperity_fem::term::Term::name(interface).to_string(),
        position: interface.place(point),
        slip_rate,
    }
}

/// The point that lost strength in the trial that failed last.
fn weakest<const D: usize>(system: &Assembled<'_, D>) -> Option<Met> {
    let rate = |i: &Interface<D>, p: usize| i.points().slip_rate.get(p).map_or(0.0, |v| v.abs());
    system.interfaces().iter().find_map(|i| i.weakens().map(|p| at(i, p, rate(i, p))))
}

/// The point that slips fastest.
fn fastest<const D: usize>(system: &Assembled<'_, D>) -> Option<Met> {
    let each = system.interfaces().iter().filter_map(|i| i.fastest().map(|(p, rate)| at(i, p, rate)));
    each.reduce(|a, b| if b.slip_rate > a.slip_rate { b } else { a })
}
