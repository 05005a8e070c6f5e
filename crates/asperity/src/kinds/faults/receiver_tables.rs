//! Tables of the displacements of receivers over each event.

use asperity_cycles::{FaultRun, Rupture};
use asperity_output::decimals::{scientific, shortest};
use asperity_output::tables::column::{self, Column, Sign};
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::Plan;
use asperity_plan::shared::place::Frame;
use asperity_run::Event;
use nalgebra::Vector3;
use std::path::Path;

/// Displacements of receivers.
pub(super) const FILE: OutputFile =
    OutputFile::new("events/displacements_*.csv", "displacements of receivers that each event causes");

/// Writes `events/displacements_000.csv` and so on for the first events: displacements of all receivers that slip in the event
/// causes.
///
/// # Errors
/// If a file cannot be written.
pub(super) fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    if plan.receivers.all.is_empty() {
        return Ok(());
    }
    for (number, event) in run.events().iter().enumerate().take(plan.event_files) {
        let path = out.join(FILE.named(&format!("{number:03}")));
        atomic::write(&path, table(plan, event).as_bytes())?;
    }
    Ok(())
}

/// Columns of a position and its displacement, in a scene with or without a place on Earth.
pub(super) fn columns(frame: Option<&Frame>) -> Vec<Column> {
    let moved = column::axes("displacement", "m", Sign::Axis, "displacement that slip of the event causes");
    let mut all: Vec<Column> = column::position().into_iter().chain(moved).collect();
    if frame.is_some() {
        all.extend(on_earth());
        let part = |name| Column::new(name, "m", Sign::None, "displacement in this direction");
        all.extend(["east", "north", "up"].map(part));
    }
    all
}

/// Columns of a position on Earth.
pub(super) fn on_earth() -> [Column; 3] {
    [
        Column::new("longitude", "deg", Sign::None, "longitude of the position"),
        Column::new("latitude", "deg", Sign::None, "latitude of the position"),
        Column::new("depth", "m", Sign::None, "depth of the position"),
    ]
}

/// Columns of the tables of named receivers.
pub(super) fn named(frame: Option<&Frame>) -> Vec<Column> {
    [Column::new("name", "", Sign::None, "name of the receiver")].into_iter().chain(columns(frame)).collect()
}

/// Values of the columns of a position and its displacement.
pub(super) fn values(frame: Option<&Frame>, at: &[f64; 3], moved: [f64; 3]) -> Vec<String> {
    let mut row: Vec<String> = at.map(shortest).into();
    row.extend(moved.map(|u| scientific(u, 9)));
    if let Some(frame) = frame {
        let spot = frame.spot(at);
        row.extend([spot.longitude, spot.latitude, spot.depth].map(shortest));
        let east_north_up: [f64; 3] = (frame.axes * Vector3::from(moved)).into();
        row.extend(east_north_up.map(|u| scientific(u, 9)));
    }
    row
}

fn table(plan: &Plan, event: &Event<Rupture>) -> String {
    let frame = plan.frame.as_ref();
    let mut text = column::header(&named(frame));
    for receiver in &plan.receivers.all {
        let moved = receiver.caused(event.details.slip.all().iter().copied());
        let row = values(frame, &receiver.at, moved).join(",");
        text.push_str(&format!("{},{row}\n", receiver.name));
    }
    text
}
