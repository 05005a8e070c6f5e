//! Tables of the points of events: rupture times, largest slip rates, slip and stress drop.

use super::fields::{reached, scalars, turned};
use asperity_cycles::{FaultRun, Rupture};
use asperity_output::decimals::{scientific, shortest};
use asperity_output::tables::column::{self, Column, Sign};
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::{FaultView, Plan};
use asperity_run::Event;
use std::path::Path;

/// The tables of events.
pub(super) const FILE: OutputFile =
    OutputFile::new("events/rupture_times_*.csv", "rupture times, slip and stress drop of each event");

/// Columns of the tables, with the angle of slip where it may turn.
pub(super) fn columns(turns: bool) -> Vec<Column> {
    let turned = Column::new("turned", "deg", Sign::None, "angle from the rake to the slip");
    [Column::new("fault", "", Sign::None, "fault of the point")]
        .into_iter()
        .chain(column::position())
        .chain([
            Column::new(
                "time since onset",
                "s",
                Sign::None,
                "time at which the point ruptured; NaN without rupture",
            ),
            Column::new("largest slip_rate", "m/s", Sign::Size, "largest slip rate in the event"),
            Column::new("slip", "m", Sign::Slip, "slip in the event"),
            Column::new("stress_drop", "Pa", Sign::Slip, "fall of the shear traction in the event"),
        ])
        .chain(turns.then_some(turned))
        .collect()
}

/// Writes `events/rupture_times_000.csv` and so on for the first events, with a row for each point.
///
/// # Errors
/// If a file cannot be written.
pub(super) fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    for (number, event) in run.events().iter().enumerate().take(plan.event_files) {
        let path = out.join(FILE.named(&format!("{number:03}")));
        atomic::write(&path, table(plan, event).as_bytes())?;
    }
    Ok(())
}

fn table(plan: &Plan, event: &Event<Rupture>) -> String {
    let turns = event.details.slip.components() > 1;
    let mut text = column::header(&columns(turns));
    for fault in &plan.faults {
        rows(plan, fault, event, &mut text);
    }
    text
}

/// Rows of the points of a fault.
fn rows(plan: &Plan, fault: &FaultView, event: &Event<Rupture>, text: &mut String) {
    let slips = scalars(fault, &event.details.slip);
    let drops = scalars(fault, &event.details.drop);
    for ((point, slip), drop) in fault.points.clone().zip(slips).zip(drops) {
        let [x, y, z] = plan.points[point].at.map(shortest);
        let peak = event.details.front.peaks.get(point).copied().unwrap_or(f64::NAN);
        let values = [reached(event, point), peak, slip, drop].map(|v| scientific(v, 9)).join(",");
        text.push_str(&format!("{},{x},{y},{z},{values}", fault.name));
        if let Some(turned) = turned(event, point) {
            text.push_str(&format!(",{}", scientific(turned, 6)));
        }
        text.push('\n');
    }
}
