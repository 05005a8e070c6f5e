//! Positions in the output files, for a run that is resumed.

use super::cadence::Gauge;
use super::snapshots::Taken;
use asperity_ode::Clock;
use serde::{Deserialize, Serialize};

/// Positions in the files of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Of the files, in their order.
    pub(super) gauges: Vec<Gauge>,
    /// End of the last step.
    pub(super) before: Option<Clock>,
    /// In space.
    #[serde(default)]
    pub(super) snapshots: Option<Taken>,
}
