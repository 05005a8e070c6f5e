//! Results of an integration while it runs and at its end.

use super::clock::Clock;
use serde::{Deserialize, Serialize};

/// A change of sign of an event function.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    /// Number of the event function.
    pub event: usize,
    /// True if the function went from negative to positive.
    pub rising: bool,
    /// Time.
    pub at: Clock,
    /// The unknowns then.
    pub state: Vec<f64>,
}

/// Decision to go on or to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Go,
    /// End the integration here.
    Stop,
}

/// Cost of an integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and not accepted.
    pub rejected: u64,
    /// Evaluations of the rates, those of dense output included.
    pub rates: u64,
    /// Evaluations of the Jacobian.
    pub jacobians: u64,
    /// Factorisations (radau5: a real and a complex one are two).
    pub factorisations: u64,
    /// Solutions with a factorised matrix: iterations of Newton's method.
    pub solves: u64,
    /// Iterations of Newton's method that did not converge.
    pub newton_failures: u64,
    /// Restarts after events by methods that do not take the step again up to the event.
    pub restarts: u64,
}

/// End of an integration.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// At the end asked for.
    Completed,
    /// At the request of the sink.
    Stopped,
    /// Before, at the last good state.
    Failed {
        /// Reason.
        reason: Failure,
    },
}

/// Reason why an integration cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The tolerance, or rates that are not finite, would need a shorter step than time resolves.
    #[error("the step would have to be shorter than {length:e} s")]
    StepTooSmall {
        /// The length reached \[s\].
        length: f64,
    },
    /// The sink found that the equations have no sense beyond the last state.
    #[error("the equations have no solution beyond this state")]
    Ends,
    /// The state to start from, or its rates, are not finite.
    #[error("the state or its rates are not finite at the start")]
    NotFinite,
    /// More steps than allowed.
    #[error("the end is not reached in {most} steps")]
    TooManySteps {
        /// The steps allowed.
        most: usize,
    },
    /// Sizes or tolerances that make no sense.
    #[error("{0}")]
    Unfit(&'static str),
    /// Words of the solver.
    #[error("the solver reports: {0}")]
    Solver(String),
}

/// The end of an integration.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished {
    /// Outcome.
    pub outcome: Outcome,
    /// Time of the last good state.
    pub at: Clock,
    /// The last good state.
    pub state: Vec<f64>,
    /// Cost.
    pub counts: Counts,
}
