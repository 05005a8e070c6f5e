//! Results that an integration reports while it runs and at its end.

use super::clock::Clock;
use serde::{Deserialize, Serialize};

/// A change of sign of an event function.
#[derive(Clone, Debug, PartialEq)]
pub struct Occurrence {
    /// Number of the event function.
    pub event: usize,
    /// True if the function went from negative to positive.
    pub rising: bool,
    /// Time of the change.
    pub at: Clock,
    /// Unknowns at that time.
    pub state: Vec<f64>,
}

/// Choice to continue or to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Continue.
    Go,
    /// End the integration here.
    Stop,
}

impl From<()> for Control {
    fn from((): ()) -> Self {
        Self::Go
    }
}

/// Costs of an integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and not accepted.
    pub rejected: u64,
    /// Evaluations of the rates, including those of dense output.
    pub rates: u64,
    /// Evaluations of the Jacobian.
    pub jacobians: u64,
    /// Factorisations; for radau5, a real and a complex one count as two.
    pub factorisations: u64,
    /// Solutions with a factorised matrix: iterations of Newton's method.
    pub solves: u64,
    /// Iterations of Newton's method that did not converge.
    pub newton_failures: u64,
    /// Restarts after events by methods that do not retake the step up to the event.
    pub restarts: u64,
}

impl std::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.rejected += other.rejected;
        self.rates += other.rates;
        self.jacobians += other.jacobians;
        self.factorisations += other.factorisations;
        self.solves += other.solves;
        self.newton_failures += other.newton_failures;
        self.restarts += other.restarts;
    }
}

/// Outcome of an integration.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It reached the requested end.
    Completed,
    /// The sink stopped it.
    Stopped,
    /// It failed before the end, at the last valid state.
    Failed {
        /// Reason of the failure.
        reason: Failure,
    },
}

/// Reason why an integration cannot continue.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The tolerance, or rates that are not finite, would require a step shorter than time can resolve.
    #[error("the step would have to be shorter than {length:e} s")]
    StepTooSmall {
        /// Length reached \[s\].
        length: f64,
    },
    /// The sink found that the equations are meaningless beyond the last state.
    #[error("the equations have no solution beyond this state")]
    Ends,
    /// The initial state or its rates are not finite.
    #[error("the state or its rates are not finite at the start")]
    NotFinite,
    /// More steps than allowed.
    #[error("the end is not reached in {most} steps")]
    TooManySteps {
        /// Number of steps allowed.
        most: usize,
    },
    /// Invalid sizes or tolerances.
    #[error("{0}")]
    Unfit(&'static str),
    /// Message of the solver.
    #[error("the solver reports: {0}")]
    Solver(String),
}

/// Result of an integration.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Outcome.
    pub outcome: Outcome,
    /// Time of the last valid state.
    pub at: Clock,
    /// Last valid state.
    pub state: Vec<f64>,
    /// Costs.
    pub counts: Counts,
}
