//! Output of a run in progress: its files, energy sums, progress display and checkpoints.

use super::checkpoint::{Checkpoint, Stand};
use super::files::Files;
use super::identity;
use super::plan::Plan;
use crate::checkpoint::{self, Contents as _, FILE, Pauses, ResumeError};
use crate::warning::Warning;
use asperity_cycles::{Balance, FaultRun, Faults, Moment};
use asperity_ode::{Control, ObserveError, Observer};
use asperity_output::OutputError;
use asperity_output::progress::{Now, Progress};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// State at the last restart, if there was one.
type Before = Option<Box<Stand>>;

/// See the module.
pub struct Keeper<'a> {
    out: PathBuf,
    physics: String,
    plan: &'a Plan,
    files: Files<'a>,
    balance: Balance<'a>,
    progress: Progress,
    pauses: Pauses,
    /// Instant of the last checkpoint, and the time that writing it took.
    written: (Instant, Duration),
    steps: u64,
    /// State at the last restart.
    before: Before,
    interrupted: Option<&'static str>,
}

impl<'a> Keeper<'a> {
    /// Begins a run in `out` of a scene with this hash of its physics.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn begin(
        out: &Path,
        plan: &'a Plan,
        physics: &str,
        pauses: Pauses,
    ) -> Result<(Self, FaultRun), ResumeError> {
        checkpoint::remove(out)?;
        let files = Files::create(out, plan)?;
        let balance = Balance::new(&plan.problem);
        Ok((Self::new(out, plan, physics, (files, balance), pauses, 0), plan.begin()))
    }

    /// Resumes from the checkpoint in `out`, even if the end time or the number of events is now larger. `None` if there is no checkpoint, or if the
    /// run is to be extended and never restarted before its end.
    ///
    /// # Errors
    /// If the checkpoint is damaged or of another scene, or a file cannot be read or written.
    pub fn resume(
        out: &Path,
        plan: &'a Plan,
        physics: &str,
        pauses: Pauses,
    ) -> Result<Option<(Self, FaultRun)>, ResumeError> {
        let Some(read) = Checkpoint::read(out, physics)? else { return Ok(None) };
        if read.last.run.unknowns.len() != plan.problem.start.len() {
            return Err(checkpoint::foreign(out, "its unknowns differ from those of this scene"));
        }
        let Some((from, before)) = Self::from(out, plan, read)? else { return Ok(None) };
        let files = Files::resume(out, plan, &from.files)?;
        let balance = Balance::resume(&plan.problem, from.sums);
        let mut keeper = Self::new(out, plan, physics, (files, balance), pauses, from.run.counts.steps);
        keeper.before = before;
        Ok(Some((keeper, from.run)))
    }

    /// State to resume from, and the last restart state before it.
    fn from(out: &Path, plan: &Plan, read: Checkpoint) -> Result<Option<(Stand, Before)>, ResumeError> {
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
            return Ok(read.before.map(|before| (Stand::clone(&before), Some(before))));
        }
        Ok(Some((read.last, read.before)))
    }

    fn new(
        out: &Path,
        plan: &'a Plan,
        physics: &str,
        (files, balance): (Files<'a>, Balance<'a>),
        pauses: Pauses,
        steps: u64,
    ) -> Self {
        Self {
            out: out.to_path_buf(),
            physics: physics.to_string(),
            plan,
            files,
            balance,
            progress: Progress::new(out),
            pauses,
            written: (Instant::now(), Duration::ZERO),
            steps,
            before: None,
            interrupted: None,
        }
    }

    /// State of a run.
    fn stand(&self, run: FaultRun) -> Stand {
        Stand { run, files: self.files.position(), sums: self.balance.sums().clone() }
    }

    fn save(&mut self, last: Stand, before: Before) -> Result<(), OutputError> {
        let begun = Instant::now();
        self.files.settle()?;
        let loads = identity::loads(self.plan, last.run.at.seconds());
        let (physics, end) = (self.physics.clone(), self.plan.problem.settings.end);
        Checkpoint { physics, end, loads, last, before }.write(&self.out)?;
        self.written = (Instant::now(), begun.elapsed());
        Ok(())
    }

    /// Warning about the files at the end of the run.
    #[must_use]
    pub fn warning(&self) -> Option<Warning> {
        self.files.warning()
    }

    /// Closes the files and, if the run can be resumed, writes the last checkpoint. Returns the sums and the reason for an interruption, if any.
    ///
    /// # Errors
    /// The first write that failed.
    pub fn finish(mut self, run: &FaultRun) -> Result<(Balance<'a>, Option<&'static str>), OutputError> {
        let failed = matches!(run.outcome, asperity_ode::Outcome::Failed { .. });
        self.progress.finish(!failed && self.interrupted.is_none());
        if !failed && self.interrupted.is_none() {
            let over = run.outcome == asperity_ode::Outcome::Completed;
            let before = self.before.take().filter(|_| over);
            self.save(self.stand(run.clone()), before)?;
        }
        Ok((self.balance, self.interrupted))
    }
}

/// Steps of a rupture between two looks for a reason to interrupt it.
const BETWEEN_LOOKS: u64 = 64;

impl Keeper<'_> {
    /// True if the run is to be interrupted at a step of a rupture. It then resumes at the start of the rupture.
    fn within_rupture(&mut self) -> Result<bool, OutputError> {
        if !self.steps.is_multiple_of(BETWEEN_LOOKS) {
            return Ok(false);
        }
        self.interrupted = self.pauses.reason(true);
        let Some(before) = self.before.clone().filter(|_| self.interrupted.is_some()) else {
            return Ok(false);
        };
        self.save(Stand::clone(&before), None)?;
        Ok(true)
    }

    /// Shows the progress.
    fn show(&mut self, moment: &Moment<'_>) {
        let (time, end, step) = (moment.at.seconds(), self.plan.problem.settings.end, self.steps);
        self.progress.show(time / end, || Now {
            stage: None,
            time,
            end,
            step,
            step_length: moment.dt,
            largest_rate: Some(moment.largest),
            iterations: None,
            events: Some(moment.events().len() as u64),
        });
    }
}

impl Observer<Faults> for Keeper<'_> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Control, ObserveError> {
        self.steps += u64::from(moment.dt > 0.0);
        if moment.step.as_ref().is_some_and(|step| step.waves.is_some()) {
            self.balance.step(moment);
            if self.within_rupture()? {
                return Ok(Control::Stop);
            }
            self.show(moment);
            return self.files.step(moment);
        }
        self.show(moment);
        let (balance, files) = (&mut self.balance, &mut self.files);
        // Only the balance may multiply by the operator of the fault: a product waits for the end of another one, and a thread that
        // took up the second within the first would wait for itself.
        rayon::join(|| balance.step(moment), || files.step(moment)).1
    }

    fn pause(&mut self, run: &mut dyn FnMut() -> FaultRun) -> Result<Option<&'static str>, ObserveError> {
        self.interrupted = self.pauses.reason(true);
        let now = self.stand(run());
        self.before = Some(Box::new(now.clone()));
        if self.interrupted.is_some() || self.pauses.are_due(self.written) {
            self.save(now, None)?;
        }
        Ok(self.interrupted)
    }
}
