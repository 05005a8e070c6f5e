//! Positions in the output files, from which a run is resumed.

use super::cadence::Gauge;
use super::snapshots::Taken;
use super::source_time::Written;
use asperity_ode::Clock;
use serde::{Deserialize, Serialize};

/// Positions in the output files of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Gauges of the files, in the order of the files.
    pub(super) gauges: Vec<Gauge>,
    /// End of the last step.
    pub(super) before: Option<Clock>,
    /// Number of steps taken.
    #[serde(default)]
    pub(super) step: u64,
    /// Snapshots, in 3D.
    #[serde(default)]
    pub(super) snapshots: Option<Taken>,
    /// Files of the moment rates of events.
    pub(super) events: Written,
}
