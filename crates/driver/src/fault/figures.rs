//! Plots of a run, drawn from its output files, so that a resumed run has the same plots as an uninterrupted one. Tables are read row by row, as
//! often as a plot needs them, and are never held in memory as a whole.

use super::cadence::time;
use super::plan::{FaultView, Plan};
use asperity_cycles::FaultRun;
use asperity_output::OutputError;
use asperity_output::plots::{self, Chart, Cycles, Line, Rows, Table};
use std::path::{Path, PathBuf};

/// Draws the plots of the run in `out` into its folder `plots`.
///
/// # Errors
/// If a file cannot be read or written.
pub fn draw(out: &Path, plan: &Plan, run: &FaultRun) -> Result<Vec<PathBuf>, OutputError> {
    let line = |fault: &FaultView| {
        let along: Vec<f64> = plan.points[fault.points.clone()].iter().map(|p| p.along).collect();
        let ascends = along.windows(2).all(|w| w[0] < w[1]) && along.len() > 1;
        ascends.then(|| Line { name: fault.name.clone(), columns: fault.points.clone(), along })
    };
    let events = run.events().iter().filter_map(|e| Some((e.onset.seconds(), e.end?.seconds())));
    let under_way = run.under_way().map(|e| (e.onset.seconds(), run.at.seconds()));
    let written = Written { out, in_space: plan.in_space };
    let cycles = Cycles {
        title: plan.title.clone(),
        lines: plan.faults.iter().filter_map(line).collect(),
        rows: &written,
        events: events.chain(under_way).collect(),
        intervals: plan.cadence.contours.map(time),
    };
    let folder = out.join("plots");
    let mut drawn = plots::draw_cycles(&folder, &cycles)?;
    if let Some(chart) = springs(out, plan)? {
        drawn.extend(plots::draw_charts(&folder, &[chart])?);
    }
    Ok(drawn)
}

/// Macroscopic friction against the way of each load point, from the tables of springs.
fn springs(out: &Path, plan: &Plan) -> Result<Option<Chart>, OutputError> {
    let Some(sampling) = plan.sampling.as_ref().filter(|s| !s.sampled.springs.is_empty()) else {
        return Ok(None);
    };
    let heads = sampling.sampled.heads();
    let first = heads.len() - sampling.sampled.springs.len();
    let mut curves = Vec::new();
    for (spring, (path, _)) in sampling.sampled.springs.iter().zip(&heads[first..]) {
        let mut curve = Vec::new();
        // Time, load point, displacement, force and friction.
        each(&out.join(path), &mut |row| curve.push((row[1].abs(), row[4])))?;
        curves.push((spring.name(), curve));
    }
    Ok(Some(plots::springs_chart(&plan.title, curves)))
}

/// Tables of a run.
struct Written<'a> {
    out: &'a Path,
    in_space: bool,
}

impl Rows for Written<'_> {
    fn each(&self, table: Table, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
        let name = match table {
            Table::Largest => "largest_rate.csv",
            Table::Slip => "slip_profiles.csv",
            Table::Rate => "rate_profiles.csv",
        };
        if self.in_space && table != Table::Largest {
            return Ok(());
        }
        each(&self.out.join(name), look)
    }
}

/// Passes the rows of a table of numbers to `look` one by one; incomplete rows are skipped.
pub(crate) fn each(path: &Path, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
    let failed = |e: csv::Error| OutputError::Draw { path: path.to_path_buf(), reason: e.to_string() };
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path).map_err(failed)?;
    let width = reader.headers().map_err(failed)?.len();
    let (mut record, mut row) = (csv::StringRecord::new(), Vec::with_capacity(width));
    while reader.read_record(&mut record).map_err(failed)? {
        row.clear();
        row.extend(record.iter().map(|v| v.parse().unwrap_or(f64::NAN)));
        if row.len() == width {
            look(&row);
        }
    }
    Ok(())
}
