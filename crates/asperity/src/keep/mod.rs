//! Keeps a run of any kind in its directory: outputs, progress, checkpoints and interruptions.

mod table;

pub use table::Table;

use crate::checkpoint::{self, Pauses, ResumeError, SavedState};
use asperity_ode::Control;
use asperity_output::OutputError;
use asperity_output::terminal::progress::{Progress, RunState};
use asperity_run::{Interrupt, Kind, ObserveError, Observer};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Directory of a run, and how the run is kept there.
#[derive(Clone, Debug)]
pub struct Place<'a> {
    /// The directory.
    pub out: &'a Path,
    /// Hash of everything that must not change when the run is resumed.
    pub physics: &'a str,
    /// True if figures are drawn at the end.
    pub drawn: bool,
    /// Times of checkpoints, and reasons to interrupt the run.
    pub pauses: Pauses,
}

/// State from which a run of a kind resumes.
pub type ResumeState<O> = <<O as Outputs>::Kind as Kind>::ResumeState;

/// Outputs of one kind of run, and the state from which both resume.
pub trait Outputs: Sized {
    /// Kind of run.
    type Kind: Kind;
    /// Plan of the run, by reference.
    type Plan;
    /// State of the run and of its outputs in a checkpoint.
    type Checkpoint: SavedState;

    /// Creates the outputs of a run that begins.
    ///
    /// # Errors
    /// If a file cannot be written.
    fn create(plan: Self::Plan, place: &Place<'_>) -> Result<Self, OutputError>;

    /// Reopens the outputs of a run that resumes, with its state. `None` if it has to begin anew.
    ///
    /// # Errors
    /// If the state does not fit the plan, or a file cannot be read or written.
    fn reopen(
        plan: Self::Plan,
        place: &Place<'_>,
        saved: Self::Checkpoint,
    ) -> Result<Option<(Self, ResumeState<Self>)>, ResumeError>;

    /// Sees the run before its first step.
    ///
    /// # Errors
    /// If something cannot be written.
    fn begin(&mut self, _setup: &<Self::Kind as Kind>::Setup) -> Result<(), ObserveError> {
        Ok(())
    }

    /// Writes the rows and fields that are due.
    ///
    /// # Errors
    /// If something cannot be written.
    fn step(&mut self, moment: &<Self::Kind as Kind>::Moment<'_>) -> Result<Control, ObserveError>;

    /// Learns that the moment seen last is the onset, the end or an extreme of an event at this point.
    ///
    /// # Errors
    /// If something cannot be written.
    fn event(&mut self, _point: usize) -> Result<(), ObserveError> {
        Ok(())
    }

    /// Receives the last good state of a run that cannot continue.
    ///
    /// # Errors
    /// If something cannot be written.
    fn end(&mut self, _moment: &<Self::Kind as Kind>::Moment<'_>) -> Result<(), ObserveError> {
        Ok(())
    }

    /// Waits until all rows are on the disc.
    ///
    /// # Errors
    /// If something cannot be written.
    fn settle(&self) -> Result<(), OutputError>;

    /// State to be saved where the run may be interrupted, if a checkpoint is due.
    fn saved(&mut self, stand: &mut dyn FnMut() -> ResumeState<Self>, due: bool) -> Option<Self::Checkpoint>;

    /// State to be saved if the run is interrupted at this step. `None`, as usual, where it is interrupted only between steps.
    fn restart(&self, _moment: &<Self::Kind as Kind>::Moment<'_>) -> Option<Self::Checkpoint> {
        None
    }

    /// Time of a moment, and end of the run \[s\].
    fn times(&self, moment: &<Self::Kind as Kind>::Moment<'_>) -> [f64; 2];

    /// State for the display of progress.
    fn now(&self, moment: &<Self::Kind as Kind>::Moment<'_>) -> RunState;

    /// True if the run draws figures at its end. A run that was begun without them does not.
    fn draws(&self) -> bool;
}

/// Wall time of a step below which its end is awaited: little is lost by that, and nothing has to be repeated.
const SHORT: Duration = Duration::from_secs(5);

/// Observer that keeps a run in its directory.
pub struct Keeper<O> {
    out: PathBuf,
    physics: String,
    outputs: O,
    progress: Progress,
    pauses: Pauses,
    /// True if a step has been tried since the run began or was resumed.
    moved: bool,
    /// True if a step has been accepted since then.
    advanced: bool,
    /// Instant of the last checkpoint, and the time that writing it took.
    written: (Instant, Duration),
    interrupted: Option<&'static str>,
}

impl<O: Outputs> Keeper<O> {
    /// Begins a run.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn begin(plan: O::Plan, place: Place<'_>) -> Result<Self, OutputError> {
        checkpoint::remove(place.out)?;
        let outputs = O::create(plan, &place)?;
        Ok(Self::new(place, outputs))
    }

    /// Resumes the run of the checkpoint, if there is one that can be resumed.
    ///
    /// # Errors
    /// If the checkpoint is damaged or of another scene, or a file cannot be read or written.
    pub fn resume(plan: O::Plan, place: Place<'_>) -> Result<Option<(Self, ResumeState<O>)>, ResumeError> {
        let Some(saved) = checkpoint::read(place.out, place.physics)? else { return Ok(None) };
        let reopened = O::reopen(plan, &place, saved)?;
        Ok(reopened.map(|(outputs, stand)| (Self::new(place, outputs), stand)))
    }

    fn new(place: Place<'_>, outputs: O) -> Self {
        Self {
            out: place.out.to_path_buf(),
            physics: place.physics.to_string(),
            outputs,
            progress: Progress::unseen(place.out),
            pauses: place.pauses,
            moved: false,
            advanced: false,
            written: (Instant::now(), Duration::ZERO),
            interrupted: None,
        }
    }

    /// The same run with a display of its progress.
    #[must_use]
    pub fn shown(self) -> Self {
        Self { progress: Progress::new(&self.out), ..self }
    }

    /// Outputs of the run.
    #[must_use]
    pub fn outputs(&self) -> &O {
        &self.outputs
    }

    /// Outputs of the run.
    pub fn outputs_mut(&mut self) -> &mut O {
        &mut self.outputs
    }

    /// Reason why the run was interrupted, if it was.
    #[must_use]
    pub fn interrupted(&self) -> Option<&'static str> {
        self.interrupted
    }

    /// Writes a checkpoint.
    ///
    /// # Errors
    /// If something cannot be written.
    pub fn save(&mut self, saved: &O::Checkpoint) -> Result<(), OutputError> {
        self.save_since(Instant::now(), saved)
    }

    /// Writes a checkpoint whose state was copied from the instant `begun` on, which counts as its cost.
    fn save_since(&mut self, begun: Instant, saved: &O::Checkpoint) -> Result<(), OutputError> {
        self.outputs.settle()?;
        checkpoint::write(&self.out, &self.physics, saved)?;
        self.written = (Instant::now(), begun.elapsed());
        Ok(())
    }

    /// Ends the display of progress, and returns the outputs.
    #[must_use]
    pub fn finish(self, completed: bool) -> O {
        self.progress.finish(completed);
        self.outputs
    }
}

impl<O: Outputs> Observer<O::Kind> for Keeper<O> {
    fn begin(&mut self, setup: &<O::Kind as Kind>::Setup) -> Result<(), ObserveError> {
        self.progress.begin();
        self.outputs.begin(setup)
    }

    fn step(&mut self, moment: &<O::Kind as Kind>::Moment<'_>) -> Result<Control, ObserveError> {
        (self.moved, self.advanced) = (true, true);
        let control = self.outputs.step(moment)?;
        let [time, end] = self.outputs.times(moment);
        self.progress.show(time / end, || self.outputs.now(moment));
        let Some(reason) = self.pauses.reason(true) else { return Ok(control) };
        let Some(saved) = self.outputs.restart(moment) else { return Ok(control) };
        self.save(&saved)?;
        self.interrupted = Some(reason);
        Ok(Control::Stop)
    }

    fn event(&mut self, point: usize) -> Result<(), ObserveError> {
        self.outputs.event(point)
    }

    fn pause(
        &mut self,
        stand: &mut dyn FnMut() -> ResumeState<O>,
    ) -> Result<Option<&'static str>, ObserveError> {
        let moved = std::mem::replace(&mut self.moved, true);
        self.interrupted = self.pauses.reason(moved);
        let due = self.interrupted.is_some() || moved && self.pauses.are_due(self.written.0, self.written.1);
        let begun = Instant::now();
        if let Some(saved) = self.outputs.saved(stand, due) {
            self.save_since(begun, &saved)?;
        }
        Ok(self.interrupted)
    }

    fn interrupt(&self) -> Interrupt {
        let (pauses, advanced, begun) = (self.pauses.clone(), self.advanced, Instant::now());
        Interrupt::new(move || begun.elapsed() >= SHORT && pauses.reason(advanced).is_some())
    }

    fn end(&mut self, moment: &<O::Kind as Kind>::Moment<'_>) -> Result<(), ObserveError> {
        self.outputs.end(moment)
    }
}
