//! What is done with a run between its steps: shown, kept in checkpoints, interrupted.

use super::stand::Stand;
use crate::checkpoint::{self, Contents, Pauses};
use asperity_output::view::{Setup, StepView};
use asperity_output::{Files, FilesState, Multi, Observer, OutputError, Progress, Recorder};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Observes a run, and decides between its steps whether it goes on.
pub trait Keeper: Observer {
    /// Before each trial of a step: why the run is to be interrupted, where it is. `moved` is false until the run has tried a step since it
    /// began or was resumed; `stand` gives where it stands, which costs a copy.
    ///
    /// # Errors
    /// When something cannot be written.
    fn pause(
        &mut self,
        moved: bool,
        stand: &mut dyn FnMut() -> Stand,
    ) -> Result<Option<&'static str>, OutputError>;
}

/// Keeps nothing and lets a run go on to its end.
pub(super) struct Unkept<'a>(pub &'a mut dyn Observer);

impl Observer for Unkept<'_> {
    fn begin(&mut self, setup: &Setup) -> Result<(), OutputError> {
        self.0.begin(setup)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        self.0.step(view)
    }

    fn stopped(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        self.0.stopped(view)
    }
}

impl Keeper for Unkept<'_> {
    fn pause(&mut self, _: bool, _: &mut dyn FnMut() -> Stand) -> Result<Option<&'static str>, OutputError> {
        Ok(None)
    }
}

/// All there is to know to resume a run of bodies.
#[derive(Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of the scene and of the mesh files it names.
    physics: String,
    /// Where the run stands.
    pub stand: Stand,
    /// Where its files stand.
    files: FilesState,
    /// What is drawn at the end; none where nothing is.
    recorder: Option<Recorder>,
}

impl Checkpoint {
    /// Whether the run is to draw anything at its end.
    #[must_use]
    pub fn draws(&self) -> bool {
        self.recorder.is_some()
    }
}

impl Contents for Checkpoint {
    const OF: &'static str = "bodies";
    const VERSION: &'static str = "1";
    const ALLOWED: &'static str = "its title and its layout";

    fn physics(&self) -> &str {
        &self.physics
    }
}

/// Keeps a run in its directory: files, what is drawn at the end, progress, and checkpoints.
pub struct Kept {
    out: PathBuf,
    physics: String,
    files: Files,
    recorder: Option<Recorder>,
    progress: Option<Progress>,
    pauses: Pauses,
    resumed: bool,
    /// When the last checkpoint was written, and how long that took.
    written: (Instant, Duration),
}

impl Kept {
    /// Begins a run with outputs in `out`; with `recorder` what it is to draw at the end.
    ///
    /// # Errors
    /// When the checkpoint of an earlier run cannot be removed.
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

    /// Resumes the run of a checkpoint that was read from `out`. Where the run was begun without a recorder it goes on without one.
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
        Self { out, physics, files, recorder, progress: None, pauses, resumed, written }
    }

    /// The same, for a person who waits.
    #[must_use]
    pub fn shown(self) -> Self {
        Self { progress: Some(Progress::new()), ..self }
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

    /// Ends what a person waiting sees; removes the checkpoint of a run that has reached its end. What is to be drawn is returned.
    ///
    /// # Errors
    /// When the checkpoint cannot be removed.
    pub fn finish(self, completed: bool) -> Result<Option<Recorder>, OutputError> {
        if let Some(progress) = self.progress {
            progress.finish();
        }
        if completed {
            checkpoint::remove(&self.out)?;
        }
        Ok(self.recorder)
    }

    fn all(&mut self) -> Multi<'_> {
        let mut all = vec![&mut self.files as &mut dyn Observer];
        all.extend(self.progress.as_mut().map(|p| p as &mut dyn Observer));
        all.extend(self.recorder.as_mut().map(|r| r as &mut dyn Observer));
        Multi::new(all)
    }
}

impl Observer for Kept {
    fn begin(&mut self, setup: &Setup) -> Result<(), OutputError> {
        if !self.resumed {
            return self.all().begin(setup);
        }
        self.files.begin(setup)?;
        self.progress.as_mut().map_or(Ok(()), |progress| progress.begin(setup))?;
        self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.resume(setup))
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        self.all().step(view)
    }

    fn stopped(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        self.all().stopped(view)
    }
}

impl Keeper for Kept {
    fn pause(
        &mut self,
        moved: bool,
        stand: &mut dyn FnMut() -> Stand,
    ) -> Result<Option<&'static str>, OutputError> {
        let reason = self.pauses.reason(moved);
        if reason.is_some() || moved && self.pauses.are_due(self.written) {
            self.save(stand())?;
        }
        Ok(reason)
    }
}
