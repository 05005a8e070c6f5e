//! Observers of a run between its steps: output files, progress, checkpoints and interruption.

use super::stand::Stand;
use crate::checkpoint::{self, Contents, Pauses};
use asperity_ode::{Control, Kind, ObserveError, Observer};
use asperity_output::view::{Setup, StepView};
use asperity_output::{Files, FilesState, Multi, OutputError, Progress, Recorder, Writer};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Kind of a run of bodies.
#[derive(Clone, Copy, Debug)]
pub struct Bodies;

impl Kind for Bodies {
    type Setup = Setup;
    type Moment<'a> = StepView<'a>;
    type Stand = Stand;
}

/// Observer that keeps nothing and never interrupts a run.
pub(super) struct Unkept<'a>(pub &'a mut dyn Writer);

impl Observer<Bodies> for Unkept<'_> {
    fn begin(&mut self, setup: &Setup) -> Result<(), ObserveError> {
        Ok(self.0.begin(setup)?)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<Control, ObserveError> {
        self.0.step(view)?;
        Ok(Control::Go)
    }

    fn end(&mut self, view: &StepView<'_>) -> Result<(), ObserveError> {
        Ok(self.0.end(view)?)
    }
}

/// Everything needed to resume a run of bodies.
#[derive(Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of the scene and of the mesh files it names.
    physics: String,
    /// State of the run.
    pub stand: Stand,
    /// Positions in the output files.
    files: FilesState,
    /// Data for the plots at the end, if there are any.
    recorder: Option<Recorder>,
}

impl Checkpoint {
    /// True if the run draws plots at its end.
    #[must_use]
    pub fn draws(&self) -> bool {
        self.recorder.is_some()
    }
}

impl Contents for Checkpoint {
    const OF: &'static str = "bodies";
    const VERSION: &'static str = "3";
    const ALLOWED: &'static str = "its title and its layout";

    fn physics(&self) -> &str {
        &self.physics
    }
}

/// Observer that keeps a run in its directory: output files, plot data, progress and checkpoints.
pub struct Kept {
    out: PathBuf,
    physics: String,
    files: Files,
    recorder: Option<Recorder>,
    progress: Option<Progress>,
    pauses: Pauses,
    resumed: bool,
    /// True if a step has been tried since the run began or was resumed.
    moved: bool,
    /// Instant of the last checkpoint, and the time that writing it took.
    written: (Instant, Duration),
}

impl Kept {
    /// Begins a run with outputs in `out`; `recorder` collects the data for the plots at the end.
    ///
    /// # Errors
    /// If the checkpoint of an earlier run cannot be removed.
    pub fn begin(
        out: &Path,
        physics: &str,
        files: Files,
        recorder: Option<Recorder>,
        pauses: Pauses,
    ) -> Result<Self, OutputError> {
        checkpoint::remove(out)?;
        let physics = physics.to_string();
        Ok(Self::new(out.to_path_buf(), physics, (files, recorder), pauses, false))
    }

    /// Resumes the run of a checkpoint read from `out`. A run that was begun without a recorder continues without one.
    #[must_use]
    pub fn resume(out: &Path, read: Checkpoint, files: Files, drawn: bool, pauses: Pauses) -> (Self, Stand) {
        let Checkpoint { physics, stand, files: from, recorder } = read;
        let parts = (files.resumed(from), recorder.filter(|_| drawn));
        (Self::new(out.to_path_buf(), physics, parts, pauses, true), stand)
    }

    fn new(
        out: PathBuf,
        physics: String,
        (files, recorder): (Files, Option<Recorder>),
        pauses: Pauses,
        resumed: bool,
    ) -> Self {
        let written = (Instant::now(), Duration::ZERO);
        Self { out, physics, files, recorder, progress: None, pauses, resumed, moved: false, written }
    }

    /// Adds a progress display.
    #[must_use]
    pub fn shown(self) -> Self {
        Self { progress: Some(Progress::new(&self.out)), ..self }
    }

    fn save(&mut self, stand: Stand) -> Result<(), OutputError> {
        let begun = Instant::now();
        self.files.settle()?;
        let (physics, files) = (self.physics.clone(), self.files.state());
        let checkpoint = Checkpoint { physics, stand, files, recorder: self.recorder.take() };
        let written = checkpoint.write(&self.out);
        self.recorder = checkpoint.recorder;
        self.written = (Instant::now(), begun.elapsed());
        written
    }

    /// Ends the progress display. Returns the data for the plots.
    #[must_use]
    pub fn finish(self, completed: bool) -> Option<Recorder> {
        if let Some(progress) = self.progress {
            progress.finish(completed);
        }
        self.recorder
    }

    fn all(&mut self) -> Multi<'_> {
        let mut all = vec![&mut self.files as &mut dyn Writer];
        all.extend(self.progress.as_mut().map(|p| p as &mut dyn Writer));
        all.extend(self.recorder.as_mut().map(|r| r as &mut dyn Writer));
        Multi::new(all)
    }
}

impl Observer<Bodies> for Kept {
    fn begin(&mut self, setup: &Setup) -> Result<(), ObserveError> {
        if !self.resumed {
            return Ok(self.all().begin(setup)?);
        }
        self.files.begin(setup)?;
        self.progress.as_mut().map_or(Ok(()), |progress| progress.begin(setup))?;
        Ok(self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.resume(setup))?)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<Control, ObserveError> {
        self.all().step(view)?;
        Ok(Control::Go)
    }

    /// On the first call no step has been tried, and a checkpoint would only repeat the resumed state.
    fn pause(&mut self, stand: &mut dyn FnMut() -> Stand) -> Result<Option<&'static str>, ObserveError> {
        let moved = std::mem::replace(&mut self.moved, true);
        let reason = self.pauses.reason(moved);
        if reason.is_some() || moved && self.pauses.are_due(self.written) {
            self.save(stand())?;
        }
        Ok(reason)
    }

    fn end(&mut self, view: &StepView<'_>) -> Result<(), ObserveError> {
        Ok(self.all().end(view)?)
    }
}
