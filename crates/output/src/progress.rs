//! Progress for an interactive user: a bar on a terminal, otherwise one line per interval. In this crate only this module and
//! [`Pulse`] read a clock.

use super::OutputError;
use super::pulse::Pulse;
use super::view::{Setup, StepView, Writer};
use crate::printing;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Lines per run without a terminal: one for every 5 % of the simulated time.
const LINES: f64 = 20.0;

/// Wall time between two updates of the bar.
const REFRESH: Duration = Duration::from_millis(100);

/// Number of parts of the simulated time that the bar resolves.
const TICKS: f64 = 1000.0;

/// Shows simulated time, step length, iterations and step number on standard error.
pub struct Progress {
    sink: Sink,
}

enum Sink {
    Bar { bar: ProgressBar, shown: Option<Instant> },
    Lines { started: Instant, shown: usize, pulse: Pulse },
}

impl Progress {
    /// Creates a bar if standard error is a terminal, and lines otherwise.
    #[must_use]
    pub fn new() -> Self {
        let sink = if std::io::stderr().is_terminal() {
            Sink::Bar { bar: bar(), shown: None }
        } else {
            Sink::Lines { started: Instant::now(), shown: 0, pulse: Pulse::new("setting up") }
        };
        Self { sink }
    }

    /// Shows the completed part of the simulated time, with a line about the current step.
    pub fn show(&mut self, part: f64, status: impl FnOnce() -> String) {
        let part = part.clamp(0.0, 1.0);
        match &mut self.sink {
            Sink::Bar { bar, shown } => {
                // Steps may be faster than anyone can read.
                if shown.is_none_or(|at| at.elapsed() >= REFRESH) {
                    *shown = Some(Instant::now());
                    bar.set_position((part * TICKS) as u64);
                    bar.set_message(status());
                }
            }
            Sink::Lines { started, shown, pulse } => {
                let words = |status: String| format!("{:3.0} %  {status}", 100.0 * part);
                if let Some(now) = passed(part, *shown) {
                    *shown = now;
                    let (wall, words) = (started.elapsed().as_secs_f64(), words(status()));
                    printing::err(format_args!("{words}  [{wall:.1} s]\n"));
                    pulse.said(words);
                } else if pulse.listens() {
                    pulse.hears(words(status()));
                }
            }
        }
    }

    /// Clears the bar, so that later output starts on a clean line.
    pub fn finish(&self) {
        if let Sink::Bar { bar, .. } = &self.sink {
            bar.finish_and_clear();
        }
    }
}

impl Default for Progress {
    fn default() -> Self {
        Self::new()
    }
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
        self.finish();
    }
}

impl Writer for Progress {
    fn begin(&mut self, _: &Setup) -> Result<(), OutputError> {
        match &mut self.sink {
            Sink::Bar { bar, .. } => bar.reset(),
            Sink::Lines { started, shown, .. } => (*started, *shown) = (Instant::now(), 0),
        }
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        self.show(view.record.time / view.end_time, || status(view));
        Ok(())
    }
}

/// Interval reached by `part` of the run, if it lies beyond the last one shown.
fn passed(part: f64, shown: usize) -> Option<usize> {
    let now = (part * LINES) as usize;
    (now > shown).then_some(now)
}

fn status(view: &StepView<'_>) -> String {
    let record = view.record;
    format!(
        "{}: t = {:.6} s, dt = {:.3e} s, {} iterations, step {}",
        view.stage, record.time, record.dt, record.iterations, record.step
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
}
