//! Outcomes of runs that cannot continue: their description, and whether an instability caused them.

use asperity_contact::Interface;
use asperity_fem::term::Objection;
use asperity_mechanics::step::StepLengths;
use asperity_mechanics::{AssembledProblem, Failure, coordinates};
use asperity_run::report::{Outcome, Stop};

/// Remedies for an instability.
const REMEDY: &str = "the last state before it is kept. Stiffer bodies or supports, or a larger length of weakening (`l`, `d_c`), \
    are stable";
/// Remedy at an interface without damping.
const DAMPING: &str = "`damping = \"radiation\"` at the interface, or with ";

/// Number of failed trials after which a run with a penalty far above the stiffness of its bodies ends. A contact set that changes as a whole takes a
/// few, and halving down to the smallest step takes 44.
const STALLED: usize = 20;
/// Largest number of steps per failed trial for which it ends.
const SELDOM: usize = 4;

/// Parts of a metre to which a position is printed: nanometres, so that rounding does not show.
const SHOWN: f64 = 1e9;

/// Outcome of a step that failed at its shortest length `dt` \[s\]. `free` describes a motion that nothing restrains, or why contact restrains it no longer; `fast` is true if slip is
/// faster than the loads drive it.
pub fn failed<const D: usize>(
    system: &AssembledProblem<'_, D>,
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
        if let Some(interface) = system.lifting() {
            reason += &format!(
                "; points of interface `{interface}` slip as fast as in an event while others are open, and one that lifts off radiates no more, at once: \
                 `stepper = \"auto\"`, or inertia from the start, follows that"
            );
        }
        if let Some(at) = weakest(system).or_else(|| fastest(system).filter(|_| fast)) {
            let reason = format!("{}: no equilibrium near the last one was found: {reason}", at.interface);
            return unstable(system, stage, at, &reason);
        }
    }
    if let (None, Some(interface), false) = (&free, system.cohesive(), failure.always()) {
        reason += &format!(
            "; points of interface `{interface}` that slide under cohesion lose it at once where they lift off, which no step of this stepper follows: \
             `stepper = \"static-explicit\"` does"
        );
    }
    // Shorter steps may fail differently than the first; the motion that the first one found is reported.
    if let Some(free) = free {
        reason += &format!("; {free}");
    }
    Outcome::Stopped { stage: Some(stage), time, reason, kind: Stop::NotConverged }
}

/// Numbers of steps that stand, and of trials that were rejected.
#[derive(Clone, Copy, Debug)]
pub struct Trials {
    /// Steps.
    pub steps: usize,
    /// Rejected trials.
    pub rejected: usize,
}

/// Outcome of a run whose iterations fail repeatedly because a penalty is far too large; `None` otherwise.
pub fn stalled<const D: usize>(
    system: &AssembledProblem<'_, D>,
    stage: &str,
    failure: &Failure,
    Trials { steps, rejected }: Trials,
) -> Option<Outcome> {
    let by_accuracy = matches!(failure, Failure::Inaccurate { .. } | Failure::Objected(_));
    if by_accuracy || rejected < STALLED || steps > SELDOM * rejected {
        return None;
    }
    let blamed = system.blamed()?;
    let reason = format!(
        "{rejected} trials of steps failed, beside {steps} that were accepted: {blamed}. The last of them: {}",
        system.in_words(failure)
    );
    Some(Outcome::Stopped {
        stage: Some(stage.to_string()),
        time: system.time(),
        reason,
        kind: Stop::NotConverged,
    })
}

/// Outcome of a run whose slip error requires steps below the smallest allowed. `faster` is true if slip accelerates.
pub fn exhausted<const D: usize>(
    system: &AssembledProblem<'_, D>,
    stage: &str,
    StepLengths { wanted: needed, least: smallest }: StepLengths,
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

/// Location of an instability.
struct InstabilityPoint {
    interface: String,
    position: [f64; 3],
    /// Slip rate in the rejected state \[m/s\].
    slip_rate: f64,
}

impl InstabilityPoint {
    /// Description of position and slip rate.
    fn words<const D: usize>(&self) -> String {
        let place = std::array::from_fn(|c| (self.position[c] * SHOWN).round() / SHOWN);
        format!("at {}, V = {:.3e} m/s", coordinates::in_words::<D>(&place), self.slip_rate)
    }
}

fn unstable<const D: usize>(
    system: &AssembledProblem<'_, D>,
    stage: String,
    met: InstabilityPoint,
    what: &str,
) -> Outcome {
    if is_coarse(system, &met) {
        return coarse(system, stage, met, what);
    }
    let time = system.time();
    let damping = if system.is_damped(&met.interface) { "" } else { DAMPING };
    let reason = format!(
        "instability {}: {what}; {REMEDY}. Events are followed with {damping}inertia: `stepper = \"auto\"`, or `inertia = true` in `[time]`",
        met.words::<D>()
    );
    let InstabilityPoint { interface, position, slip_rate } = met;
    Outcome::Stopped {
        stage: Some(stage),
        time,
        reason,
        kind: Stop::Instability { interface, position, slip_rate },
    }
}

/// Outcome of a step in which a point would slide whose cohesive zone is not resolved.
fn coarse<const D: usize>(
    system: &AssembledProblem<'_, D>,
    stage: String,
    met: InstabilityPoint,
    what: &str,
) -> Outcome {
    let remedy = system.resolved(&met.interface).map_or_else(String::new, |r| format!("; {}", r.limit));
    let reason = format!(
        "less than one point lies on the length over which friction falls {}: {what}{remedy}",
        met.words::<D>()
    );
    let InstabilityPoint { interface, position, .. } = met;
    Outcome::Stopped {
        stage: Some(stage),
        time: system.time(),
        reason,
        kind: Stop::UnderResolved { interface, position },
    }
}

/// True if the normal traction at a point is too large for the points to resolve its cohesive zone, and the scene does not allow this: the point
/// would fail on its own, as an artefact of the mesh.
fn is_coarse<const D: usize>(system: &AssembledProblem<'_, D>, met: &InstabilityPoint) -> bool {
    let most = system.resolved(&met.interface).and_then(|r| r.refused_beyond);
    let normal = |i: &Interface<D>| {
        let point = (0..i.points().normal_traction.len()).find(|&p| i.place(p) == met.position)?;
        i.points().normal_traction.get(point).copied()
    };
    let mut own = system.interfaces().iter().filter(|i| asperity_fem::term::Term::name(*i) == met.interface);
    let normal = own.find_map(normal);
    most.zip(normal).is_some_and(|(most, normal)| normal > most)
}

fn found(objection: &Objection) -> InstabilityPoint {
    InstabilityPoint {
        interface: objection.term.clone(),
        position: objection.position,
        slip_rate: objection.rate,
    }
}

fn at<const D: usize>(interface: &Interface<D>, point: usize, slip_rate: f64) -> InstabilityPoint {
    InstabilityPoint {
        interface: asperity_fem::term::Term::name(interface).to_string(),
        position: interface.place(point),
        slip_rate,
    }
}

/// Point that lost strength in the last failed trial.
fn weakest<const D: usize>(system: &AssembledProblem<'_, D>) -> Option<InstabilityPoint> {
    let rate = |i: &Interface<D>, p: usize| i.points().slip_rate.get(p).map_or(0.0, |v| v.abs());
    system.interfaces().iter().find_map(|i| i.weakens().map(|p| at(i, p, rate(i, p))))
}

/// Point with the largest slip rate.
fn fastest<const D: usize>(system: &AssembledProblem<'_, D>) -> Option<InstabilityPoint> {
    let each = system.interfaces().iter().filter_map(|i| i.fastest().map(|(p, rate)| at(i, p, rate)));
    each.reduce(|a, b| if b.slip_rate > a.slip_rate { b } else { a })
}
