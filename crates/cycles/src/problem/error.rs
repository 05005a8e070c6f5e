//! Reasons why a run cannot begin or cannot be observed.

use asperity_run::ObserveError;

/// Reason why a run cannot begin or cannot be observed.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// No spring leads from the sliders to the load point.
    #[error("no spring leads from the sliders to the load point, so that their slip is not determined")]
    Loose,
    /// A law has no solution at a jump of the normal traction.
    #[error(transparent)]
    Law(#[from] asperity_friction::Failure),
    /// An observer failed.
    #[error("{0}")]
    Observe(#[from] ObserveError),
}
