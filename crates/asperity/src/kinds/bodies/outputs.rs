//! Outputs of a run of bodies: its files and the data for its figures.

use super::resume_state::ResumeState;
use crate::checkpoint::{self, ResumeError};
use crate::keep::{self, Place};
use asperity_ode::Control;
use asperity_output::OutputError;
use asperity_output::bodies::view::{Setup, StepView};
use asperity_output::bodies::{FieldSchedule, Files, FilesState, Multi, Recorder, Writer};
use asperity_output::fields::Field;
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_output::terminal::progress::RunState;
use asperity_run::{Kind, ObserveError, Observer};
use serde::{Deserialize, Serialize};

/// Kind of a run of bodies.
#[derive(Clone, Copy, Debug)]
pub struct Bodies;

impl Kind for Bodies {
    type Setup = Setup;
    type Moment<'a> = StepView<'a>;
    type ResumeState = ResumeState;
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
    /// State of the run.
    stand: ResumeState,
    /// Positions in the output files.
    files: FilesState,
    /// Data for the plots at the end, if there are any.
    recorder: Option<Recorder>,
}

impl checkpoint::SavedState for Checkpoint {
    const OF: &'static str = "bodies";
    const VERSION: &'static str = "9";
}

/// See the module.
pub struct Outputs {
    files: Files,
    recorder: Option<Recorder>,
    resumed: bool,
}

impl Outputs {
    /// Data for the figures, if the run draws any.
    #[must_use]
    pub fn recorder(self) -> Option<Recorder> {
        self.recorder
    }

    /// Tables of the run, by their paths, with their columns.
    #[must_use]
    pub fn tables(&self) -> Vec<FileParts<Column>> {
        self.files.described()
    }

    /// Fields of the run, by the paths of their files.
    #[must_use]
    pub fn fields(&self) -> Vec<FileParts<Field>> {
        self.files.fields()
    }

    fn all(&mut self) -> Multi<'_> {
        let mut all = vec![&mut self.files as &mut dyn Writer];
        all.extend(self.recorder.as_mut().map(|r| r as &mut dyn Writer));
        Multi::new(all)
    }
}

impl keep::Outputs for Outputs {
    type Kind = Bodies;
    type Plan = FieldSchedule;
    type Checkpoint = Checkpoint;

    fn create(schedule: FieldSchedule, place: &Place<'_>) -> Result<Self, OutputError> {
        let recorder = place.drawn.then(|| Recorder::new().with_bodies());
        Ok(Self { files: Files::create(place.out, schedule)?, recorder, resumed: false })
    }

    /// A run that was begun without figures continues without them.
    fn reopen(
        schedule: FieldSchedule,
        place: &Place<'_>,
        Checkpoint { stand, files, recorder }: Checkpoint,
    ) -> Result<Option<(Self, ResumeState)>, ResumeError> {
        let files = Files::create(place.out, schedule)?.resumed(files);
        let recorder = recorder.filter(|_| place.drawn);
        Ok(Some((Self { files, recorder, resumed: true }, stand)))
    }

    fn begin(&mut self, setup: &Setup) -> Result<(), ObserveError> {
        if !self.resumed {
            return Ok(self.all().begin(setup)?);
        }
        self.files.begin(setup)?;
        Ok(self.recorder.as_mut().map_or(Ok(()), |recorder| recorder.resume(setup))?)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<Control, ObserveError> {
        self.all().step(view)?;
        Ok(Control::Go)
    }

    fn end(&mut self, view: &StepView<'_>) -> Result<(), ObserveError> {
        Ok(self.all().end(view)?)
    }

    fn settle(&self) -> Result<(), OutputError> {
        self.files.settle()
    }

    fn saved(&mut self, stand: &mut dyn FnMut() -> ResumeState, due: bool) -> Option<Checkpoint> {
        due.then(|| Checkpoint { stand: stand(), files: self.files.state(), recorder: self.recorder.clone() })
    }

    fn times(&self, view: &StepView<'_>) -> [f64; 2] {
        [view.record.time, view.end_time]
    }

    fn now(&self, view: &StepView<'_>) -> RunState {
        let (record, [time, end]) = (view.record, self.times(view));
        let rates = view.interfaces.iter().flat_map(|interface| &interface.slip_rate);
        RunState {
            stage: Some(view.stage.to_string()),
            time,
            end,
            step: record.step as u64,
            step_length: record.dt,
            largest_rate: rates.map(|rate| rate.abs()).filter(|rate| rate.is_finite()).reduce(f64::max),
            iterations: Some(record.iterations as u64),
            events: None,
        }
    }

    fn draws(&self) -> bool {
        self.recorder.is_some()
    }
}
