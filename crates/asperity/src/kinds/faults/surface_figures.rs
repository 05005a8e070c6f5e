//! Figures of the displacement of the free surface over events, from the tables of a run.

use super::source_time::FOLDER;
use super::surface_tables::name;
use asperity_cycles::{FaultRun, Rupture};
use asperity_output::figures::{Coordinates, Curves, EventOnset, Ground, MapQuantity, Measure, Plot, Points};
use asperity_plan::faults::{FaultView, Plan, SurfaceAxes};
use asperity_run::Event;
use std::collections::BTreeMap;

/// Columns of the tables: x, the first component in the axes of the scene, and that to the east.
const X: usize = 0;
const IN_SCENE: usize = 3;
const ON_EARTH: usize = 9;

/// A map, or in the plane a profile, for each event that has files.
pub(super) fn plots(plan: &Plan, run: &FaultRun) -> Vec<Plot> {
    let Some(surface) = &plan.free_surface else { return Vec::new() };
    let events = run.events().iter().enumerate().take(plan.event_files);
    let edges = || plan.faults.iter().flat_map(|fault| edges(plan, &surface.axes, fault)).collect();
    let map = |event: EventOnset, coordinates, axes, [right, up, out]: [usize; 3]| {
        let (file, table) = (stem(event.number), table(event.number));
        let (shown, arrows) = (MapQuantity::Displacement, Some([right, up]));
        Plot::Ground(Ground {
            file,
            event,
            coordinates,
            axes,
            shown,
            table,
            colours: out,
            arrows,
            edges: edges(),
        })
    };
    let one = |event: EventOnset| match &surface.axes {
        SurfaceAxes::Line(_) => Plot::Curves(profile(plan, event)),
        SurfaceAxes::Scene([z, x]) => {
            let axes = [("z".into(), z.clone()), ("x".into(), x.clone())];
            // Seen from above, with z to the right and x up the page.
            map(event, Coordinates::Metres, axes, [IN_SCENE + 2, IN_SCENE, IN_SCENE + 1])
        }
        SurfaceAxes::Earth([longitude, latitude]) => {
            let axes = [("Longitude".into(), longitude.clone()), ("Latitude".into(), latitude.clone())];
            map(event, Coordinates::Degrees, axes, [ON_EARTH, ON_EARTH + 1, ON_EARTH + 2])
        }
    };
    events.map(|(number, event)| one(event_onset(number, event))).collect()
}

/// An event as figures name it.
pub(super) fn event_onset(number: usize, event: &Event<Rupture>) -> EventOnset {
    EventOnset { number, onset: event.onset.seconds() }
}

fn stem(number: usize) -> String {
    format!("event_{number:03}_surface")
}

fn table(number: usize) -> String {
    format!("{FOLDER}/{}", name(number))
}

/// Displacements along a line: those of each component that moves.
fn profile(plan: &Plan, event: EventOnset) -> Curves {
    let curve = |(axis, name): (usize, &str)| {
        let table = table(event.number);
        (name.to_string(), Points::Table { table, x: X, y: IN_SCENE + axis, size: false })
    };
    Curves {
        file: stem(event.number),
        title: format!("{}, event {}", plan.title, event.number + 1),
        x: ("x".into(), Measure::Length),
        y: ("Displacement of the surface".into(), Measure::Length),
        curves: ["along x", "upward", "along z"].into_iter().enumerate().map(curve).collect(),
        event: Some(event),
        without_zero: true,
        until: None,
        pairs: false,
    }
}

/// Edges of a fault on the map: sides of its faces that belong to a single one.
pub(super) fn edges(plan: &Plan, axes: &SurfaceAxes, fault: &FaultView) -> Vec<[(f64, f64); 2]> {
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
        match (axes, &plan.frame) {
            (SurfaceAxes::Earth(_), Some(frame)) => {
                let spot = frame.spot(&at);
                (spot.longitude, spot.latitude)
            }
            _ => (at[2], at[0]),
        }
    };
    sides.into_iter().filter(|side| side.1 == 1).map(|(side, _)| side.map(seen)).collect()
}
