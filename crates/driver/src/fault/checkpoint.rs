//! The checkpoint of a run of faults.

use super::position::Position;
use crate::checkpoint::Contents;
use asperity_cycles::{FaultRun, Sums};
use serde::{Deserialize, Serialize};

/// State of a run with its output files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stand {
    /// State, clock, step length, events and counts.
    pub run: FaultRun,
    /// Positions in the output files.
    pub files: Position,
    /// Energy sums so far.
    pub sums: Sums,
}

/// Everything needed to resume a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of the physics of the scene and of the mesh files it names; see [`super::identity`].
    pub physics: String,
    /// Planned end of the run \[s\].
    pub end: f64,
    /// Identity of the loads so far; see [`super::identity::loads`].
    pub loads: Vec<[f64; 3]>,
    /// State of the run.
    pub last: Stand,
    /// State at the last restart, stored once the run has reached its end time. The step to the end is cut short there, so an extended run resumes
    /// from this state instead.
    pub before: Option<Box<Stand>>,
}

impl Contents for Checkpoint {
    const OF: &'static str = "faults";
    const VERSION: &'static str = "5";
    const ALLOWED: &'static str = "the duration of the last stage, `stop_after` or `[place]`";

    fn physics(&self) -> &str {
        &self.physics
    }
}
