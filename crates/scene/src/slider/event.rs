//! Thresholds of events.

use crate::spanned::Spanned;
use crate::units::Velocity;
use schemars::JsonSchema;
use serde::Deserialize;

/// Events.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EventSpec {
    /// Slip rate above which an event begins; on faults, of the fastest point \[m/s\].
    pub above: Spanned<Velocity>,
    /// Slip rate below which it ends; default: a tenth of `above` \[m/s\].
    pub below: Option<Spanned<Velocity>>,
    /// Events after which the run ends; of sliders, those of the first by name.
    pub stop_after: Option<Spanned<usize>>,
    /// Of sliders, true if the extremes of the slip rate are located; default `true`.
    pub peaks: Option<bool>,
}
