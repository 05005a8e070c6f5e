//! Output of a run in progress: its files, progress display and checkpoints.

use super::arrivals::Arrivals;
use super::fields::{Fields, Taken};
use super::moment::Moment;
use super::plan::Plan;
use super::tables::Tables;
use super::{figures, seismograms};
use crate::checkpoint::{self, Contents, Pauses, ResumeError};
use crate::run_doubts::Worst;
use crate::warning::Warning;
use asperity_mechanics::dynamics::ExplicitState;
use asperity_output::decimals::shortest;
use asperity_output::plots::Asked;
use asperity_output::progress::{Now, Progress};
use asperity_output::{OutputError, atomic};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Steps between those whose strains are judged: a wave crosses some tens of cells meanwhile, and judging takes as long as a step.
const JUDGED: usize = 64;

/// Everything needed to resume a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of the scene and of the mesh files it names.
    physics: String,
    /// State of bodies and faults.
    pub state: ExplicitState,
    sizes: Vec<u64>,
    arrivals: Arrivals,
    taken: Taken,
    worst: Worst,
    drawn: bool,
}

impl Contents for Checkpoint {
    const OF: &'static str = "bodies with mass";
    const VERSION: &'static str = "2";
    const ALLOWED: &'static str = "its title and its layout";

    fn physics(&self) -> &str {
        &self.physics
    }
}

/// See the module.
pub struct Keeper<'a, const D: usize> {
    out: PathBuf,
    physics: String,
    plan: &'a Plan<D>,
    tables: Tables,
    fields: Fields,
    arrivals: Arrivals,
    worst: Worst,
    progress: Progress,
    pauses: Pauses,
    drawn: bool,
    /// True if a step has been taken since the run began or was resumed.
    moved: bool,
    /// Instant of the last checkpoint, and the time that writing it took.
    written: (Instant, Duration),
}

impl<'a, const D: usize> Keeper<'a, D> {
    /// Begins a run in `out` of a scene with this hash of its physics.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn begin(
        out: &Path,
        plan: &'a Plan<D>,
        physics: &str,
        drawn: bool,
        pauses: Pauses,
    ) -> Result<Self, OutputError> {
        checkpoint::remove(out)?;
        atomic::writable_dir(out)?;
        for (folder, used) in [
            ("stations", plan.faults.iter().any(|f| !f.stations.is_empty())),
            ("seismograms", !plan.receivers.is_empty()),
        ] {
            if used {
                atomic::create_dir(&out.join(folder))?;
            }
        }
        let tables = Tables::open(out, plan, None)?;
        let fields = Fields::new(out, plan, Taken::default(), drawn)?;
        let arrivals = Arrivals::new(plan.points.len());
        let seen = (arrivals, Worst::default());
        Ok(Self::new(out, (plan, physics), (tables, fields, seen), drawn, pauses))
    }

    /// Resumes from the checkpoint in `out`; `None` if there is none.
    ///
    /// # Errors
    /// If the checkpoint is damaged or of another scene, or a file cannot be read or written.
    pub fn resume(
        out: &Path,
        plan: &'a Plan<D>,
        physics: &str,
        drawn: bool,
        pauses: Pauses,
    ) -> Result<Option<(Self, ExplicitState)>, ResumeError> {
        let Some(read) = Checkpoint::read(out, physics)? else { return Ok(None) };
        let tables = Tables::open(out, plan, Some(&read.sizes))?;
        if tables.sizes().len() != read.sizes.len() || read.arrivals.times.len() != plan.points.len() {
            return Err(checkpoint::foreign(out, "it has not the output files of this scene"));
        }
        let drawn = drawn && read.drawn;
        let fields = Fields::new(out, plan, read.taken, drawn)?;
        let seen = (read.arrivals, read.worst);
        let keeper = Self::new(out, (plan, physics), (tables, fields, seen), drawn, pauses);
        Ok(Some((keeper, read.state)))
    }

    fn new(
        out: &Path,
        (plan, physics): (&'a Plan<D>, &str),
        (tables, fields, (arrivals, worst)): (Tables, Fields, (Arrivals, Worst)),
        drawn: bool,
        pauses: Pauses,
    ) -> Self {
        Self {
            out: out.to_path_buf(),
            physics: physics.to_string(),
            plan,
            tables,
            fields,
            arrivals,
            worst,
            progress: Progress::new(out),
            pauses,
            drawn,
            moved: false,
            written: (Instant::now(), Duration::ZERO),
        }
    }

    /// The same run without a display of its progress.
    #[must_use]
    pub fn unseen(self) -> Self {
        Self { progress: Progress::unseen(&self.out), ..self }
    }

    /// True if plots are drawn at the end.
    #[must_use]
    pub fn draws(&self) -> bool {
        self.drawn
    }

    /// Rupture times and largest slip rates so far.
    #[must_use]
    pub fn arrivals(&self) -> &Arrivals {
        &self.arrivals
    }

    /// Receives the displacements of a step \[m\], of which it judges a few, and those at the `end`.
    pub fn judge(&mut self, (step, time): (usize, f64), displacement: &[f64], end: bool) {
        if end || step.is_multiple_of(JUDGED) {
            self.worst.judge((&self.plan.problem.model, time), displacement);
        }
    }

    /// Warnings about strains and rotations so far.
    #[must_use]
    pub fn doubts(&self) -> Vec<Warning> {
        let problem = &self.plan.problem;
        problem.stages.iter().flat_map(|stage| self.worst.of_bodies(&problem.model, &stage.name)).collect()
    }

    /// Receives a step.
    ///
    /// # Errors
    /// If an output cannot be written.
    pub fn step(&mut self, now: &Moment<'_>) -> Result<(), OutputError> {
        let plan = self.plan;
        if !plan.points.is_empty() {
            self.arrivals.see(now.time, &now.fault.rate, plan.rupture_rate);
        }
        self.moved = true;
        self.progress.show(now.time / plan.end(), || Now {
            stage: None,
            time: now.time,
            end: plan.end(),
            step: now.step as u64,
            step_length: plan.end() / plan.steps as f64,
            largest_rate: now.fault.rate.iter().map(|rate| rate.abs()).reduce(f64::max),
            iterations: None,
            events: None,
        });
        self.tables.step(plan, now)?;
        self.fields.step(plan, now)
    }

    /// Called before a step: writes a checkpoint if one is due, and returns the reason to interrupt the run, if any.
    ///
    /// # Errors
    /// If the checkpoint cannot be written.
    pub fn pause(
        &mut self,
        state: impl FnOnce() -> ExplicitState,
    ) -> Result<Option<&'static str>, OutputError> {
        let reason = self.pauses.reason(self.moved);
        if reason.is_some() || self.moved && self.pauses.are_due(self.written) {
            self.save(state())?;
        }
        Ok(reason)
    }

    fn save(&mut self, state: ExplicitState) -> Result<(), OutputError> {
        let begun = Instant::now();
        self.tables.settle()?;
        let checkpoint = Checkpoint {
            physics: self.physics.clone(),
            state,
            sizes: self.tables.sizes(),
            arrivals: self.arrivals.clone(),
            taken: self.fields.taken.clone(),
            worst: self.worst.clone(),
            drawn: self.drawn,
        };
        checkpoint.write(&self.out)?;
        self.written = (Instant::now(), begun.elapsed());
        Ok(())
    }

    /// Writes the files at the end of a run at a time \[s\].
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn finish(self, completed: bool, end: f64) -> Result<(), OutputError> {
        self.progress.finish(completed);
        let (out, plan) = (&self.out, self.plan);
        self.fields.collect(out, plan)?;
        seismograms::write(out, plan)?;
        if !plan.points.is_empty() {
            atomic::write(&out.join("rupture_times.csv"), ruptures(plan, &self.arrivals).as_bytes())?;
        }
        let sheet = figures::sheet(plan, end, &self.arrivals, &self.fields.taken);
        sheet.write(out)?;
        if self.drawn {
            sheet.draw(out, &out.join("plots"), &Asked::default())?;
        }
        Ok(())
    }
}

/// Table of rupture times; NaN for points that did not rupture.
fn ruptures<const D: usize>(plan: &Plan<D>, arrivals: &Arrivals) -> String {
    let mut text = String::from("fault,x [m],y [m],z [m],time [s],largest slip_rate [m/s]\n");
    for fault in &plan.faults {
        for p in fault.points.clone() {
            let place = plan.points[p].at.map(shortest).join(",");
            let time = arrivals.times[p].map_or("NaN".into(), shortest);
            text.push_str(&format!("{},{place},{time},{}\n", fault.name, shortest(arrivals.fastest[p])));
        }
    }
    text
}
