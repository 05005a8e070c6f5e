//! Definition of events by thresholds of the slip rate.

use crate::spanned::Spanned;
use crate::units::Velocity;
use schemars::JsonSchema;
use serde::Deserialize;

/// Definition of events.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EventSpec {
    /// Slip rate above which an event begins; on faults and interfaces, that of the fastest point \[m/s\].
    pub above: Spanned<Velocity>,
    /// Slip rate below which an event ends; default: a tenth of `above` \[m/s\].
    pub below: Option<Spanned<Velocity>>,
    /// Faults through cycles: slip rate above which a slow event begins, which stays slower than `above` \[m/s\].
    pub slow_above: Option<Spanned<Velocity>>,
    /// Slip rate below which a slow event ends; default: half of `slow_above` \[m/s\].
    pub slow_below: Option<Spanned<Velocity>>,
    /// Number of events after which the run ends; with several sliders, events of the first by name.
    pub stop_after: Option<Spanned<usize>>,
    /// Sliders: `true` locates the extremes of the slip rate; default `true`.
    pub peaks: Option<Spanned<bool>>,
}
