//! Slip rates that begin and end events on surfaces.

use crate::reading::scene::model::EventSpec;
use asperity_cycles::Thresholds;
use asperity_scene::defaults;

/// Default slip rate at which an event begins \[m/s\]. For rock under crustal stress, radiation damping begins to matter there.
const BEGINS: f64 = 1e-3;

/// Slip rates that begin and end slow events, if a scene asks for them.
#[must_use]
pub fn slow(events: Option<&EventSpec>) -> Option<Thresholds> {
    let events = events?;
    let on = events.slow_above.as_ref()?.get_ref().0;
    let off = events.slow_below.as_ref().map_or(defaults::SLOW_EVENT_ENDS * on, |b| b.get_ref().0);
    Some(Thresholds { on, off })
}

/// Slip rates that begin and end events.
#[must_use]
pub fn from_spec(events: Option<&EventSpec>) -> Thresholds {
    let on = events.map_or(BEGINS, |e| e.above.get_ref().0);
    let off = events.and_then(|e| e.below.as_ref()).map_or(defaults::EVENT_ENDS * on, |b| b.get_ref().0);
    Thresholds { on, off }
}
