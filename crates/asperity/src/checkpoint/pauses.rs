//! Times of checkpoints and reasons to interrupt a run.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Least ratio of the wall time between checkpoints to the wall time of writing the last one; it keeps the cost of
/// checkpoints below 2 %.
const SHARE: u32 = 50;

/// Settings for checkpoints and interruption of a run.
#[derive(Clone, Debug)]
pub struct Pauses {
    /// Wall time between two checkpoints.
    pub every: Duration,
    /// Wall time after which the run is interrupted.
    pub wall: Option<Duration>,
    /// Flag set from outside to interrupt the run.
    pub stop: Arc<AtomicBool>,
    /// Instant at which the run began, or was resumed.
    pub begun: Instant,
}

impl Pauses {
    /// True if the next checkpoint is due, for the instant of the last one and the time that writing it took.
    #[must_use]
    pub fn are_due(&self, at: Instant, cost: Duration) -> bool {
        at.elapsed() >= self.every.max(cost * SHARE)
    }

    /// Reason to interrupt the run now, if any. A run that has not `moved` yet is interrupted only on request, so that every part of a run advances.
    #[must_use]
    pub fn reason(&self, moved: bool) -> Option<&'static str> {
        if self.stop.load(Ordering::Relaxed) {
            return Some("a signal asked for it");
        }
        let over = self.wall.is_some_and(|wall| self.begun.elapsed() >= wall);
        (moved && over).then_some("its wall time is over")
    }
}
