//! Progress of a run: for people as a bar on a terminal, otherwise one line per interval; for programs as lines of JSON, and as a
//! file in the output directory. In this crate only this module and [`Pulse`] read a clock.

use super::printing::{self, Form};
use super::pulse::Pulse;
use crate::words::{about, time};
use crate::{atomic, memory};
use indicatif::{ProgressBar, ProgressStyle};
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Name of the progress file.
pub const FILE: &str = "progress.json";

/// Lines per run without a terminal: one for every 5 % of the simulated time.
const LINES: f64 = 20.0;

/// Wall time between two updates of the bar.
const REFRESH: Duration = Duration::from_millis(100);

/// Wall time between two versions of the file, and between two lines of JSON.
const INTERVAL: Duration = Duration::from_secs(1);

/// Number of parts of the simulated time that the bar resolves.
const TICKS: f64 = 1000.0;

/// Part of a run below which its pace says nothing about the rest.
const TOO_EARLY: f64 = 1e-4;

/// Simulated state of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunState {
    /// Stage, if the scene has several.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub stage: Option<String>,
    /// Simulated time \[s\].
    pub time: f64,
    /// End of the run \[s\].
    pub end: f64,
    /// Number of steps.
    pub step: u64,
    /// Length of the last step \[s\].
    pub step_length: f64,
    /// Largest slip rate \[m/s\]; absent without friction.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub largest_rate: Option<f64>,
    /// Iterations of the last step, where steps iterate.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub iterations: Option<u64>,
    /// Number of events, where they are counted.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub events: Option<u64>,
}

/// Contents of the progress file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Completed fraction of the simulated time \[-\].
    pub fraction: f64,
    /// Simulated state.
    #[serde(flatten)]
    pub now: RunState,
    /// Wall time of this run so far \[s\].
    pub seconds: f64,
    /// Wall time that the rest takes at the mean pace so far \[s\]; absent where it is unknown.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub seconds_left: Option<f64>,
    /// Memory in use \[bytes\]; absent where the system does not report it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub bytes: Option<usize>,
    /// Time at which this was written.
    pub written: String,
}

/// Shows and records the progress of a run.
pub struct Progress {
    sink: Sink,
    file: PathBuf,
    started: Instant,
    /// Fraction of the run and instant at the first step of this run, which may have been resumed.
    from: Option<(f64, Instant)>,
    recorded: Option<Instant>,
}

enum Sink {
    Bar { bar: ProgressBar, shown: Option<Instant> },
    Lines { shown: usize, pulse: Pulse },
    None,
}

impl Progress {
    /// Progress of a run in the directory `out`: a bar if standard error is a terminal, and lines otherwise.
    #[must_use]
    pub fn new(out: &Path) -> Self {
        let mut progress = Self::unseen(out);
        progress.sink = match printing::form() {
            Form::Quiet | Form::Json => Sink::None,
            Form::Plain if std::io::stderr().is_terminal() => Sink::Bar { bar: bar(), shown: None },
            Form::Plain => Sink::Lines { shown: 0, pulse: Pulse::new("setting up") },
        };
        progress
    }

    /// Progress of a run in the directory `out` that is recorded and not shown.
    #[must_use]
    pub fn unseen(out: &Path) -> Self {
        let file = out.join(FILE);
        Self { sink: Sink::None, file, started: Instant::now(), from: None, recorded: None }
    }

    /// Begins the display anew, with the first step.
    pub fn begin(&mut self) {
        (self.started, self.from) = (Instant::now(), None);
        match &mut self.sink {
            Sink::Bar { bar, .. } => bar.reset(),
            Sink::Lines { shown, .. } => *shown = 0,
            Sink::None => {}
        }
    }

    /// Shows the completed part of the simulated time, with the current state.
    pub fn show(&mut self, part: f64, now: impl Fn() -> RunState) {
        let part = part.clamp(0.0, 1.0);
        let from = *self.from.get_or_insert_with(|| (part, Instant::now()));
        let left = || left(part, from);
        if self.recorded.is_none_or(|at| at.elapsed() >= INTERVAL) {
            self.recorded = Some(Instant::now());
            self.record(part, now(), left());
        }
        let text = || status(&now(), left());
        match &mut self.sink {
            Sink::Bar { bar, shown } => {
                // Steps may be faster than anyone can read.
                if shown.is_none_or(|at| at.elapsed() >= REFRESH) {
                    *shown = Some(Instant::now());
                    bar.set_position((part * TICKS) as u64);
                    bar.set_message(text());
                }
            }
            Sink::Lines { shown, pulse } => {
                let words = || format!("{:3.0} %  {}", 100.0 * part, text());
                if let Some(now) = passed(part, *shown) {
                    *shown = now;
                    let (wall, words) = (self.started.elapsed().as_secs_f64(), words());
                    printing::progress(format_args!("{words}  [{wall:.1} s]\n"));
                    pulse.said(words);
                } else if pulse.listens() {
                    pulse.hears(words());
                }
            }
            Sink::None => {}
        }
    }

    /// Writes the file and a line of JSON. Neither is a result, so that a run continues where they cannot be written.
    fn record(&self, fraction: f64, now: RunState, seconds_left: Option<f64>) {
        let seconds = self.started.elapsed().as_secs_f64();
        let written = Timestamp::now().to_string();
        let record = Record { fraction, now, seconds, seconds_left, bytes: memory::now(), written };
        printing::line("progress", &record);
        if let Ok(text) = serde_json::to_vec_pretty(&record) {
            let _ = atomic::write(&self.file, &text);
        }
    }

    /// Clears the bar, so that later output starts on a clean line, and removes the file of a completed run.
    pub fn finish(&self, completed: bool) {
        if completed {
            // The file does no harm where it cannot be removed.
            let _ = std::fs::remove_file(&self.file);
        }
        if let Sink::Bar { bar, .. } = &self.sink {
            bar.finish_and_clear();
        }
    }
}

/// Wall time that the rest takes at the mean pace since `from` \[s\].
fn left(part: f64, (first, begun): (f64, Instant)) -> Option<f64> {
    let done = part - first;
    (done > TOO_EARLY).then(|| begun.elapsed().as_secs_f64() * (1.0 - part) / done)
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(TICKS as u64);
    // The template is a literal; if it did not parse, the default style would still show progress.
    if let Ok(style) = ProgressStyle::with_template("{elapsed_precise} {bar:32} {percent:>3} %  {msg}") {
        bar.set_style(style.progress_chars("━╸ "));
    }
    bar
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish(false);
    }
}

/// Interval reached by `part` of the run, if it lies beyond the last one shown.
fn passed(part: f64, shown: usize) -> Option<usize> {
    let now = (part * LINES) as usize;
    (now > shown).then_some(now)
}

/// A state as a line, with the wall time that the rest takes.
#[must_use]
pub fn status(now: &RunState, left: Option<f64>) -> String {
    let stage = now.stage.as_ref().map_or(String::new(), |stage| format!("{stage}: "));
    let rate = now.largest_rate.map_or(String::new(), |rate| format!(", largest rate {rate:.3e} m/s"));
    let counted = |number: Option<u64>, what: &str| match number {
        Some(1) => format!(", 1 {what}"),
        Some(n) => format!(", {n} {what}s"),
        None => String::new(),
    };
    let (iterations, events) = (counted(now.iterations, "iteration"), counted(now.events, "event"));
    let left = left.map_or(String::new(), |left| format!(", about {} left", about(left)));
    let (time, end) = (time(now.time), time(now.end));
    format!(
        "{stage}t = {time} of {end}{rate}, step {} of {:.3e} s{iterations}{events}{left}",
        now.step, now.step_length
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_of_many_steps_gives_one_line_per_interval() {
        let (mut shown, mut lines) = (0, 0);
        for step in 1..=1000 {
            if let Some(now) = passed(f64::from(step) / 1000.0, shown) {
                (shown, lines) = (now, lines + 1);
            }
        }
        assert_eq!(lines, 20);
        assert_eq!(passed(1.0, shown), None);
        assert_eq!(passed(f64::NAN, 0), None);
    }

    #[test]
    fn the_rest_is_estimated_from_the_pace_since_the_first_step() {
        let begun = Instant::now().checked_sub(Duration::from_secs(10)).unwrap();
        let rest = left(0.6, (0.4, begun)).unwrap();
        assert!((rest - 20.0).abs() < 1.0, "{rest}");
        assert_eq!(left(0.4, (0.4, begun)), None);
    }

    #[test]
    fn the_file_has_the_state_and_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let now = RunState { time: 3.0, end: 4.0, step: 7, largest_rate: Some(2.0), ..RunState::default() };
        Progress::new(folder.path()).show(0.75, || now.clone());
        let text = std::fs::read(folder.path().join(FILE)).unwrap();
        let record: Record = serde_json::from_slice(&text).unwrap();
        assert_eq!((record.fraction, record.now), (0.75, now));
    }
}
