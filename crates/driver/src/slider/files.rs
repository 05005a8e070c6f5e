//! Histories as CSV, a row where something changed.

use super::plan::Plan;
use super::run::{Now, Watcher};
use crate::observe::{ObserveError, atomic};
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// A row is written when ln V of a slider has changed by so much: curves drawn through such rows cannot be told from the
/// solution, and files grow with what happens, not with the number of steps.
const CHANGE: f64 = 0.05;

/// Rows are written at this share of the run at least.
const SHARE: f64 = 1e-3;

/// Streams `history/<slider>.csv`; each grows by whole rows.
#[derive(Debug)]
pub struct Histories {
    files: Vec<(PathBuf, fs::File)>,
    last: Option<(f64, Vec<f64>)>,
    pending: Option<Vec<String>>,
}

impl Histories {
    /// Makes the files with their headers.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn create(out: &Path, plan: &Plan) -> Result<Self, ObserveError> {
        atomic::writable_dir(out)?;
        let folder = out.join("history");
        atomic::create_dir(&folder)?;
        let stems = crate::observe::stems(plan.names.iter().map(String::as_str));
        let mut files = Vec::new();
        for (stem, slider) in stems.iter().zip(plan.system.sliders()) {
            let path = folder.join(format!("{stem}.csv"));
            let states = (1..=slider.law.states()).map(|i| format!(",state_{i}"));
            let head = "time [s],step [s],slip [m],slip_rate [m/s],friction [-],traction [Pa],normal_traction [Pa],load [m]";
            atomic::write(&path, format!("{head}{}\n", states.collect::<String>()).as_bytes())?;
            let file = fs::OpenOptions::new().append(true).open(&path);
            let file = file.map_err(|source| ObserveError::write(&path, source))?;
            files.push((path, file));
        }
        Ok(Self { files, last: None, pending: None })
    }

    fn rows(plan: &Plan, now: &Now<'_>) -> Vec<String> {
        let each = now.conditions.iter().zip(now.slip).zip(plan.system.sliders()).enumerate();
        each.map(|(i, ((c, slip), slider))| {
            let y = plan.system.of(i, now.unknowns);
            let states = y[1..=slider.law.states()].iter().map(|s| format!(",{s:e}"));
            format!(
                "{},{:e},{slip:e},{:e},{},{},{},{:e}{}\n",
                now.at.seconds(),
                now.dt,
                c.rate,
                c.friction,
                c.traction,
                c.normal,
                now.load,
                states.collect::<String>()
            )
        })
        .collect()
    }

    fn write(&mut self, rows: &[String]) -> Result<(), ObserveError> {
        for ((path, file), row) in self.files.iter_mut().zip(rows) {
            // One write per row: a run that is killed leaves whole rows.
            file.write_all(row.as_bytes()).map_err(|source| ObserveError::write(path, source))?;
        }
        Ok(())
    }

    /// Writes the last state, if its row is not there yet.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn finish(&mut self) -> Result<(), ObserveError> {
        match self.pending.take() {
            Some(rows) => self.write(&rows),
            None => Ok(()),
        }
    }
}

impl Watcher for Histories {
    fn now(&mut self, plan: &Plan, now: &Now<'_>) -> Result<(), ObserveError> {
        let rows = Self::rows(plan, now);
        let time = now.at.seconds();
        let logs: Vec<f64> = now.conditions.iter().map(|c| c.log_rate).collect();
        // A slider at rest has no ln V to compare.
        let moved = |(a, b): (&f64, &f64), by: f64| (a - b).abs() >= by || (a - b).is_nan();
        let by = |before: &[f64], by: f64| before.iter().zip(&logs).any(|pair| moved(pair, by));
        let changed = self
            .last
            .as_ref()
            .is_none_or(|(last, before)| time - last >= SHARE * plan.end || by(before, CHANGE));
        // A jump is drawn from where it began.
        let jumped = now.dt == 0.0 || self.last.as_ref().is_some_and(|(_, before)| by(before, 2.0 * CHANGE));
        if jumped && let Some(before) = self.pending.take() {
            self.write(&before)?;
        }
        if changed || jumped {
            self.write(&rows)?;
            (self.last, self.pending) = (Some((time, logs)), None);
        } else {
            self.pending = Some(rows);
        }
        Ok(())
    }
}
