//! Slip rates that begin and end events on surfaces.

use crate::scene::slider::EventSpec;
use asperity_cycles::Thresholds;

/// Default slip rate at which an event begins \[m/s\]. For rock under crustal stress, radiation damping begins to matter there.
const BEGINS: f64 = 1e-3;

/// Default slip rate at which an event ends, over the rate at which it begins.
const ENDS: f64 = 0.1;

/// Slip rates that begin and end events.
#[must_use]
pub fn of(events: Option<&EventSpec>) -> Thresholds {
    let on = events.map_or(BEGINS, |e| e.above.get_ref().0);
    let off = events.and_then(|e| e.below.as_ref()).map_or(ENDS * on, |b| b.get_ref().0);
    Thresholds { on, off }
}
