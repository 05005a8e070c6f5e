//! Slip rates of events that the loads themselves reach.

use crate::reading::scene::model::EventSpec;
use asperity_cycles::Thresholds;
use asperity_run::Warning;
use std::ops::Range;

/// Warning about events that end at a slip rate that `loading` \[m/s\] keeps up, so that one of them never ends and the catalogue
/// stays empty. `slow` events have keys of their own.
#[must_use]
pub fn thresholds(asked: &EventSpec, limits: Thresholds, loading: f64, slow: bool) -> Option<Warning> {
    let (above, below) = if slow {
        (asked.slow_above.as_ref()?, asked.slow_below.as_ref())
    } else {
        (&asked.above, asked.below.as_ref())
    };
    let (what, keys) =
        if slow { ("slow events", ["slow_above", "slow_below"]) } else { ("events", ["above", "below"]) };
    let place: Range<usize> = below.map_or_else(|| above.span(), |b| b.span());
    (limits.off <= loading).then(|| {
        let message = format!(
            "{what} begin at {:e} m/s and end below {:e} m/s, and loads keep up {loading:e} m/s: where surfaces slide with them, an event does not end, and \
             none is listed",
            limits.on, limits.off
        );
        let help = format!("`{}` above the rate of the loads, and `{}` above both", keys[1], keys[0]);
        Warning::at(place, message, help)
    })
}

/// Warning about a run that waits for events where friction `weakens` nowhere, so that none begins by itself.
#[must_use]
pub fn idle_wait(asked: &EventSpec, weakens: bool) -> Option<Warning> {
    let wait = asked.stop_after.as_ref().filter(|_| !weakens)?;
    let message = "`stop_after` waits for events, and friction weakens nowhere: no event begins by itself";
    Some(Warning::at(wait.span(), message, "`a` below `b` where slip is to be unstable: are they exchanged?"))
}
