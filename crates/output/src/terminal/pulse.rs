//! Progress messages without a terminal: the last activity, printed at intervals of wall time even during a long step.

use super::printing;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Wall time without output after which a line is printed.
const SILENCE: Duration = Duration::from_secs(30);

/// Wall time between updates of the activity. Formatting it costs more than a small step.
const LOOK: Duration = Duration::from_secs(1);

/// Last activity and time of its last printing.
struct LastActivity {
    words: String,
    printed: Instant,
}

/// Prints the last activity at intervals until it is dropped.
pub struct Pulse {
    last: Arc<Mutex<LastActivity>>,
    looked: Instant,
    beating: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Pulse {
    /// Starts with this activity.
    #[must_use]
    pub fn new(words: &str) -> Self {
        Self::every(SILENCE, words, |words, wall| {
            printing::progress(format_args!("{words}  [{:.1} s]\n", wall.as_secs_f64()));
        })
    }

    fn every(silence: Duration, words: &str, print: impl Fn(&str, Duration) + Send + 'static) -> Self {
        let started = Instant::now();
        let last = Arc::new(Mutex::new(LastActivity { words: words.to_string(), printed: started }));
        let (ends, ended) = mpsc::channel::<()>();
        let shared = Arc::clone(&last);
        let beat = move || {
            let mut wait = silence;
            while ended.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                let mut last = held(&shared);
                if last.printed.elapsed() >= silence {
                    print(&last.words, started.elapsed());
                    last.printed = Instant::now();
                }
                wait = silence.saturating_sub(last.printed.elapsed());
            }
        };
        // Without a thread there are no messages; the run continues.
        let thread = std::thread::Builder::new().name("pulse".into()).spawn(beat).ok();
        Self { last, looked: started, beating: thread.map(|thread| (ends, thread)) }
    }

    /// True if the activity is due for an update.
    #[must_use]
    pub(super) fn listens(&self) -> bool {
        self.looked.elapsed() >= LOOK
    }

    /// Sets the text to be printed after a long time without other output.
    pub(super) fn hears(&mut self, words: String) {
        self.looked = Instant::now();
        held(&self.last).words = words;
    }

    /// Sets the text and marks it as printed just now.
    pub(super) fn said(&mut self, words: String) {
        self.hears(words);
        held(&self.last).printed = self.looked;
    }
}

/// Locks the last activity. If the other thread panicked while writing, its text is still readable.
fn held(last: &Mutex<LastActivity>) -> MutexGuard<'_, LastActivity> {
    last.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

impl Drop for Pulse {
    fn drop(&mut self) {
        if let Some((ends, thread)) = self.beating.take() {
            drop(ends);
            // The thread only prints; if it failed there is nothing to do.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_nothing_is_said_the_last_words_are_repeated() {
        let (told, heard) = mpsc::channel();
        let beat = move |words: &str, _| told.send(words.to_string()).unwrap_or_default();
        let mut pulse = Pulse::every(Duration::from_millis(1), "begins", beat);
        assert_eq!(heard.recv().unwrap(), "begins");
        pulse.hears("goes on".into());
        assert!(heard.iter().any(|words| words == "goes on"));
        drop(pulse);
        // The thread has ended and prints nothing more.
        assert!(heard.iter().all(|words| words == "goes on"));
    }

    #[test]
    fn a_pulse_ends_at_once_when_it_is_dropped() {
        drop(Pulse::every(Duration::from_secs(3600), "", |_, _| {}));
    }
}
