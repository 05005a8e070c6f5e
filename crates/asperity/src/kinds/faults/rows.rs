//! Tables of a run of faults, and the rows that are due in them.

use crate::keep;
use asperity_cycles::{Faults, Moment};
use asperity_output::OutputError;
use asperity_output::tables::GrowingTable;
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::{Cadence, Gauge, Reading};
use std::path::Path;

/// A table of a run of faults.
pub(super) type Table<'a> = keep::Table<'a, Faults, Course>;

/// Course that the rows of a table follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Course {
    /// The largest slip rate.
    Largest,
    /// The slip rate of a point.
    Point(usize),
    /// Time, as profiles do, and log10 of the largest slip rate, if it changes by `change`.
    Time {
        /// Change of log10 after which a row is due before its time.
        change: f64,
        /// True if there is none in events.
        between_events: bool,
    },
}

/// The end of a step, and its start if the method provides it.
#[derive(Clone, Copy)]
pub(super) struct Ends<'a> {
    /// The end.
    pub now: &'a Moment<'a>,
    /// The start.
    pub then: Option<&'a Moment<'a>>,
    /// Number of steps taken.
    pub step: u64,
}

/// A table that grows by whole rows, with the gauge that decides when the next one is due.
pub(super) struct Rows<'a> {
    table: Table<'a>,
    file: GrowingTable,
    gauge: Gauge,
}

impl<'a> Rows<'a> {
    /// Creates a table in `out`, or resumes it at the size recorded in its gauge; anything beyond is cut off.
    ///
    /// # Errors
    /// If the file cannot be written, or is missing or shorter than it was.
    pub fn open(out: &Path, table: Table<'a>, from: Option<Gauge>) -> Result<Self, OutputError> {
        let file = table.open(out, from.map(|gauge| gauge.bytes))?;
        let gauge = from.unwrap_or_else(|| Gauge::from_size(file.bytes()));
        Ok(Self { table, file, gauge })
    }

    /// Path of the table below the output directory, and its gauge.
    pub fn position(&self) -> (String, Gauge) {
        (self.table.path.clone(), self.gauge)
    }

    /// Waits until all rows are on the disc.
    ///
    /// # Errors
    /// If something could not be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.file.settle()
    }

    /// Writes the rows that are due after a step.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn step(&mut self, plan: &Plan, ends: Ends<'_>) -> Result<(), OutputError> {
        let now = ends.now;
        match self.table.course {
            Course::Largest => self.follow(plan, now.largest, ends),
            Course::Point(point) => self.follow(plan, now.speed(point), ends),
            Course::Time { change, between_events } => {
                let fast = now.largest >= plan.problem.settings.thresholds.on;
                if fast && between_events {
                    return Ok(());
                }
                let reading = Reading { time: now.at.seconds(), rate: now.largest };
                let interval = plan.cadence.contours[usize::from(fast)];
                if self.gauge.profile(reading, interval, change) {
                    self.push(&plan.cadence, now, ends.step)?;
                }
                Ok(())
            }
        }
    }

    /// Writes the rows that are due by a slip rate: one for this step, and one for its start if the rate had an extremum there.
    fn follow(&mut self, plan: &Plan, rate: f64, ends: Ends<'_>) -> Result<(), OutputError> {
        let Ends { now, then, step } = ends;
        let due = self.gauge.step(&plan.cadence, Reading { time: now.at.seconds(), rate });
        let mut at_end = due.now;
        if due.before {
            match then {
                Some(then) => self.push(&plan.cadence, then, step.saturating_sub(1))?,
                // A method that does not provide the start of its steps: the row comes one step late.
                None => at_end = true,
            }
        }
        if at_end && !self.gauge.full { self.push(&plan.cadence, now, step) } else { Ok(()) }
    }

    /// Writes the row of a moment.
    fn push(&mut self, cadence: &Cadence, now: &Moment<'_>, step: u64) -> Result<(), OutputError> {
        let row = (self.table.row)(now, step);
        self.gauge.spend(row.len() as u64, cadence.largest_file, now.at.seconds());
        self.file.push(row.as_bytes())
    }
}

/// Row of values at a time \[s\].
pub(super) fn line(time: f64, values: impl IntoIterator<Item = String>) -> String {
    let mut row = format!("{time:.14e}");
    for value in values {
        row.push(',');
        row.push_str(&value);
    }
    row.push('\n');
    row
}
