//! The loop over the steps of a run.

use super::arrivals::Arrivals;
use super::moment::{Moment, StepStart};
use crate::kinds::worst::Worst;
use asperity_mechanics::SetUpError;
use asperity_mechanics::dynamics::{Budget, Explicit, ExplicitState, FaultState, Halt};
use asperity_plan::dynamics::Plan;
use asperity_run::{Kind, ObserveError, Observer, Warning};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Reason why a run could not be carried out.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Masses or forces could not be set up, so that nothing was computed.
    #[error("setting up the bodies: {0}")]
    SetUp(String),
    /// The checkpoint does not belong to this plan.
    #[error("the run that is to be resumed is another")]
    Foreign,
    /// An output could not be written.
    #[error("{0}")]
    Output(#[from] ObserveError),
}

/// State at the end of a run.
#[derive(Clone, Debug)]
pub struct FinalState {
    /// Steps taken.
    pub steps: usize,
    /// Those of them before the run was resumed.
    pub earlier: usize,
    /// Wall time until the first step could be taken \[s\].
    pub set_up: f64,
    /// Time of the last state \[s\].
    pub time: f64,
    /// Energies then.
    pub budget: Budget,
    /// Faults then.
    pub fault: FaultState,
    /// Reason why the run could not continue, if it could not.
    pub halt: Option<Halt>,
    /// Reason why the run was interrupted, if it was.
    pub interrupted: Option<&'static str>,
    /// Rupture times and largest slip rates.
    pub arrivals: Arrivals,
    /// Warnings about strains and rotations.
    pub doubts: Vec<Warning>,
}

/// Halt where a fault is faster than shear waves in the bodies, or its rate no number.
fn outran<const D: usize>(plan: &Plan<D>, explicit: &Explicit<'_, D>) -> Option<Halt> {
    let rate = &explicit.fault().rate;
    let speeds = (0..plan.points.len()).map(|point| (point, rate.size(point)));
    let beyond = speeds.filter(|(_, rate)| *rate > plan.fastest || rate.is_nan());
    let (point, rate) = beyond.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    Some(Halt::Outrun { point, rate })
}

/// Kind of a run of bodies with mass.
#[derive(Clone, Copy, Debug)]
pub struct Dynamics;

impl Kind for Dynamics {
    type Setup = ();
    type Moment<'a> = Moment<'a>;
    type ResumeState = ResumeState;
}

/// State of a run between two steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResumeState {
    /// State of bodies and faults.
    pub state: ExplicitState,
    /// Rupture times so far.
    pub(super) arrivals: Arrivals,
    /// Largest strains and rotations so far.
    worst: Worst,
}

impl ResumeState {
    /// True if the faults of the plan have as many points.
    pub(super) fn fits<const D: usize>(&self, plan: &Plan<D>) -> bool {
        self.arrivals.times.len() == plan.points.len()
    }
}

/// Steps between those whose strains are judged: a wave crosses some tens of cells meanwhile, and judging takes as long as a step.
const JUDGED: usize = 64;

/// Runs a plan from its start, or from a saved state. Everything at the time of a step is known after the next, so that there is one more
/// than the plan has.
///
/// # Errors
/// [`RunError`].
pub fn run<const D: usize>(
    plan: &Plan<D>,
    observer: &mut dyn Observer<Dynamics>,
    from: Option<ResumeState>,
) -> Result<FinalState, RunError> {
    let clock = Instant::now();
    let failed = |e: SetUpError| RunError::SetUp(e.to_string());
    let mut explicit = Explicit::new(&plan.problem).map_err(failed)?;
    explicit.begin_stage(0).map_err(failed)?;
    if from.as_ref().is_some_and(|stand| !explicit.restore(&stand.state)) {
        return Err(RunError::Foreign);
    }
    let (mut arrivals, mut worst) = match from {
        Some(stand) => (stand.arrivals, stand.worst),
        None => (Arrivals::new(plan.points.len()), Worst::default()),
    };
    let model = &plan.problem.model;
    let (earlier, set_up) = (explicit.steps(), clock.elapsed().as_secs_f64());
    observer.begin(&())?;
    let (mut halt, mut interrupted, mut back) = (None, None, None);
    while explicit.steps() <= plan.steps {
        let mut stand =
            || ResumeState { state: explicit.save(), arrivals: arrivals.clone(), worst: worst.clone() };
        interrupted = observer.pause(&mut stand)?;
        if interrupted.is_some() {
            break;
        }
        let before = StepStart::new(plan, &explicit);
        let last = explicit.fault().clone();
        halt = explicit.step().err();
        if halt.is_some() {
            break;
        }
        halt = outran(plan, &explicit);
        if halt.is_some() {
            back = Some(last);
            break;
        }
        let moment = before.after(plan, &mut explicit);
        if !plan.points.is_empty() {
            arrivals.see(moment.time, &moment.fault.rate, plan.rupture_rate);
        }
        observer.step(&moment)?;
        if explicit.steps().is_multiple_of(JUDGED) {
            worst.judge(model, explicit.time(), explicit.displacement());
        }
    }
    // A step that outran waves is not kept: what is known after it is the state at its start.
    if back.is_none() {
        worst.judge(model, explicit.time(), explicit.displacement());
    }
    let budget = explicit.budget();
    let time = if back.is_some() { (explicit.time() - 2.0 * plan.dt).max(0.0) } else { budget.time };
    Ok(FinalState {
        steps: explicit.steps(),
        earlier,
        set_up,
        time,
        budget,
        fault: back.unwrap_or_else(|| explicit.fault().clone()),
        halt,
        interrupted,
        arrivals,
        doubts: plan.problem.stages.iter().flat_map(|s| worst.body_warnings(model, &s.name)).collect(),
    })
}
