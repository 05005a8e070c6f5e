//! Figures of the change of Coulomb stress over events, from the tables of a run.

use super::coulomb_tables::{column, name};
use super::source_time::FOLDER;
use super::surface_figures::{edges, event_onset};
use asperity_cycles::FaultRun;
use asperity_output::decimals::shortest;
use asperity_output::figures::{Coordinates, Curves, EventOnset, Ground, MapQuantity, Measure, Plot, Points};
use asperity_plan::faults::{CoulombMap, Plan, SurfaceAxes};

/// Column of x.
const X: usize = 0;

/// A map, or in the plane a profile, for each event that has files.
pub(super) fn plots(plan: &Plan, run: &FaultRun) -> Vec<Plot> {
    let Some(map) = plan.coulomb.as_ref().and_then(|c| c.map.as_ref()) else { return Vec::new() };
    let events = run.events().iter().enumerate().take(plan.event_files);
    let one = |event: EventOnset| match &map.axes {
        SurfaceAxes::Line(_) => Plot::Curves(profile(plan, event)),
        SurfaceAxes::Scene([z, x]) => {
            let axes = [("z".into(), z.clone()), ("x".into(), x.clone())];
            Plot::Ground(drawn(plan, (map, event), Coordinates::Metres, axes))
        }
        SurfaceAxes::Earth([longitude, latitude]) => {
            let axes = [("Longitude".into(), longitude.clone()), ("Latitude".into(), latitude.clone())];
            Plot::Ground(drawn(plan, (map, event), Coordinates::Degrees, axes))
        }
    };
    events.map(|(number, event)| one(event_onset(number, event))).collect()
}

fn stem(number: usize) -> String {
    format!("event_{number:03}_coulomb")
}

fn table(number: usize) -> String {
    format!("{FOLDER}/{}", name(number))
}

fn profile(plan: &Plan, event: EventOnset) -> Curves {
    let change = Points::Table { table: table(event.number), x: X, y: column(plan), size: false };
    Curves {
        file: stem(event.number),
        title: format!("{}, event {}", plan.title, event.number + 1),
        x: ("x".into(), Measure::Length),
        y: ("Change of Coulomb stress".into(), Measure::Stress),
        curves: vec![("Coulomb stress".into(), change)],
        event: Some(event),
        without_zero: false,
        until: None,
        pairs: false,
    }
}

fn drawn(
    plan: &Plan,
    (map, event): (&CoulombMap, EventOnset),
    coordinates: Coordinates,
    axes: [(String, Vec<f64>); 2],
) -> Ground {
    Ground {
        file: stem(event.number),
        event,
        coordinates,
        axes,
        shown: MapQuantity::CoulombStress { depth: format!("{} km", shortest(map.depth / 1e3)) },
        table: table(event.number),
        colours: column(plan),
        arrows: None,
        edges: plan.faults.iter().flat_map(|fault| edges(plan, &map.axes, fault)).collect(),
    }
}
