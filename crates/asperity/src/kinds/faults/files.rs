//! Output files of a run that grow with it: tables, snapshots in space, and moment rates of events.
//!
//! Rows are due after changes and after intervals of simulated time, not after steps, so that the size of a file
//! depends on events.

use super::position::Position;
use super::rows::{Ends, Rows, Table};
use super::snapshots::Snapshots;
use super::source_time::SourceTimes;
use super::{
    collections, coulomb_tables, displacements, event_tables, fields, forces, largest_slip_rate, locking,
    moments, profiles, receiver_rows, receiver_tables, sampled_rows, snapshots, source_time, stations,
    stress_files, surface_profiles, surface_tables,
};
use crate::checkpoint::{self, ResumeError};
use asperity_cycles::{Faults, Moment};
use asperity_ode::{Clock, Control};
use asperity_output::fields::Field;
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::{Gauge, GaugedFile, warning};
use asperity_run::{ObserveError, Observer, Warning};
use std::path::Path;

/// Tables and fields of runs of faults; those that other kinds have too are in their lists.
pub const FILES: [OutputFile; 17] = [
    collections::EVENTS,
    displacements::COLLECTION,
    largest_slip_rate::FILE,
    moments::FILE,
    forces::FILE,
    locking::FILE,
    surface_profiles::FILE,
    receiver_rows::FILE,
    snapshots::LIST,
    source_time::FILE,
    event_tables::FILE,
    receiver_tables::FILE,
    surface_tables::FILE,
    coulomb_tables::MAP,
    coulomb_tables::POINTS,
    coulomb_tables::FAULTS,
    stress_files::FILE,
];

/// All tables of a plan that grow during the run.
fn all(plan: &Plan) -> Vec<Table<'_>> {
    let mut all = vec![largest_slip_rate::table(plan), moments::table(plan), forces::table(plan)];
    all.extend(locking::table(plan));
    all.extend(profiles::tables(plan));
    all.extend(surface_profiles::tables(plan));
    all.extend(receiver_rows::tables(&plan.receivers));
    all.extend(sampled_rows::tables(plan));
    all.extend(stations::tables(plan));
    all
}

/// Tables of a run, by their paths, with their columns: those that grow, and those of single events.
#[must_use]
pub fn tables(plan: &Plan) -> Vec<FileParts<Column>> {
    let frame = plan.frame.as_ref();
    let of_events = [
        (snapshots::LIST, snapshots::columns()),
        (source_time::FILE, source_time::columns(plan)),
        (event_tables::FILE, event_tables::columns(plan.problem.fault.law.components() > 1)),
        (receiver_tables::FILE, receiver_tables::named(frame)),
        (surface_tables::FILE, receiver_tables::columns(frame)),
        (coulomb_tables::POINTS, coulomb_tables::point_columns(frame)),
        (coulomb_tables::FAULTS, coulomb_tables::fault_columns(frame)),
    ];
    // Its names are those of the other tables of Coulomb stress, but for what follows.
    let map = plan.coulomb.as_ref().and_then(|coulomb| coulomb.map.as_ref());
    let map = map.map(|_| (coulomb_tables::MAP, coulomb_tables::map_columns(frame)));
    let growing = all(plan).into_iter().map(|table| FileParts::new(table.path, table.columns));
    growing
        .chain(of_events.into_iter().chain(map).map(|(file, columns)| FileParts::new(file.path, columns)))
        .collect()
}

/// Arrays of the fields of a run, by the paths of their files: of faults in space, of bodies, and of single events.
#[must_use]
pub fn arrays(plan: &Plan) -> Vec<FileParts<Field>> {
    let mut all = Vec::new();
    if plan.in_space {
        let of_fault = |fault| {
            let (during, last) = (fields::states(plan, fault), fields::last(plan, fault));
            [during.fields(), last.fields(), fields::events(plan, fault).fields()]
        };
        all.extend(plan.faults.iter().flat_map(of_fault));
    }
    let bodies = plan.bodies.as_ref();
    all.extend(bodies.iter().flat_map(|view| displacements::series(view).map(|series| series.fields())));
    all.extend(bodies.map(|view| stress_files::series(view).fields()));
    all
}

/// See the module.
pub struct Files<'a> {
    plan: &'a Plan,
    tables: Vec<Rows<'a>>,
    /// End of the last step, and the number of steps taken.
    before: Option<Clock>,
    step: u64,
    snapshots: Option<Snapshots<'a>>,
    events: SourceTimes,
}

impl<'a> Files<'a> {
    /// Creates the files in `out` and writes their headers.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(out: &Path, plan: &'a Plan) -> Result<Self, OutputError> {
        atomic::writable_dir(out)?;
        let tables = all(plan).into_iter().map(|table| Rows::open(out, table, None));
        Ok(Self {
            plan,
            tables: tables.collect::<Result<_, _>>()?,
            before: None,
            step: 0,
            snapshots: Snapshots::open(out, plan, None)?,
            events: SourceTimes::create(out, plan)?,
        })
    }

    /// Resumes the files in `out` at their recorded positions; anything written after them is cut off.
    ///
    /// # Errors
    /// If a file is missing, shorter than it was, or cannot be written.
    pub fn resume(out: &Path, plan: &'a Plan, from: &Position) -> Result<Self, ResumeError> {
        let all = all(plan);
        let known = all.iter().all(|table| from.gauges.contains_key(&table.path));
        if !known || all.len() != from.gauges.len() || plan.in_space != from.snapshots.is_some() {
            return Err(checkpoint::other_files(out));
        }
        let reopen = |table: Table<'a>| {
            let gauge = from.gauges.get(&table.path).copied();
            Rows::open(out, table, gauge)
        };
        Ok(Self {
            plan,
            tables: all.into_iter().map(reopen).collect::<Result<_, _>>()?,
            before: from.before,
            step: from.step,
            snapshots: Snapshots::open(out, plan, from.snapshots)?,
            events: SourceTimes::resume(out, plan, from.events)?,
        })
    }

    /// Current positions in the files.
    #[must_use]
    pub fn position(&self) -> Position {
        Position {
            gauges: self.tables.iter().map(Rows::position).collect(),
            before: self.before,
            step: self.step,
            snapshots: self.snapshots.as_ref().map(Snapshots::taken),
            events: self.events.written(),
        }
    }

    /// Number of steps taken.
    pub(super) fn steps(&self) -> u64 {
        self.step
    }

    /// Waits until all files are on the disc.
    ///
    /// # Errors
    /// If something could not be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.events.settle()?;
        self.snapshots.iter().try_for_each(Snapshots::settle)?;
        self.tables.iter().try_for_each(Rows::settle)
    }

    /// Warning about files whose rows have been thinned out.
    #[must_use]
    pub fn warning(&self) -> Option<Warning> {
        let mut files: Vec<(String, Gauge)> = self.tables.iter().map(Rows::position).collect();
        files.extend(self.snapshots.as_ref().map(|s| ("fields".to_string(), s.taken().gauge)));
        files.extend(self.events.coarse());
        let files: Vec<GaugedFile> =
            files.into_iter().map(|(name, gauge)| GaugedFile { name, gauge }).collect();
        warning(&files, self.plan.cadence.largest_file)
    }
}

impl Observer<Faults> for Files<'_> {
    fn step(&mut self, now: &Moment<'_>) -> Result<Control, ObserveError> {
        let plan = self.plan;
        let earlier = self.before.replace(now.at);
        self.step += u64::from(now.dt > 0.0);
        let then = now.step.as_ref().zip(earlier).map(|(step, at)| now.start_of(step, at));
        let ends = Ends { now, then: then.as_ref(), step: self.step };
        self.tables.iter_mut().try_for_each(|table| table.step(plan, ends))?;
        self.events.step(plan, now)?;
        self.snapshots.iter_mut().try_for_each(|snapshots| snapshots.take(plan, now))?;
        Ok(Control::Go)
    }
}
