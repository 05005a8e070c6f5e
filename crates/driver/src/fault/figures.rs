//! Plots of a run, drawn from its output files, so that a resumed run has the same plots as an uninterrupted one. Tables are read row by row, as
//! often as a plot needs them, and are never held in memory as a whole.

use super::cadence::time;
use super::event_tables::reached;
use super::plan::{FaultView, Plan};
use super::shape::{at_corners, corners, shape};
use super::source_time;
use crate::catalogue::slipped;
use asperity_cycles::FaultRun;
use asperity_output::plots::{self, Chart, Cycles, EventOnFault, Line, Measure, Rows, RupturedFault, Table};
use asperity_output::{OutputError, stems};
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
    let mut charts = moment_rates(out, plan, run)?;
    charts.extend(springs(out, plan)?);
    drawn.extend(plots::draw_charts(&folder, &charts)?);
    drawn.extend(plots::draw_events(&folder, &on_faults(plan, run))?);
    Ok(drawn)
}

/// Share of the largest moment rate below which the end of a curve is left out: afterslip lasts far longer than the rupture.
const TAIL: f64 = 0.01;

/// Cuts a curve of moment rates where it has fallen for good.
fn without_tail(curve: &mut Vec<(f64, f64)>) {
    let most = curve.iter().map(|p| p.1).fold(0.0, f64::max);
    if let Some(last) = curve.iter().rposition(|p| p.1 >= TAIL * most) {
        curve.truncate(last + 2);
    }
}

/// Moment rate of each event that has a file.
fn moment_rates(out: &Path, plan: &Plan, run: &FaultRun) -> Result<Vec<Chart>, OutputError> {
    let measure = if plan.in_space { Measure::MomentRate } else { Measure::MomentRatePerLength };
    let one = |number: usize| {
        let mut curve = Vec::new();
        let file = out.join(source_time::FOLDER).join(source_time::name(number));
        each(&file, &mut |row| curve.push((row[0], row[1])))?;
        without_tail(&mut curve);
        Ok(Chart {
            file: format!("event_{number:03}_moment_rate"),
            title: format!("{}, event {}", plan.title, number + 1),
            x: ("Time since onset", Measure::Time),
            y: ("Moment rate", measure),
            curves: vec![("all faults".into(), curve)],
        })
    };
    (0..run.events().len().min(plan.event_files)).map(one).collect()
}

/// Faults in the events that have files.
fn on_faults(plan: &Plan, run: &FaultRun) -> Vec<EventOnFault> {
    let names = stems(plan.faults.iter().map(|f| f.name.as_str()));
    let mut all = Vec::new();
    for (number, event) in run.events().iter().enumerate().take(plan.event_files) {
        let largest = slipped(event, &(0..plan.points.len()));
        for (name, fault) in names.iter().zip(&plan.faults) {
            // A fault that takes no part in the event has no figures.
            if !largest.iter().any(|p| fault.points.contains(p)) {
                continue;
            }
            let points = || fault.points.clone();
            let times: Vec<f64> = points().map(|p| reached(event, p)).collect();
            let slips: Vec<f64> = points().map(|p| event.details.slip.size(p)).collect();
            let views = &plan.points[points()];
            let (shape, arrivals, slip) = match &fault.outline {
                Some(outline) => {
                    (corners(outline, views), at_corners(outline, &times), at_corners(outline, &slips))
                }
                None => (shape(plan.in_space, fault, views), times, slips),
            };
            all.push(EventOnFault {
                stem: format!("{name}_event_{number:03}"),
                title: format!("{}, event {}", plan.title, number + 1),
                fault: RupturedFault { name: fault.name.clone(), points: points(), shape, arrivals },
                slip,
            });
        }
    }
    all
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
