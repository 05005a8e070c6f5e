//! Thresholds of events.

use crate::units::Velocity;
use serde::Deserialize;
use serde_spanned::Spanned;

/// Events.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventSpec {
    /// Slip rate above which an event begins \[m/s\].
    pub above: Spanned<Velocity>,
    /// Slip rate below which it ends \[m/s\]; a tenth of `above` where absent.
    pub below: Option<Spanned<Velocity>>,
    /// Events of the first slider after which the run ends.
    pub stop_after: Option<Spanned<usize>>,
    /// True if the extremes of the slip rate are found, not only seen at steps (default true).
    pub peaks: Option<bool>,
}
