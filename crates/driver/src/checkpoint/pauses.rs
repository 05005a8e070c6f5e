//! Times of checkpoints and reasons to interrupt a run.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Wall time between checkpoints over the wall time that the last one took, at least: what they cost stays below 2 %.
const SHARE: u32 = 50;

/// See the module.
#[derive(Clone, Debug)]
pub struct Pauses {
    /// Wall time between two checkpoints.
    pub every: Duration,
    /// Wall time after which to interrupt the run.
    pub wall: Option<Duration>,
    /// Set from outside to interrupt it.
    pub stop: Arc<AtomicBool>,
    /// Instant at which the run began, or was resumed.
    pub begun: Instant,
}

impl Pauses {
    /// True if the next checkpoint is due; `written` is when the last one was, and how long that took.
    #[must_use]
    pub fn are_due(&self, written: (Instant, Duration)) -> bool {
        let (at, cost) = written;
        at.elapsed() >= self.every.max(cost * SHARE)
    }

    /// Reason why a run is to be interrupted now; one that has not `moved` yet only where it is asked to, so that each part of a run gets on.
    #[must_use]
    pub fn reason(&self, moved: bool) -> Option<&'static str> {
        if self.stop.load(Ordering::Relaxed) {
            return Some("a signal asked for it");
        }
        let over = self.wall.is_some_and(|wall| self.begun.elapsed() >= wall);
        (moved && over).then_some("its wall time is over")
    }
}
