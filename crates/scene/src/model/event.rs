//! Definition of events by thresholds of the slip rate.

use crate::defaults;
use crate::key_default::usual;
use crate::kind::{self, Kind};
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
    /// Slip rate below which an event ends \[m/s\].
    #[schemars(extend("x-default" = usual(defaults::EVENT_ENDS).share_of("`above`")))]
    pub below: Option<Spanned<Velocity>>,
    /// Slip rate above which a slow event begins, which stays slower than `above` \[m/s\].
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-instead" = "a second run with a smaller `above` lists slow events"))]
    pub slow_above: Option<Spanned<Velocity>>,
    /// Slip rate below which a slow event ends \[m/s\].
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-default" = usual(defaults::SLOW_EVENT_ENDS).share_of("`slow_above`")))]
    pub slow_below: Option<Spanned<Velocity>>,
    /// Number of events after which the run ends; with several sliders, events of the first by name. A rupture with mass is computed to its end.
    pub stop_after: Option<Spanned<usize>>,
    /// `true` locates the extremes of the slip rate.
    #[schemars(extend("x-kinds" = [Kind::Sliders], "x-default" = usual(true), "x-instead" = "events of faults and interfaces have the largest rate of their steps"))]
    pub peaks: Option<Spanned<bool>>,
}
