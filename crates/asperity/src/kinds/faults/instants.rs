//! Times of a run at which figures show faults between events.

use asperity_cycles::FaultRun;
use asperity_plan::faults::Plan;
use asperity_plan::shared::words::time;

/// Share of the time since the event before by which "just before" an event lies ahead of it: its nucleation is then slow, and
/// the interface is coupled as late in the cycle.
const BEFORE: f64 = 0.01;

/// A chosen time.
pub(super) struct Instant {
    /// Words for file names.
    pub file: String,
    /// Words for titles and legends.
    pub words: String,
    /// The time \[s\].
    pub time: f64,
}

/// Two times ahead of each of the first events, or of a run without events its middle and its end.
pub(super) fn instants(plan: &Plan, run: &FaultRun, most: usize) -> Vec<Instant> {
    let mut all = Vec::new();
    let mut from = 0.0;
    for (number, event) in run.events().iter().enumerate().take(plan.event_files.min(most)) {
        let onset = event.onset.seconds();
        let interval = onset - from;
        let chosen = [("midway", "midway to", 0.5), ("before", "just before", 1.0 - BEFORE)];
        all.extend(chosen.into_iter().filter(|_| interval > 0.0).map(|(file, words, share)| Instant {
            file: format!("event_{number:03}_{file}"),
            words: format!("{words} event {}", number + 1),
            time: from + share * interval,
        }));
        from = event.end.map_or(onset, |end| end.seconds());
    }
    if run.events().is_empty() {
        let end = run.at.seconds();
        let chosen = [("middle", 0.5 * end), ("end", end)];
        all.extend(chosen.into_iter().map(|(file, at)| Instant {
            file: file.into(),
            words: format!("t = {}", time(at)),
            time: at,
        }));
    }
    all
}
