//! Parts that reports of all kinds of run have in common, and how they are reached.

mod samples;

pub use samples::{ForceResult, PointResult, SpringResult};

use asperity_run::Warning;
use asperity_run::report::{Kind, Outcome, Phases};
use serde::Serialize;

/// Part of a report that depends on the kind of run.
pub trait Results: Serialize {
    /// Kind of run.
    const KIND: Kind;

    /// Outcome.
    fn outcome(&self) -> &Outcome;

    /// Warnings of the plan, and of what the run has found.
    fn warnings(&self) -> &[Warning];

    /// Accepted steps.
    fn steps(&self) -> u64;

    /// Wall time.
    fn seconds(&self) -> Phases;

    /// Wall time, to be completed.
    fn seconds_mut(&mut self) -> &mut Phases;

    /// Summary to be read at the end of the run.
    fn text(&self) -> String;
}

/// Implements what reports of all kinds have in fields of the same names.
macro_rules! results {
    ($report:ty, $kind:expr) => {
        impl $crate::report::Results for $report {
            const KIND: asperity_run::report::Kind = $kind;

            fn outcome(&self) -> &asperity_run::report::Outcome {
                &self.outcome
            }

            fn warnings(&self) -> &[asperity_run::Warning] {
                &self.warnings
            }

            fn steps(&self) -> u64 {
                self.counts.steps as u64
            }

            fn seconds(&self) -> asperity_run::report::Phases {
                self.seconds
            }

            fn seconds_mut(&mut self) -> &mut asperity_run::report::Phases {
                &mut self.seconds
            }

            fn text(&self) -> String {
                self.text()
            }
        }
    };
}

pub(crate) use results;

/// Commit of the program, "unknown" outside a checkout.
pub(crate) fn commit() -> &'static str {
    option_env!("ASPERITY_COMMIT").unwrap_or("unknown")
}
