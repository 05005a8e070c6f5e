//! Slip rates that begin and end events on surfaces.

use crate::scene::model::EventSpec;
use asperity_cycles::Thresholds;

/// Default slip rate at which an event begins \[m/s\]. For rock under crustal stress, radiation damping begins to matter there.
const BEGINS: f64 = 1e-3;

/// Default slip rate at which an event ends, over the rate at which it begins.
const ENDS: f64 = 0.1;

/// Default slip rate at which a slow event ends, over the rate at which it begins. Slow events are hardly faster than the
/// plates, which slide on after them.
const SLOW_ENDS: f64 = 0.5;

/// Default slip rate at which a point has ruptured \[m/s\], that of the benchmarks of spontaneous rupture; not below that at which
/// events begin.
pub const RUPTURED: f64 = 1e-3;

/// Slip rates that begin and end slow events, if a scene asks for them.
#[must_use]
pub fn slow(events: Option<&EventSpec>) -> Option<Thresholds> {
    let events = events?;
    let on = events.slow_above.as_ref()?.get_ref().0;
    let off = events.slow_below.as_ref().map_or(SLOW_ENDS * on, |b| b.get_ref().0);
    Some(Thresholds { on, off })
}

/// Slip rates that begin and end events.
#[must_use]
pub fn of(events: Option<&EventSpec>) -> Thresholds {
    let on = events.map_or(BEGINS, |e| e.above.get_ref().0);
    let off = events.and_then(|e| e.below.as_ref()).map_or(ENDS * on, |b| b.get_ref().0);
    Thresholds { on, off }
}
