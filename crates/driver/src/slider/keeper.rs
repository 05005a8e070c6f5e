//! Keeps a run of spring-sliders in its directory: histories, progress and checkpoints.

use super::files::{Histories, Positions};
use crate::checkpoint::{self, Contents, Pauses, ResumeError};
use asperity_cycles::slider::{Now as Step, Problem, SliderRun, Sliders};
use asperity_ode::{Control, ObserveError, Observer};
use asperity_output::OutputError;
use asperity_output::progress::{Now, Progress};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Everything needed to resume a run of spring-sliders.
#[derive(Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of the scene.
    physics: String,
    run: SliderRun,
    histories: Positions,
}

impl Contents for Checkpoint {
    const OF: &'static str = "spring-sliders";
    const VERSION: &'static str = "3";
    const ALLOWED: &'static str = "its title and its layout";

    fn physics(&self) -> &str {
        &self.physics
    }
}

/// See the module.
pub struct Keeper {
    out: PathBuf,
    physics: String,
    histories: Histories,
    progress: Option<Progress>,
    pauses: Pauses,
    /// Instant of the last checkpoint, and the time that writing it took.
    written: (Instant, Duration),
    interrupted: Option<&'static str>,
}

impl Keeper {
    /// Begins a run with outputs in `out`.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn begin(
        out: &Path,
        problem: &Problem,
        physics: &str,
        drawn: bool,
        pauses: Pauses,
    ) -> Result<(Self, SliderRun), OutputError> {
        checkpoint::remove(out)?;
        let histories = Histories::create(out, problem)?;
        let histories = if drawn { histories.traced() } else { histories };
        Ok((Self::new(out, physics, histories, pauses), SliderRun::new(problem)))
    }

    /// Resumes the run of the checkpoint in `out`; `None` if there is no checkpoint.
    ///
    /// # Errors
    /// If the checkpoint is damaged or belongs to another scene, or a file cannot be read or written.
    pub fn resume(
        out: &Path,
        problem: &Problem,
        physics: &str,
        pauses: Pauses,
    ) -> Result<Option<(Self, SliderRun)>, ResumeError> {
        let Some(Checkpoint { run, histories, .. }) = Checkpoint::read(out, physics)? else {
            return Ok(None);
        };
        if run.unknowns.len() != problem.start.len() {
            return Err(checkpoint::foreign(out, "its unknowns differ from those of this scene"));
        }
        let histories = Histories::resume(out, problem, histories)?;
        Ok(Some((Self::new(out, physics, histories, pauses), run)))
    }

    fn new(out: &Path, physics: &str, histories: Histories, pauses: Pauses) -> Self {
        Self {
            out: out.to_path_buf(),
            physics: physics.to_string(),
            histories,
            progress: None,
            pauses,
            written: (Instant::now(), Duration::ZERO),
            interrupted: None,
        }
    }

    /// Adds a progress display.
    #[must_use]
    pub fn shown(self) -> Self {
        Self { progress: Some(Progress::new(&self.out)), ..self }
    }

    /// True if the run draws plots at its end.
    #[must_use]
    pub fn draws(&self) -> bool {
        self.histories.are_traced()
    }

    /// Reason why the run was interrupted.
    #[must_use]
    pub fn interrupted(&self) -> Option<&'static str> {
        self.interrupted
    }

    /// Completes the histories.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn finish(mut self, completed: bool) -> Result<Histories, OutputError> {
        if let Some(progress) = self.progress {
            progress.finish(completed);
        }
        // Rows after the checkpoint are cut off if the run is resumed.
        self.histories.finish()?;
        Ok(self.histories)
    }

    fn save(&mut self, run: SliderRun) -> Result<(), OutputError> {
        let begun = Instant::now();
        self.histories.settle()?;
        let (physics, histories) = (self.physics.clone(), self.histories.positions());
        Checkpoint { physics, run, histories }.write(&self.out)?;
        self.written = (Instant::now(), begun.elapsed());
        Ok(())
    }
}

impl Observer<Sliders> for Keeper {
    fn step(&mut self, now: &Step<'_>) -> Result<Control, ObserveError> {
        self.histories.step(now)?;
        if let Some(progress) = &mut self.progress {
            progress.show(now.at.seconds() / now.problem.end, || status(now));
        }
        Ok(Control::Go)
    }

    fn event(&mut self, slider: usize) -> Result<(), ObserveError> {
        self.histories.event(slider)
    }

    fn pause(&mut self, run: &mut dyn FnMut() -> SliderRun) -> Result<Option<&'static str>, ObserveError> {
        self.interrupted = self.pauses.reason(true);
        if self.interrupted.is_some() || self.pauses.are_due(self.written) {
            self.save(run())?;
        }
        Ok(self.interrupted)
    }
}

/// State for the progress display.
fn status(now: &Step<'_>) -> Now {
    Now {
        stage: None,
        time: now.at.seconds(),
        end: now.problem.end,
        step: now.step as u64,
        step_length: now.dt,
        largest_rate: now.conditions.iter().map(|c| c.rate.abs()).reduce(f64::max),
        iterations: None,
        events: None,
    }
}
