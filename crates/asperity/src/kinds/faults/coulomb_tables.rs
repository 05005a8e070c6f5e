//! Changes of Coulomb stress over each event in homogeneous rock: tables, and in space grids.

use super::receiver_tables::on_earth;
use super::source_time::FOLDER;
use asperity_cycles::FaultRun;
use asperity_cycles::medium::patches::Patches;
use asperity_cycles::operator::Geometry;
use asperity_output::decimals::{scientific, shortest};
use asperity_output::formats::grd::Grid;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::{Change, Coulomb, CoulombMap, Plan};
use asperity_plan::shared::place::Frame;
use std::path::Path;

/// Changes of Coulomb stress on a map.
pub(super) const MAP: OutputFile =
    OutputFile::new("events/coulomb_*.csv", "map of the stress that each event causes");
/// Changes at single positions.
pub(super) const POINTS: OutputFile =
    OutputFile::new("events/coulomb_points_*.csv", "stress at positions that each event causes");
/// Changes on faults.
pub(super) const FAULTS: OutputFile = OutputFile::new(
    "events/coulomb_faults_*.csv",
    "changes of Coulomb stress on faults that each event causes",
);

/// Columns of a position, with the name that heads them if there is one, and of what is there.
fn columns(frame: Option<&Frame>, name: Option<Column>, with_stress: bool) -> Vec<Column> {
    let mut all: Vec<Column> = name.into_iter().chain(column::position()).collect();
    if frame.is_some() {
        all.extend(on_earth());
    }
    if with_stress {
        all.extend(column::stress());
    }
    all.extend([
        Column::new("shear_change", "Pa", Sign::Driving, "change of the shear traction along the rake"),
        Column::new("normal_change", "Pa", Sign::Compression, "change of the normal traction"),
        Column::new("coulomb_change", "Pa", Sign::Driving, "change of Coulomb stress"),
    ]);
    all
}

/// Columns of maps.
pub(super) fn map_columns(frame: Option<&Frame>) -> Vec<Column> {
    columns(frame, None, true)
}

/// Columns of named positions.
pub(super) fn point_columns(frame: Option<&Frame>) -> Vec<Column> {
    columns(frame, Some(Column::new("name", "", Sign::None, "name of the position")), true)
}

/// Columns of cells of faults.
pub(super) fn fault_columns(frame: Option<&Frame>) -> Vec<Column> {
    columns(frame, Some(Column::new("fault", "", Sign::None, "fault of the cell")), false)
}

/// Name of the table of the map of an event by its number.
pub(super) fn name(number: usize) -> String {
    format!("coulomb_{number:03}.csv")
}

/// Number of the column of the change in the tables of maps, which is the last.
pub(super) fn column(plan: &Plan) -> usize {
    map_columns(plan.frame.as_ref()).len() - 1
}

/// Writes `events/coulomb_000.csv` and so on for the first events, in space also their grids,
/// `events/coulomb_points_000.csv`, and with several faults `events/coulomb_faults_000.csv`.
///
/// # Errors
/// If a file cannot be written.
pub(super) fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    let Some(coulomb) = &plan.coulomb else { return Ok(()) };
    let events = &run.events()[..run.events().len().min(plan.event_files)];
    let slips: Vec<&[f64]> = events.iter().map(|event| event.details.slip.all()).collect();
    if let Some(map) = &coulomb.map {
        write_map(&out.join(FOLDER), plan, (coulomb, map), &slips)?;
    }
    if !coulomb.points.is_empty() {
        write_points(out, plan, coulomb, &slips)?;
    }
    if coulomb.on_faults {
        write_faults(out, plan, coulomb, &slips)?;
    }
    Ok(())
}

fn write_map(
    folder: &Path,
    plan: &Plan,
    (coulomb, map): (&Coulomb, &CoulombMap),
    slips: &[&[f64]],
) -> Result<(), OutputError> {
    let frame = plan.frame.as_ref();
    let found = coulomb.at(&map.positions, slips);
    for number in 0..slips.len() {
        let mut text = column::header(&map_columns(frame));
        for (at, all) in map.positions.iter().zip(&found) {
            let (stress, change) = &all[number];
            text.push_str(&format!("{}{}{}\n", place(frame, at), numbers(stress), changed(change)));
        }
        atomic::write(&folder.join(name(number)), text.as_bytes())?;
        if let Some([x, y]) = map.axes.in_grids() {
            let values: Vec<f64> = found.iter().map(|all| all[number].1.coulomb).collect();
            let title = format!("{}, event {}", plan.title, number + 1);
            let meaning = "change of Coulomb stress";
            let grid = Grid { title: &title, x, y, meaning, unit: "Pa", values: &values };
            atomic::write(&folder.join(format!("coulomb_{number:03}.grd")), &grid.bytes())?;
        }
    }
    Ok(())
}

fn write_points(out: &Path, plan: &Plan, coulomb: &Coulomb, slips: &[&[f64]]) -> Result<(), OutputError> {
    let frame = plan.frame.as_ref();
    let positions: Vec<[f64; 3]> = coulomb.points.iter().map(|p| p.1).collect();
    let found = coulomb.at(&positions, slips);
    for number in 0..slips.len() {
        let mut text = column::header(&point_columns(frame));
        for ((name, at), all) in coulomb.points.iter().zip(&found) {
            let (stress, change) = &all[number];
            let row = format!("{}{}{}", place(frame, at), numbers(stress), changed(change));
            text.push_str(&format!("{name},{row}\n"));
        }
        atomic::write(&out.join(POINTS.named(&format!("{number:03}"))), text.as_bytes())?;
    }
    Ok(())
}

fn write_faults(out: &Path, plan: &Plan, coulomb: &Coulomb, slips: &[&[f64]]) -> Result<(), OutputError> {
    if slips.is_empty() {
        return Ok(());
    }
    let frame = plan.frame.as_ref();
    let places: Vec<[f64; 3]> = plan.points.iter().map(|p| p.at).collect();
    let areas: Vec<f64> = plan.points.iter().map(|p| p.area).collect();
    let faults: Vec<_> = plan.faults.iter().map(|f| f.points.clone()).collect();
    let surfaces = matches!(coulomb.patches, Patches::Space { .. });
    let geometry = Geometry { places: &places, faults: &faults, areas: &areas, surfaces };
    let found = coulomb.on_cells(slips, &geometry);
    for (number, changes) in found.iter().enumerate() {
        let mut text = column::header(&fault_columns(frame));
        for fault in &plan.faults {
            for point in fault.points.clone() {
                let row = format!("{}{}", place(frame, &places[point]), changed(&changes[point]));
                text.push_str(&format!("{},{row}\n", fault.name));
            }
        }
        atomic::write(&out.join(FAULTS.named(&format!("{number:03}"))), text.as_bytes())?;
    }
    Ok(())
}

fn place(frame: Option<&Frame>, at: &[f64; 3]) -> String {
    let mut row: Vec<String> = at.map(shortest).into();
    if let Some(spot) = frame.map(|frame| frame.spot(at)) {
        row.extend([spot.longitude, spot.latitude, spot.depth].map(shortest));
    }
    row.join(",")
}

fn changed(change: &Change) -> String {
    numbers(&[change.shear, change.normal, change.coulomb])
}

/// Numbers with a comma before each.
fn numbers(values: &[f64]) -> String {
    values.iter().map(|v| format!(",{}", scientific(*v, 9))).collect()
}
