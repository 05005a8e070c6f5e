//! What an integration tells while it runs and at its end.

use super::clock::Clock;
use serde::{Deserialize, Serialize};

/// A change of sign of an event function.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    /// Number of the event function.
    pub event: usize,
    /// Whether the function went from negative to positive.
    pub rising: bool,
    /// When.
    pub at: Clock,
    /// The unknowns then.
    pub state: Vec<f64>,
}

/// Whether to go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Go,
    /// End the integration here.
    Stop,
}

/// What an integration took.
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

/// How an integration ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// At the end asked for.
    Completed,
    /// Where the sink wanted.
    Stopped,
    /// Before, at the last good state.
    Failed {
        /// Why.
        reason: Failure,
    },
}

/// Why an integration cannot go on.
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
    /// What the solver says.
    #[error("the solver reports: {0}")]
    Solver(String),
}

/// The end of an integration.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished {
    /// How it ended.
    pub outcome: Outcome,
    /// When: the time of the last good state.
    pub at: Clock,
    /// The last good state.
    pub state: Vec<f64>,
    /// What it took.
    pub counts: Counts,
}
