//! Keeps what a run leaves behind: its files, its sums, what a person waiting sees, and the checkpoints.

use super::balance::Balance;
use super::checkpoint::{Checkpoint, ResumeError};
use super::files::Files;
use super::plan::Plan;
use super::report;
use super::run::{Moment, Run, Watcher};
use crate::observe::{ObserveError, Progress};
use crate::ode::Control;
use crate::warning::Warning;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// When checkpoints are written and when a run is broken off.
#[derive(Clone, Debug, Default)]
pub struct Pauses {
    /// Wall time between two checkpoints.
    pub every: Duration,
    /// Wall time of the integration after which to break off.
    pub wall: Option<Duration>,
    /// Set from outside to break off.
    pub stop: Arc<AtomicBool>,
}

/// See the module.
pub struct Keeper<'a> {
    out: PathBuf,
    scene: String,
    plan: &'a Plan,
    files: Files<'a>,
    balance: Balance<'a>,
    progress: Progress,
    pauses: Pauses,
    started: Instant,
    /// When the last checkpoint was written.
    written: Instant,
    steps: u64,
    interrupted: Option<&'static str>,
    failure: Option<ObserveError>,
}

impl<'a> Keeper<'a> {
    /// Begins a run in `out`, whose scene with its mesh files has the hash `scene`.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn begin(
        out: &Path,
        plan: &'a Plan,
        scene: &str,
        pauses: Pauses,
    ) -> Result<(Self, Run), ResumeError> {
        Checkpoint::remove(out)?;
        let files = Files::create(out, plan)?;
        let faults: Vec<_> = plan.faults.iter().map(|f| f.points.clone()).collect();
        let thresholds = plan.settings.thresholds;
        let run = Run::new(plan.start.clone(), thresholds).of_faults(&faults, thresholds);
        Ok((Self::new(out, plan, scene, (files, Balance::new(plan)), pauses, 0), run))
    }

    /// Goes on from the checkpoint in `out`; none where there is none.
    ///
    /// # Errors
    /// When the checkpoint is damaged or of another scene, or a file cannot be read or written.
    pub fn resume(
        out: &Path,
        plan: &'a Plan,
        scene: &str,
        pauses: Pauses,
    ) -> Result<Option<(Self, Run)>, ResumeError> {
        let Some(read) = Checkpoint::read(out, scene)? else { return Ok(None) };
        if read.run.unknowns.len() != plan.start.len() {
            return Err(Checkpoint::foreign(out, "it has not the unknowns of this scene"));
        }
        let files = Files::resume(out, plan, &read.files)?;
        let balance = Balance::resume(plan, read.sums);
        let keeper = Self::new(out, plan, scene, (files, balance), pauses, read.run.counts.steps);
        Ok(Some((keeper, read.run)))
    }

    fn new(
        out: &Path,
        plan: &'a Plan,
        scene: &str,
        (files, balance): (Files<'a>, Balance<'a>),
        pauses: Pauses,
        steps: u64,
    ) -> Self {
        let now = Instant::now();
        Self {
            out: out.to_path_buf(),
            scene: scene.to_string(),
            plan,
            files,
            balance,
            progress: Progress::new(),
            pauses,
            started: now,
            written: now,
            steps,
            interrupted: None,
            failure: None,
        }
    }

    /// Why the run is to be broken off now.
    fn reason(&self) -> Option<&'static str> {
        if self.pauses.stop.load(Ordering::Relaxed) {
            return Some("a signal asked for it");
        }
        self.pauses.wall.is_some_and(|wall| self.started.elapsed() >= wall).then_some("its wall time is over")
    }

    fn save(&mut self, run: &Run) -> Result<(), ObserveError> {
        let files = self.files.position()?;
        let sums = self.balance.sums().clone();
        Checkpoint { scene: self.scene.clone(), run: run.clone(), files, sums }.write(&self.out)?;
        self.written = Instant::now();
        Ok(())
    }

    /// What is to be said of the files, once the run has ended.
    #[must_use]
    pub fn warning(&self) -> Option<Warning> {
        self.files.warning()
    }

    /// Ends the files and, where the run can be gone on with, writes the last checkpoint. Returns the sums, and why the run was
    /// broken off where it was.
    ///
    /// # Errors
    /// The first thing that could not be written.
    pub fn finish(mut self, run: &Run) -> Result<(Balance<'a>, Option<&'static str>), ObserveError> {
        self.progress.finish();
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        if let Some(failure) = self.files.failure() {
            return Err(failure);
        }
        let failed = matches!(run.outcome, crate::ode::Outcome::Failed { .. });
        if !failed && self.interrupted.is_none() {
            self.save(run)?;
        }
        Ok((self.balance, self.interrupted))
    }
}

impl Watcher for Keeper<'_> {
    fn now(&mut self, moment: &Moment<'_>) -> Control {
        self.steps += u64::from(moment.dt > 0.0);
        self.balance.step(moment);
        let (part, steps) = (moment.at.seconds() / self.plan.settings.end, self.steps);
        self.progress.show(part, || {
            format!(
                "t = {}, max V = {:.3e} m/s, step {steps} of {:.3e} s, {} events",
                report::time(moment.at.seconds()),
                moment.largest,
                moment.dt,
                moment.catalogue.events().len()
            )
        });
        self.files.now(moment)
    }

    fn pause(&mut self, run: &Run) -> Control {
        self.interrupted = self.reason();
        if self.interrupted.is_none() && self.written.elapsed() < self.pauses.every {
            return Control::Go;
        }
        if let Err(failure) = self.save(run) {
            self.failure = Some(failure);
            return Control::Stop;
        }
        if self.interrupted.is_some() { Control::Stop } else { Control::Go }
    }
}
