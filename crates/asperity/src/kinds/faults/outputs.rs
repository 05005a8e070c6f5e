//! Outputs of a run of faults, with its energy sums.

use super::checkpoint::{Checkpoint, StoredRun};
use super::files::Files;
use super::identity;
use crate::checkpoint::{self, FILE, ResumeError};
use crate::keep::{self, Place};
use asperity_cycles::{Balance, FaultRun, Faults, Moment};
use asperity_ode::{Control, Outcome};
use asperity_output::OutputError;
use asperity_output::terminal::progress::RunState;
use asperity_plan::faults::Plan;
use asperity_run::{ObserveError, Observer as _, Warning};
use std::path::Path;

/// State at the last restart, if there was one.
type LastRestart = Option<Box<StoredRun>>;

/// See the module.
pub struct Outputs<'a> {
    plan: &'a Plan,
    files: Files<'a>,
    balance: Balance<'a>,
    before: LastRestart,
    drawn: bool,
}

impl<'a> Outputs<'a> {
    /// State of a run.
    fn stand(&self, run: FaultRun) -> StoredRun {
        StoredRun { run, files: self.files.position(), sums: self.balance.sums() }
    }

    fn saving(&self, last: StoredRun, before: LastRestart) -> Checkpoint {
        let loads = identity::loads(self.plan, last.run.at.seconds());
        Checkpoint { end: self.plan.problem.settings.end, loads, last, before }
    }

    /// State of a run that has ended as planned. It can be resumed to a later end.
    #[must_use]
    pub fn ended(&self, run: &FaultRun) -> Checkpoint {
        let before = self.before.clone().filter(|_| run.outcome == Outcome::Completed);
        self.saving(self.stand(run.clone()), before)
    }

    /// Warning about the files at the end of the run.
    #[must_use]
    pub fn warning(&self) -> Option<Warning> {
        self.files.warning()
    }

    /// Energy sums of the run.
    pub fn balance(&mut self) -> &mut Balance<'a> {
        &mut self.balance
    }
}

/// State to resume from, and the last restart state before it, even if the end or the number of events is now larger. `None` if the run is to be
/// extended and never restarted before its end.
fn from(out: &Path, plan: &Plan, read: Checkpoint) -> Result<Option<(StoredRun, LastRestart)>, ResumeError> {
    let (path, end) = (out.join(FILE), plan.problem.settings.end);
    let run = &read.last.run;
    let (at, events) = (run.at.seconds(), run.events().len());
    if at > end || plan.problem.settings.most_events.is_some_and(|most| events > most) {
        return Err(ResumeError::Beyond { path, at, events });
    }
    if !identity::same(&read.loads, &identity::loads(plan, at)) {
        return Err(ResumeError::Loads { path, until: at });
    }
    if at < read.end {
        let before = Some(Box::new(read.last.clone()));
        return Ok(Some((read.last, before)));
    }
    if end > read.end {
        return Ok(read.before.map(|before| (StoredRun::clone(&before), Some(before))));
    }
    Ok(Some((read.last, read.before)))
}

impl<'a> keep::Outputs for Outputs<'a> {
    type Kind = Faults;
    type Plan = &'a Plan;
    type Checkpoint = Checkpoint;

    fn create(plan: &'a Plan, place: &Place<'_>) -> Result<Self, OutputError> {
        let files = Files::create(place.out, plan)?;
        let (balance, drawn) = (Balance::new(&plan.problem), place.drawn);
        Ok(Self { plan, files, balance, before: None, drawn })
    }

    fn reopen(
        plan: &'a Plan,
        place: &Place<'_>,
        saved: Checkpoint,
    ) -> Result<Option<(Self, FaultRun)>, ResumeError> {
        let (out, drawn) = (place.out, place.drawn);
        if saved.last.run.unknowns.len() != plan.problem.start.len() {
            return Err(checkpoint::foreign(out, "its unknowns differ from those of this scene"));
        }
        let Some((from, before)) = from(out, plan, saved)? else { return Ok(None) };
        let files = Files::resume(out, plan, &from.files)?;
        let balance = Balance::resume(&plan.problem, from.sums);
        Ok(Some((Self { plan, files, balance, before, drawn }, from.run)))
    }

    fn step(&mut self, moment: &Moment<'_>) -> Result<Control, ObserveError> {
        let (balance, files) = (&mut self.balance, &mut self.files);
        if moment.step.as_ref().is_some_and(|step| step.waves.is_some()) {
            balance.step(moment);
            return files.step(moment);
        }
        // Only the balance may multiply by the operator of the fault: a product waits for the end of another one, and a thread that
        // took up the second within the first would wait for itself.
        rayon::join(|| balance.step(moment), || files.step(moment)).1
    }

    fn settle(&self) -> Result<(), OutputError> {
        self.files.settle()
    }

    fn saved(&mut self, stand: &mut dyn FnMut() -> FaultRun, due: bool) -> Option<Checkpoint> {
        let now = self.stand(stand());
        self.before = Some(Box::new(now.clone()));
        due.then(|| self.saving(now, None))
    }

    /// A run that is interrupted within a rupture resumes at the start of the rupture.
    fn restart(&self, moment: &Moment<'_>) -> Option<Checkpoint> {
        moment.step.as_ref().and_then(|step| step.waves)?;
        Some(self.saving(StoredRun::clone(self.before.as_ref()?), None))
    }

    fn times(&self, moment: &Moment<'_>) -> [f64; 2] {
        [moment.at.seconds(), self.plan.problem.settings.end]
    }

    fn now(&self, moment: &Moment<'_>) -> RunState {
        let [time, end] = self.times(moment);
        RunState {
            time,
            end,
            step: self.files.steps(),
            step_length: moment.dt,
            largest_rate: Some(moment.largest),
            events: Some(moment.events().len() as u64),
            ..RunState::default()
        }
    }

    fn draws(&self) -> bool {
        self.drawn
    }
}
