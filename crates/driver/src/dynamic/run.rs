//! The loop over the steps of a run.

use super::keeper::Keeper;
use super::moment::{Before, size};
use super::plan::Plan;
use asperity_mechanics::dynamics::{Budget, Explicit, ExplicitState, FaultState, Halt};
use asperity_output::OutputError;
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
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// State at the end of a run.
#[derive(Clone, Debug)]
pub struct Ended {
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
    /// Reason why the run could not go on, if it could not.
    pub halt: Option<Halt>,
    /// Reason why the run was interrupted, if it was.
    pub interrupted: Option<&'static str>,
}

/// Halt where a fault is faster than shear waves in the bodies, or its rate no number.
fn outran<const D: usize>(plan: &Plan<D>, explicit: &Explicit<'_, D>) -> Option<Halt> {
    let (points, rate) = (plan.points.len(), &explicit.fault().rate);
    let speeds = (0..points).map(|point| (point, size(rate, points, point)));
    let beyond = speeds.filter(|(_, rate)| *rate > plan.fastest || rate.is_nan());
    let (point, rate) = beyond.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    Some(Halt::Outrun { point, rate })
}

/// Runs a plan from its start, or from a saved state. Everything at the time of a step is known after the next, so that there is one more
/// than the plan has.
///
/// # Errors
/// [`RunError`].
pub fn run<const D: usize>(
    plan: &Plan<D>,
    keeper: &mut Keeper<'_, D>,
    from: Option<&ExplicitState>,
) -> Result<Ended, RunError> {
    let clock = Instant::now();
    let mut explicit = Explicit::new(&plan.problem).map_err(RunError::SetUp)?;
    explicit.begin_stage(0).map_err(RunError::SetUp)?;
    if from.is_some_and(|state| !explicit.restore(state)) {
        return Err(RunError::Foreign);
    }
    let (earlier, set_up) = (explicit.steps(), clock.elapsed().as_secs_f64());
    let (mut halt, mut interrupted) = (None, None);
    while explicit.steps() <= plan.steps {
        interrupted = keeper.pause(|| explicit.save())?;
        if interrupted.is_some() {
            break;
        }
        let before = Before::new(plan, &explicit);
        let last = explicit.fault().clone();
        halt = explicit.step().err();
        if halt.is_some() {
            break;
        }
        if let Some(halt) = outran(plan, &explicit) {
            // What is known after a step is the state at its start, which does not stand.
            let (budget, time) = (explicit.budget(), (explicit.time() - 2.0 * plan.dt).max(0.0));
            let (steps, halt) = (explicit.steps(), Some(halt));
            return Ok(Ended { steps, earlier, set_up, time, budget, fault: last, halt, interrupted });
        }
        keeper.step(&before.after(plan, &mut explicit))?;
        keeper.judge((explicit.steps(), explicit.time()), explicit.displacement(), false);
    }
    keeper.judge((explicit.steps(), explicit.time()), explicit.displacement(), true);
    let (budget, fault) = (explicit.budget(), explicit.fault().clone());
    let steps = explicit.steps();
    Ok(Ended { steps, earlier, set_up, time: budget.time, budget, fault, halt, interrupted })
}
