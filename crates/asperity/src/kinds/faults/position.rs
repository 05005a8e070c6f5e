//! Positions in the output files, from which a run is resumed.

use super::snapshots::SnapshotState;
use super::source_time::SourceTimeState;
use asperity_ode::Clock;
use asperity_plan::faults::cadence::Gauge;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Positions in the output files of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Gauges of the tables, by their paths.
    pub(super) gauges: BTreeMap<String, Gauge>,
    /// End of the last step.
    pub(super) before: Option<Clock>,
    /// Number of steps taken.
    pub(super) step: u64,
    /// Snapshots, in 3D.
    pub(super) snapshots: Option<SnapshotState>,
    /// Files of the moment rates of events.
    pub(super) events: SourceTimeState,
}
