//! Moment rates of events, one file each: a row at the onset, at the end of every step and at the end of the event.
//!
//! Onset and end lie within steps. The rates there are interpolated linearly, so that the integral by the trapezoidal rule
//! over a file is that over the steps.

use super::moments;
use crate::checkpoint::ResumeError;
use asperity_cycles::{Moment, Rupture};
use asperity_ode::Clock;
use asperity_output::decimals::scientific;
use asperity_output::tables::GrowingTable;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::Gauge;
use asperity_run::{ALL, Event};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Folder of the files of events.
pub(super) const FOLDER: &str = "events";
/// Moment rates of events.
pub(super) const FILE: OutputFile = OutputFile::new("events/moment_rate_*.csv", "moment rate of each event");

/// Name of the file of an event by its number.
pub(super) fn name(number: usize) -> String {
    format!("moment_rate_{number:03}.csv")
}

/// Files written so far, and the state of the last one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct SourceTimeState {
    /// Number of events seen.
    events: usize,
    /// Gauge of the last file, while its event lasts.
    open: Option<Gauge>,
    /// Steps since its last row.
    skipped: u64,
    /// The file that ended beyond half of its largest size first.
    coarse: Option<(usize, Gauge)>,
    /// Time and moment rate \[N m/s; N/s\] at the end of the last step.
    last: Option<(Clock, f64)>,
}

/// Files of the moment rates of events.
#[derive(Debug)]
pub(super) struct SourceTimes {
    folder: PathBuf,
    file: Option<GrowingTable>,
    written: SourceTimeState,
}

impl SourceTimes {
    /// Creates the folder, if events have files.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn create(out: &Path, plan: &Plan) -> Result<Self, OutputError> {
        let folder = out.join(FOLDER);
        if plan.event_files > 0 {
            atomic::create_dir(&folder)?;
        }
        Ok(Self { folder, file: None, written: SourceTimeState::default() })
    }

    /// Resumes after what has been written.
    ///
    /// # Errors
    /// If a file is missing or shorter than it was.
    pub fn resume(out: &Path, plan: &Plan, written: SourceTimeState) -> Result<Self, ResumeError> {
        let mut files = Self::create(out, plan)?;
        if let Some(gauge) = written.open {
            let path = files.folder.join(name(written.events - 1));
            files.file = Some(GrowingTable::reopen(path, gauge.bytes)?);
        }
        Ok(Self { written, ..files })
    }

    /// Files written so far.
    pub fn written(&self) -> SourceTimeState {
        self.written
    }

    /// Waits until the open file is on the disc.
    ///
    /// # Errors
    /// If something could not be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.file.iter().try_for_each(GrowingTable::settle)
    }

    /// Files with fewer rows than steps, as for [`asperity_plan::faults::cadence::warning`].
    pub fn coarse(&self) -> Option<(String, Gauge)> {
        let open = self.written.open.map(|gauge| (self.written.events - 1, gauge));
        let (number, gauge) = self.written.coarse.or(open)?;
        Some((format!("{FOLDER}/{}", name(number)), gauge))
    }

    /// Writes the rows of a step.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn step(&mut self, plan: &Plan, now: &Moment<'_>) -> Result<(), OutputError> {
        let here = (now.at, moments::rate(plan, now));
        let before = self.written.last.replace(here).unwrap_or(here);
        let events = now.catalogue.events(ALL);
        let between = |at: &Clock| interpolated(at, before, here);
        if let Some(event) = events.get(self.written.events) {
            self.written.events += 1;
            if self.written.events <= plan.event_files {
                self.begin(plan)?;
                self.push(plan, event, (event.onset, between(&event.onset)), true)?;
            }
        }
        let Some(event) = self.written.open.and_then(|_| events.get(self.written.events - 1)) else {
            return Ok(());
        };
        match event.end {
            Some(end) => {
                self.push(plan, event, (end, between(&end)), true)?;
                self.finish()
            }
            None => self.push(plan, event, here, false),
        }
    }

    fn begin(&mut self, plan: &Plan) -> Result<(), OutputError> {
        let head = column::header(&columns(plan));
        let path = self.folder.join(name(self.written.events - 1));
        self.file = Some(GrowingTable::create(path, head.as_bytes())?);
        self.written.open = Some(Gauge::from_size(head.len() as u64));
        self.written.skipped = 0;
        Ok(())
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.settle()?;
        let (number, gauge) = (self.written.events - 1, self.written.open.take());
        let coarse = gauge.filter(|g| g.coarse_since.is_some()).map(|gauge| (number, gauge));
        self.written.coarse = self.written.coarse.or(coarse);
        self.file = None;
        Ok(())
    }

    /// Writes a row of the open file. Once the file is beyond half of its largest size, only every second step has one, and so
    /// on.
    fn push(
        &mut self,
        plan: &Plan,
        event: &Event<Rupture>,
        (at, rate): (Clock, f64),
        needed: bool,
    ) -> Result<(), OutputError> {
        let since = at.since(&event.onset);
        let (Some(file), Some(gauge)) = (&mut self.file, &mut self.written.open) else { return Ok(()) };
        self.written.skipped += 1;
        let due = self.written.skipped as f64 >= gauge.factor();
        if gauge.full || !(needed || due && since > 0.0) {
            return Ok(());
        }
        self.written.skipped = 0;
        let row = format!("{},{}\n", scientific(since, 9), scientific(rate, 9));
        gauge.spend(row.len() as u64, plan.cadence.largest_file, at.seconds());
        file.push(row.as_bytes())
    }
}

/// Columns of the tables.
pub(super) fn columns(plan: &Plan) -> Vec<Column> {
    let unit = if plan.in_space { "N m/s" } else { "N/s" };
    vec![
        Column::new("time since onset", "s", Sign::None, "time since the onset of the event"),
        Column::new("moment_rate", unit, Sign::Size, "moment rate of all faults together"),
    ]
}

/// Rate at a time within a step from its ends.
fn interpolated(at: &Clock, (begin, first): (Clock, f64), (end, last): (Clock, f64)) -> f64 {
    let length = end.since(&begin);
    let share = if length > 0.0 { at.since(&begin) / length } else { 1.0 };
    first + share * (last - first)
}
