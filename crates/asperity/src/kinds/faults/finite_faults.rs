//! Finite-fault models of events in FSP format, and the slip of plane faults as grids.

use super::fields::reached;
use super::source_time::FOLDER;
use crate::catalogue::{Entry, slipped};
use asperity_cycles::{FaultRun, Rupture};
use asperity_output::formats::catalogues::{Row, Segment, SourceModel};
use asperity_output::formats::grd::{Axis, Grid};
use asperity_output::{OutputError, atomic, stems};
use asperity_plan::faults::{CellGrid, FaultView, Plan};
use asperity_plan::shared::place::Frame;
use asperity_run::Event;
use nalgebra::Vector3;
use std::path::Path;

/// Share of the range of depths of a fault of triangles within which its nodes form its upper edge.
const UPPER_EDGE: f64 = 0.01;

/// Writes, for the first events, `events/slip_000_FAULT.grd` of each plane rectangular fault and, where the scene in space has a place
/// on Earth, `events/finite_fault_000.fsp`. `entries` are the events in the catalogue.
///
/// # Errors
/// If a file cannot be written.
pub fn write(out: &Path, plan: &Plan, run: &FaultRun, entries: &[Entry]) -> Result<(), OutputError> {
    if !plan.in_space {
        return Ok(());
    }
    let folder = out.join(FOLDER);
    let names = stems(plan.faults.iter().map(|fault| fault.name.as_str()));
    for (number, (event, entry)) in run.events().iter().zip(entries).enumerate().take(plan.event_files) {
        let title = format!("{}, event {}", plan.title, number + 1);
        for (name, fault) in names.iter().zip(&plan.faults) {
            if let Some(bytes) = slip_grid(&title, fault, event) {
                atomic::write(&folder.join(format!("slip_{number:03}_{name}.grd")), &bytes)?;
            }
        }
        let model = plan.frame.as_ref().and_then(|frame| model((plan, frame), number + 1, event, entry));
        if let Some(model) = model {
            let path = folder.join(format!("finite_fault_{number:03}.fsp"));
            atomic::write(&path, model.text().as_bytes())?;
        }
    }
    Ok(())
}

/// Slip of a fault over its distances along strike and down dip, if it is divided into equal rectangles.
fn slip_grid(title: &str, fault: &FaultView, event: &Event<Rupture>) -> Option<Vec<u8>> {
    let grid = fault.grid.as_ref().filter(|grid| grid.columns > 1 && grid.rows > 1)?;
    let slip = &event.details.slip;
    let along = |p: usize| if slip.components() == 1 { slip.all()[p] } else { slip.size(p) };
    let values: Vec<f64> = fault.points.clone().map(along).collect();
    let centres = |count: usize, size: f64| (0..count).map(|k| (k as f64 + 0.5) * size).collect::<Vec<f64>>();
    let [x, y] = [centres(grid.columns, grid.cell[0]), centres(grid.rows, grid.cell[1])];
    let grid = Grid {
        title,
        x: Axis { name: "x", meaning: "distance along strike from the first end", unit: "m", values: &x },
        y: Axis { name: "y", meaning: "distance down dip from the upper edge", unit: "m", values: &y },
        meaning: "slip",
        unit: "m",
        values: &values,
    };
    Some(grid.bytes())
}

/// Unit vectors of a plane in east, north and up: normal of the hanging wall, along strike and up dip.
#[derive(Clone, Copy)]
struct Plane {
    normal: Vector3<f64>,
    strike: Vector3<f64>,
    up_dip: Vector3<f64>,
}

impl Plane {
    fn from_normal(normal: Vector3<f64>) -> Self {
        let strike = Vector3::z().cross(&normal).try_normalize(f64::EPSILON).unwrap_or_else(Vector3::y);
        Self { normal, strike, up_dip: normal.cross(&strike) }
    }

    /// Strike and dip \[degrees\].
    fn angles(&self) -> [f64; 2] {
        let strike = self.strike.x.atan2(self.strike.y).to_degrees().rem_euclid(360.0);
        [strike, self.normal.z.clamp(-1.0, 1.0).acos().to_degrees()]
    }
}

/// Mean plane of a fault, whose normal points up.
fn mean_plane((plan, frame): (&Plan, &Frame), fault: &FaultView) -> Plane {
    let points = &plan.points[fault.points.clone()];
    let sum: Vector3<f64> = points.iter().map(|p| frame.axes * Vector3::from(p.normal) * p.area).sum();
    let normal = sum.try_normalize(f64::EPSILON).unwrap_or_else(Vector3::z);
    Plane::from_normal(if normal.z < -f64::EPSILON { -normal } else { normal })
}

/// Slip of the hanging wall along strike and up dip at a point, on its own plane \[m\].
fn slip_at((plan, frame): (&Plan, &Frame), event: &Event<Rupture>, mean: &Plane, point: usize) -> [f64; 2] {
    let normal = frame.axes * Vector3::from(plan.points[point].normal);
    let slip = frame.axes * Vector3::from(plan.vector(&event.details.slip, point));
    let side = if normal.dot(&mean.normal) < 0.0 { -1.0 } else { 1.0 };
    let plane = Plane::from_normal(side * normal);
    [side * slip.dot(&plane.strike), side * slip.dot(&plane.up_dip)]
}

/// Model of an event; `None` if it is not in the calendar.
fn model<'a>(
    (plan, frame): (&'a Plan, &Frame),
    number: usize,
    event: &Event<Rupture>,
    entry: &Entry,
) -> Option<SourceModel<'a>> {
    let located = entry.located.as_ref()?;
    let own = slipped(event, &(0..plan.points.len()));
    let takes_part = |fault: &&FaultView| own.iter().any(|p| fault.points.contains(p));
    let hypocentre = event.details.hypocentre;
    let (mut segments, mut plane, mut sum) = (Vec::new(), [f64::NAN; 2], [0.0; 2]);
    for fault in plan.faults.iter().filter(takes_part) {
        let mean = mean_plane((plan, frame), fault);
        if fault.points.contains(&hypocentre) {
            plane = mean.angles();
        }
        for p in fault.points.clone() {
            let weight = plan.points[p].shear_modulus * plan.points[p].area;
            let slip = slip_at((plan, frame), event, &mean, p);
            sum = std::array::from_fn(|c| sum[c] + weight * slip[c]);
        }
        segments.push(segment((plan, frame), event, fault, &mean));
    }
    Some(SourceModel {
        title: &plan.title,
        number,
        onset: located.onset,
        hypocentre: located.hypocentre,
        moment: entry.moment,
        magnitude: entry.magnitude?,
        mechanism: [plane[0], plane[1], sum[1].atan2(sum[0]).to_degrees()],
        segments,
    })
}

/// Part of a model on a fault.
fn segment<'a>(
    (plan, frame): (&Plan, &Frame),
    event: &Event<Rupture>,
    fault: &'a FaultView,
    mean: &Plane,
) -> Segment<'a> {
    let place = |at: &[f64; 3]| frame.axes * Vector3::from(*at);
    let start = place(&plan.points[event.details.hypocentre].at);
    let ([length, width], top) = extent((plan, frame), fault, mean);
    let from_top = start - place(&top);
    let row = |p: usize| {
        let point = &plan.points[p];
        let slip = slip_at((plan, frame), event, mean, p);
        let at = fault.grid.as_ref().map_or(point.at, |grid| grid.top_of(&point.at));
        let apart = place(&at) - start;
        Row {
            at: frame.spot(&at),
            from_epicentre: [apart.x, apart.y],
            slip: slip[0].hypot(slip[1]),
            rake: slip[1].atan2(slip[0]).to_degrees(),
            ruptured: reached(event, p),
            moment: point.shear_modulus * point.area * event.details.slip.size(p),
        }
    };
    let within = fault.points.contains(&event.details.hypocentre);
    Segment {
        name: &fault.name,
        plane: mean.angles(),
        size: [length, width],
        cells: fault.grid.as_ref().map(|grid| ([grid.columns, grid.rows], grid.cell)),
        top: frame.spot(&top),
        hypocentre: within.then(|| [from_top.dot(&mean.strike) + 0.5 * length, -from_top.dot(&mean.up_dip)]),
        rows: fault.points.clone().map(row).collect(),
    }
}

/// Length and width of a fault \[m\], and the middle of its upper edge in the axes of the scene.
fn extent((plan, frame): (&Plan, &Frame), fault: &FaultView, mean: &Plane) -> ([f64; 2], [f64; 3]) {
    if let Some(CellGrid { columns, rows, cell, from, along, .. }) = &fault.grid {
        let [length, width] = [*columns as f64 * cell[0], *rows as f64 * cell[1]];
        return ([length, width], std::array::from_fn(|c| from[c] + 0.5 * length * along[c]));
    }
    let points = &plan.points[fault.points.clone()];
    let nodes: Vec<[f64; 3]> = match &fault.outline {
        Some(outline) => outline.nodes.clone(),
        None => points.iter().map(|p| p.at).collect(),
    };
    let places: Vec<Vector3<f64>> = nodes.iter().map(|at| frame.axes * Vector3::from(*at)).collect();
    let range = |of: &dyn Fn(&Vector3<f64>) -> f64| {
        let all = || places.iter().map(of);
        (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max))
    };
    let (first, last) = range(&|at| at.dot(&mean.strike));
    let (low, high) = range(&|at| at.z);
    let length = last - first;
    let area: f64 = points.iter().map(|p| p.area).sum();
    let edge = places.iter().zip(&nodes).filter(|(at, _)| high - at.z <= UPPER_EDGE * (high - low));
    let edge: Vec<&[f64; 3]> = edge.map(|pair| pair.1).collect();
    let top = std::array::from_fn(|c| edge.iter().map(|at| at[c]).sum::<f64>() / edge.len() as f64);
    ([length, area / length], top)
}
