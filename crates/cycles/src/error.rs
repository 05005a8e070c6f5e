//! Why a run could not begin, or not be observed.

/// Why a watcher could not go on.
pub type WatchError = Box<dyn std::error::Error + Send + Sync>;

/// Why a run could not begin, or not be observed.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Nothing holds a slider.
    #[error("no spring leads from the sliders to the load point, so that their slip is not determined")]
    Loose,
    /// A law has no answer at a jump of the normal traction.
    #[error(transparent)]
    Law(#[from] asperity_friction::Failure),
    /// A watcher could not go on.
    #[error("{0}")]
    Observe(#[source] WatchError),
}
