//! A run in progress or at its end.

use asperity_ode::{Clock, Counts, Outcome};
use asperity_run::Catalogue;
use serde::{Deserialize, Serialize};

/// Results of a run, or its results so far. At a restart they suffice to resume it. `D` are the details of its events,
/// `P` is the progress specific to its kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run<D, P> {
    /// Outcome.
    #[serde(skip, default = "completed")]
    pub outcome: Outcome,
    /// Time reached.
    pub at: Clock,
    /// Unknowns at that time.
    pub unknowns: Vec<f64>,
    /// Events.
    pub catalogue: Catalogue<D>,
    /// Operation counts.
    pub counts: Counts,
    /// The step to try next, where the run restarts between two breaks of its loading.
    pub next_step: Option<NextStep>,
    /// Progress specific to its kind.
    pub progress: P,
}

/// The step to try next.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NextStep {
    /// Its length \[s\]; chosen from the rates where absent.
    pub length: Option<f64>,
    /// True if a switching method takes it with its method for stiff equations.
    pub stiff: bool,
}

impl<D, P> Run<D, P> {
    /// A run that begins at time 0, with this many sources of events.
    pub(crate) fn begin(unknowns: Vec<f64>, sources: usize, progress: P) -> Self {
        Self {
            outcome: completed(),
            at: Clock::new(0.0, 0.0),
            unknowns,
            catalogue: Catalogue::new(sources),
            counts: Counts::default(),
            next_step: None,
            progress,
        }
    }
}

fn completed() -> Outcome {
    Outcome::Completed
}
