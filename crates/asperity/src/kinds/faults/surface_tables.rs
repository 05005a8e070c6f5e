//! Displacement of the free surface over each event: tables, and in space grids.

use super::receiver_tables::{columns, values};
use super::source_time::FOLDER;
use asperity_cycles::FaultRun;
use asperity_output::formats::grd::Grid;
use asperity_output::tables::column;
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::{FreeSurface, Plan};
use asperity_plan::shared::place::Frame;
use nalgebra::Vector3;
use std::path::Path;

/// Maps of the free surface.
pub(super) const FILE: OutputFile =
    OutputFile::new("events/surface_*.csv", "displacements of the free surface that each event causes");

/// Name of the table of an event by its number.
pub(super) fn name(number: usize) -> String {
    format!("surface_{number:03}.csv")
}

/// Writes `events/surface_000.csv` and so on for the first events, and in space their grids.
///
/// # Errors
/// If a file cannot be written.
pub(super) fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    let Some(surface) = &plan.free_surface else { return Ok(()) };
    let events = &run.events()[..run.events().len().min(plan.event_files)];
    let slips: Vec<&[f64]> = events.iter().map(|event| event.details.slip.all()).collect();
    let moved = surface.patches.caused(&surface.positions, &slips, &surface.rock);
    for number in 0..events.len() {
        let moved: Vec<[f64; 3]> = moved.iter().map(|at| at[number]).collect();
        let folder = out.join(FOLDER);
        atomic::write(&folder.join(name(number)), table(plan, surface, &moved).as_bytes())?;
        for (component, bytes) in grids(plan, surface, number, &moved) {
            atomic::write(&folder.join(format!("surface_{number:03}_{component}.grd")), &bytes)?;
        }
    }
    Ok(())
}

fn table(plan: &Plan, surface: &FreeSurface, moved: &[[f64; 3]]) -> String {
    let frame = plan.frame.as_ref();
    let mut text = column::header(&columns(frame));
    for (at, moved) in surface.positions.iter().zip(moved) {
        text.push_str(&values(frame, at, *moved).join(","));
        text.push('\n');
    }
    text
}

/// Components of displacements that grids hold, by the ends of their file names, with their meanings.
fn components(frame: Option<&Frame>) -> [(&'static str, String); 3] {
    match frame {
        Some(_) => [
            ("east", "displacement to the east".into()),
            ("north", "displacement to the north".into()),
            ("up", "displacement upwards".into()),
        ],
        None => ["x", "y", "z"].map(|axis| (axis, format!("displacement along {axis} of the scene"))),
    }
}

/// Grids of the components of displacements in space; none in the plane.
fn grids(
    plan: &Plan,
    surface: &FreeSurface,
    number: usize,
    moved: &[[f64; 3]],
) -> Vec<(&'static str, Vec<u8>)> {
    let Some([x, y]) = surface.axes.in_grids() else { return Vec::new() };
    let frame = plan.frame.as_ref();
    let turned: Vec<[f64; 3]> = match frame {
        Some(frame) => moved.iter().map(|u| (frame.axes * Vector3::from(*u)).into()).collect(),
        None => moved.to_vec(),
    };
    let title = format!("{}, event {}", plan.title, number + 1);
    let one = |(component, (end, meaning)): (usize, &(&'static str, String))| {
        let values: Vec<f64> = turned.iter().map(|u| u[component]).collect();
        let grid = Grid { title: &title, x, y, meaning, unit: "m", values: &values };
        (*end, grid.bytes())
    };
    components(frame).iter().enumerate().map(one).collect()
}
