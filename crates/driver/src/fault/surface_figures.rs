//! Figures of the displacement of the free surface over events, drawn from the tables of a run.

use super::figures::each;
use super::free_surface::{FreeSurface, SurfaceAxes};
use super::plan::{FaultView, Plan};
use super::source_time::FOLDER;
use super::surface_tables::name;
use asperity_cycles::FaultRun;
use asperity_output::OutputError;
use asperity_output::plots::{self, Chart, Coordinates, GroundMap, Measure};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Columns of the tables: x, the first component in the axes of the scene, and that to the east.
const X: usize = 0;
const IN_SCENE: usize = 3;
const ON_EARTH: usize = 9;

/// Draws a map, or in the plane a profile, for each event that has files.
///
/// # Errors
/// If a file cannot be read or written.
pub fn draw(out: &Path, plan: &Plan, run: &FaultRun) -> Result<Vec<PathBuf>, OutputError> {
    let Some(surface) = &plan.free_surface else { return Ok(Vec::new()) };
    let (mut maps, mut charts) = (Vec::new(), Vec::new());
    for number in 0..run.events().len().min(plan.event_files) {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        each(&out.join(FOLDER).join(name(number)), &mut |row| rows.push(row.to_vec()))?;
        match &surface.axes {
            SurfaceAxes::Line(_) => charts.push(profile(plan, number, &rows)),
            SurfaceAxes::Scene([z, x]) => {
                let axes = [("z".into(), z.clone()), ("x".into(), x.clone())];
                // Seen from above, with z to the right and x up the page.
                let parts = [IN_SCENE + 2, IN_SCENE, IN_SCENE + 1];
                maps.push(map(plan, (surface, number), (Coordinates::Metres, axes), (&rows, parts)));
            }
            SurfaceAxes::Earth([longitude, latitude]) => {
                let axes = [("Longitude".into(), longitude.clone()), ("Latitude".into(), latitude.clone())];
                let parts = [ON_EARTH, ON_EARTH + 1, ON_EARTH + 2];
                maps.push(map(plan, (surface, number), (Coordinates::Degrees, axes), (&rows, parts)));
            }
        }
    }
    let folder = out.join("plots");
    let mut drawn = plots::draw_charts(&folder, &charts)?;
    drawn.extend(plots::draw_ground(&folder, &maps)?);
    Ok(drawn)
}

fn stem(number: usize) -> String {
    format!("event_{number:03}_surface")
}

fn title(plan: &Plan, number: usize) -> String {
    format!("{}, event {}", plan.title, number + 1)
}

/// Displacements along a line: those of each component that moves.
fn profile(plan: &Plan, number: usize, rows: &[Vec<f64>]) -> Chart {
    let moves = |axis: &usize| rows.iter().any(|row| row[IN_SCENE + axis].abs() > 0.0);
    let curve = |axis: usize| {
        let points = rows.iter().map(|row| (row[X], row[IN_SCENE + axis])).collect();
        (["along x", "upward", "along z"][axis].to_string(), points)
    };
    Chart {
        file: stem(number),
        title: title(plan, number),
        x: ("x", Measure::Length),
        y: ("Displacement of the surface", Measure::Length),
        curves: (0..3).filter(moves).map(curve).collect(),
    }
}

fn map(
    plan: &Plan,
    (surface, number): (&FreeSurface, usize),
    (coordinates, axes): (Coordinates, [(String, Vec<f64>); 2]),
    (rows, [right, up, out]): (&[Vec<f64>], [usize; 3]),
) -> GroundMap {
    GroundMap {
        file: stem(number),
        title: title(plan, number),
        coordinates,
        axes,
        horizontal: rows.iter().map(|row| [row[right], row[up]]).collect(),
        vertical: rows.iter().map(|row| row[out]).collect(),
        edges: plan.faults.iter().flat_map(|fault| edges(plan, surface, fault)).collect(),
    }
}

/// Edges of a fault on the map: sides of its faces that belong to a single one.
fn edges(plan: &Plan, surface: &FreeSurface, fault: &FaultView) -> Vec<[(f64, f64); 2]> {
    let points = &plan.points[fault.points.clone()];
    let faces: Vec<&[usize]> = match &fault.outline {
        Some(outline) => outline.corners.iter().map(|corners| corners.as_slice()).collect(),
        None => fault.faces.iter().map(|face| face.as_slice()).collect(),
    };
    let mut sides: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for face in faces {
        // A row of single cells has lines between their centres.
        let count = if face.len() == 2 { 1 } else { face.len() };
        for k in 0..count {
            let (a, b) = (face[k], face[(k + 1) % face.len()]);
            *sides.entry([a.min(b), a.max(b)]).or_insert(0) += 1;
        }
    }
    let seen = |node: usize| {
        let at = fault.outline.as_ref().map_or_else(|| points[node].at, |outline| outline.nodes[node]);
        match (&surface.axes, &plan.frame) {
            (SurfaceAxes::Earth(_), Some(frame)) => {
                let spot = frame.spot(&at);
                (spot.longitude, spot.latitude)
            }
            _ => (at[2], at[0]),
        }
    };
    sides.into_iter().filter(|side| side.1 == 1).map(|(side, _)| side.map(seen)).collect()
}
