//! Plots of a run, from the files it has written: those of a run that was gone on with are the same as those of one left alone.

use super::plan::Plan;
use super::run::Run;
use crate::observe::ObserveError;
use crate::observe::plots::{self, Cycles, Line};
use std::path::{Path, PathBuf};

/// Draws the plots of the run in `out` into its folder `plots`.
///
/// # Errors
/// When a file cannot be read or written.
pub fn draw(out: &Path, plan: &Plan, run: &Run) -> Result<Vec<PathBuf>, ObserveError> {
    let rows = |name: &str| table(&out.join(name));
    let profiles = |name: &str| -> Result<Vec<(f64, Vec<f64>)>, ObserveError> {
        if plan.in_space {
            return Ok(Vec::new());
        }
        Ok(rows(name)?.into_iter().map(|row| (row[0], row[1..].to_vec())).collect())
    };
    let line = |fault: &super::FaultView| {
        let along: Vec<f64> = plan.points[fault.points.clone()].iter().map(|p| p.along).collect();
        let ascends = along.windows(2).all(|w| w[0] < w[1]) && along.len() > 1;
        ascends.then(|| Line { name: fault.name.clone(), columns: fault.points.clone(), along })
    };
    let events = run.catalogue.events().iter().map(|e| (e.onset.seconds(), e.end.seconds()));
    let under_way = run.catalogue.under_way().map(|at| (at.seconds(), run.at.seconds()));
    let cycles = Cycles {
        title: plan.title.clone(),
        lines: plan.faults.iter().filter_map(line).collect(),
        largest: rows("largest_rate.csv")?.into_iter().map(|row| [row[0], row[1], row[3]]).collect(),
        slip: profiles("slip_profiles.csv")?,
        rate: profiles("rate_profiles.csv")?,
        events: events.chain(under_way).collect(),
        intervals: ["5 a", "1 s"],
    };
    plots::draw_cycles(&out.join("plots"), &cycles)
}

/// The rows of a table of numbers; a row that lacks columns is left out.
pub(super) fn table(path: &Path) -> Result<Vec<Vec<f64>>, ObserveError> {
    let failed = |e: csv::Error| ObserveError::Draw { path: path.to_path_buf(), reason: e.to_string() };
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path).map_err(failed)?;
    let width = reader.headers().map_err(failed)?.len();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(failed)?;
        let row: Vec<f64> = record.iter().map(|v| v.parse().unwrap_or(f64::NAN)).collect();
        if row.len() == width {
            rows.push(row);
        }
    }
    Ok(rows)
}
