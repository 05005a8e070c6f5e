//! The state of a run of faults in its checkpoint.

use super::position::Position;
use crate::checkpoint;
use asperity_cycles::{FaultRun, Sums};
use serde::{Deserialize, Serialize};

/// State of a run with its output files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StoredRun {
    /// State, clock, step length, events and counts.
    pub run: FaultRun,
    /// Positions in the output files.
    pub files: Position,
    /// Energy sums so far.
    pub sums: Sums,
}

/// Everything needed to resume a run, even to a later end or to more events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Planned end of the run \[s\].
    pub end: f64,
    /// Identity of the loads so far; see [`super::identity::loads`].
    pub loads: Vec<[f64; 3]>,
    /// State of the run.
    pub last: StoredRun,
    /// State at the last restart, stored once the run has reached its end time. The step to the end is cut short there, so an extended run resumes
    /// from this state instead.
    pub before: Option<Box<StoredRun>>,
}

impl checkpoint::SavedState for Checkpoint {
    const OF: &'static str = "faults";
    const VERSION: &'static str = "6";
    const ALLOWED: &'static str = "the duration of the last stage, `stop_after` or `[place]`";
}
