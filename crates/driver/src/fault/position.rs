//! Where output files stand, for a run that is resumed.

use super::cadence::Gauge;
use super::snapshots::Taken;
use asperity_ode::Clock;
use serde::{Deserialize, Serialize};

/// Where the files of a run stand.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Of the files, in their order.
    pub(super) gauges: Vec<Gauge>,
    /// When the last step ended.
    pub(super) before: Option<Clock>,
    /// In space.
    #[serde(default)]
    pub(super) snapshots: Option<Taken>,
}
