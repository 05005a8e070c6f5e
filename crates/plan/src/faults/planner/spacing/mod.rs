//! Check that faults keep a distance from each other and from themselves: cells neither cross nor lie closer than a share of their size.
//!
//! Distances are those of segments, triangles and rectangles. Faults may meet end to end, or edge to edge, at a right angle or more. What crosses
//! or branches is refused, also at corners that cells have in common.

pub(super) mod cell;
pub mod distance;
pub(super) mod faces;

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Scene};
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use asperity_scene::lengths::brief;
use cell::Cell;
use distance::{Nearest, Position, nearest};
use std::f64::consts::PI;

/// Distance of two cells of different faults, relative to the width of either, below which slip that is uniform over cells does not resolve the
/// stress between them.
const CLOSEST: f64 = 0.9;
/// The same for two cells of one fault, and for the distance over the way from one to the other along the faults: at a bend of 29 degrees between
/// its parts, a third of a right angle, the distance is a quarter of that way. Sharper than that no fault can be.
const FOLDED: f64 = 0.25;
/// Angle between the parts of such a bend: 2 arcsin(1/4).
const SHARPEST: f64 = 29.0 / 180.0 * PI;

/// Least distances of cells.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Spacing {
    /// Slip is uniform over cells in homogeneous rock.
    ByCells,
    /// The mesh of bodies resolves what lies between faults; they do not cross.
    Apart,
}

/// Faults of the geometry of two cells.
enum Fault {
    Touches,
    Near(f64),
    Folds(f64),
}

/// Refuses faults that cross, branch, or lie closer to each other or to themselves than their cells are wide.
///
/// # Errors
/// [`Diagnostic`] at the second of two faults, or at the fault.
pub(super) fn check(scene: &Scene, cells: &[Cell], spaced: Spacing) -> Result<(), Diagnostic> {
    let faults: Vec<(&String, &Spec)> = scene.faults.iter().collect();
    let refuse = |[a, b]: [usize; 2], why: Fault| {
        let [a, b] = if cells[a].fault <= cells[b].fault { [a, b] } else { [b, a] };
        refused([faults[cells[a].fault], faults[cells[b].fault]], [&cells[a], &cells[b]], &why)
    };
    let (mut joints, mut doubtful) = (Vec::new(), Vec::new());
    for pair in candidates(cells) {
        let [a, b] = pair.map(|k| &cells[k]);
        if spaced == Spacing::ByCells && a.fault == b.fault {
            match within(a, b) {
                None => continue,
                Some(why) => return Err(refuse(pair, why)),
            }
        }
        match between(a, b, spaced) {
            Meeting::Clear => {}
            Meeting::Joint(at) => joints.push(([a.fault, b.fault], at)),
            Meeting::Near(near) => doubtful.push((pair, near)),
            Meeting::Touches => return Err(refuse(pair, Fault::Touches)),
        }
    }
    let joined = |pair: [usize; 2], near: &Nearest| {
        let [one, two] = pair.map(|k| cells[k].fault);
        let around = joints.iter().filter(|(f, _)| *f == [one, two] || *f == [two, one]);
        let way = around.map(|(_, at)| near.iter().map(|x| (x - at).norm()).sum::<f64>());
        length(near) >= FOLDED * way.fold(f64::INFINITY, f64::min)
    };
    let near = doubtful.into_iter().filter(|(pair, near)| !joined(*pair, near));
    match near.min_by(|a, b| length(&a.1).total_cmp(&length(&b.1))) {
        None => Ok(()),
        Some((pair, near)) => Err(refuse(pair, Fault::Near(length(&near)))),
    }
}

/// Warnings about faults below the free surface y = 0 that lie closer to their images in it than their cells are wide. Faults that reach the
/// surface meet their images there.
pub(super) fn images(scene: &Scene, cells: &[Cell]) -> Vec<Warning> {
    let depth = |cell: &Cell| -cell.bounds()[1][1];
    let near = |cell: &Cell| match between(cell, &cell.image(), Spacing::ByCells) {
        Meeting::Near(near) => Some(length(&near)),
        _ => None,
    };
    let doubt = |(k, (name, spec)): (usize, (&String, &Spec))| {
        let own = || cells.iter().filter(|cell| cell.fault == k);
        if own().any(|cell| depth(cell) <= cell.together(cell)) {
            return None;
        }
        let found = own().filter_map(|cell| Some((near(cell)?, cell)));
        let (distance, cell) = found.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let message = format!(
            "fault `{name}` lies too close to the free surface: its cell at {} is {} wide and {} from its image there, and slip that is uniform over cells does \
             not resolve the stress between them",
            coordinates::in_words(&<[f64; 3]>::from(cell.centre())),
            brief(cell.width),
            brief(distance)
        );
        Some(Warning::at(spec.span(), message, "smaller cells, or a fault that reaches the surface"))
    };
    scene.faults.iter().enumerate().filter_map(doubt).collect()
}

fn length([p, q]: &Nearest) -> f64 {
    (p - q).norm()
}

/// Pairs of cells whose boxes, wider by the distance that they keep, overlap: a sweep along the axis along which the cells extend farthest.
fn candidates(cells: &[Cell]) -> impl Iterator<Item = [usize; 2]> {
    let bounds: Vec<[Position; 2]> = cells.iter().map(bounds).collect();
    let extent = |axis: usize| {
        let high = bounds.iter().map(|b| b[1][axis]).fold(f64::NEG_INFINITY, f64::max);
        high - bounds.iter().map(|b| b[0][axis]).fold(f64::INFINITY, f64::min)
    };
    let along = (0..3).fold(0, |best, axis| if extent(axis) > extent(best) { axis } else { best });
    let mut sorted: Vec<usize> = (0..cells.len()).collect();
    sorted.sort_by(|&a, &b| bounds[a][0][along].total_cmp(&bounds[b][0][along]).then(a.cmp(&b)));
    let mut found = Vec::new();
    for (k, &a) in sorted.iter().enumerate() {
        let reached = |b: &&usize| bounds[**b][0][along] <= bounds[a][1][along];
        for &b in sorted[k + 1..].iter().take_while(reached) {
            // Cells of one rectangle lie in a plane side by side.
            let one_grid = cells[a].fault == cells[b].fault && cells[a].corners.len() == 4;
            let overlap =
                || (0..3).all(|c| bounds[a][0][c] <= bounds[b][1][c] && bounds[b][0][c] <= bounds[a][1][c]);
            if !one_grid && overlap() {
                found.push([a.min(b), a.max(b)]);
            }
        }
    }
    found.into_iter()
}

/// Box around a cell and the distance that others keep from it.
fn bounds(cell: &Cell) -> [Position; 2] {
    let margin = Position::repeat(CLOSEST * cell.width);
    let [low, high] = cell.bounds();
    [low - margin, high + margin]
}

/// Finds faults of the geometry of two cells of one fault in rock.
fn within(a: &Cell, b: &Cell) -> Option<Fault> {
    let common = a.common(b);
    if common.is_empty() {
        return far(a, b);
    }
    if common.len() > 1 || a.corners.len() == 2 {
        let angle = a.angle(b, &common).unwrap_or(0.0);
        return (angle < SHARPEST).then_some(Fault::Folds(angle));
    }
    // Triangles around a corner: the edges opposite to it do not meet the other triangle.
    let [one, two] = common[0];
    let edges = [(a.opposite(one), b), (b.opposite(two), a)];
    let meets = |(edge, cell): (Option<[Position; 2]>, &Cell)| {
        edge.is_some_and(|edge| length(&nearest(&edge, &cell.corners)) <= a.together(b))
    };
    edges.into_iter().any(meets).then_some(Fault::Touches)
}

/// Finds faults of the geometry of two cells of one fault that are no neighbours.
fn far(a: &Cell, b: &Cell) -> Option<Fault> {
    let ([low, high], [from, to]) = (a.bounds(), b.bounds());
    // Boxes are quick to compare.
    if (from - high).sup(&(low - to)).max() > FOLDED * a.width.max(b.width) {
        return None;
    }
    let near = nearest(&a.corners, &b.corners);
    let distance = length(&near);
    let least = match (a.along, b.along) {
        (Some(one), Some(two)) => {
            let way = (one[0] - two[1]).max(two[0] - one[1]);
            FOLDED * way.min(a.width.max(b.width))
        }
        // Between large triangles there may be a small one.
        _ => FOLDED * a.width.min(b.width),
    };
    let apart = distance >= least || (a.ends_before(b, &near[0]) && b.ends_before(a, &near[1]));
    let close = distance <= a.together(b);
    (!apart).then_some(if close { Fault::Touches } else { Fault::Near(distance) })
}

/// Finds out whether and how two cells of different faults meet.
enum Meeting {
    Clear,
    /// End to end, or edge to edge, at this position.
    Joint(Position),
    Near(Nearest),
    Touches,
}

fn between(a: &Cell, b: &Cell, spaced: Spacing) -> Meeting {
    let near = nearest(&a.corners, &b.corners);
    let distance = length(&near);
    let close = distance <= a.together(b);
    if spaced == Spacing::Apart {
        let shared = |x: &Position| b.corners.iter().any(|y| (x - y).norm() <= a.together(b));
        let same = a.fault == b.fault && !a.common(b).is_empty();
        return if close && !same && !a.corners.iter().any(shared) {
            Meeting::Touches
        } else {
            Meeting::Clear
        };
    }
    let ends = [a.ends_before(b, &near[0]), b.ends_before(a, &near[1])];
    if close {
        return if ends == [true; 2] { Meeting::Joint(near[0]) } else { Meeting::Touches };
    }
    let clear = [a, b].into_iter().zip(ends).all(|(cell, ends)| ends || distance >= CLOSEST * cell.width);
    if clear { Meeting::Clear } else { Meeting::Near(near) }
}

fn refused([a, b]: [(&String, &Spec); 2], cells: [&Cell; 2], why: &Fault) -> Diagnostic {
    let [one, two] = cells.map(|cell| coordinates::in_words(&<[f64; 3]>::from(cell.centre())));
    let own = a.0 == b.0;
    let (name, other) = (a.0, b.0);
    let message = match why {
        Fault::Folds(angle) => format!(
            "fault `{name}` folds back over itself: its cells at {one} and {two} enclose an angle of {:.1} degrees",
            angle.to_degrees()
        ),
        Fault::Touches if own => {
            format!("fault `{name}` crosses itself or lies on itself: its cells at {one} and {two} meet")
        }
        Fault::Touches => {
            format!("faults `{name}` and `{other}` cross or branch: their cells at {one} and {two} meet")
        }
        Fault::Near(distance) if own => {
            format!(
                "fault `{name}` lies too close to itself: its cells at {one} and {two} are {distance:.4} m apart"
            )
        }
        Fault::Near(distance) => format!(
            "faults `{name}` and `{other}` lie too close: their cells at {one} and {two} are {distance:.4} m apart"
        ),
    };
    let help = if own {
        "mesh each surface once; a fault has no second layer, keeps a quarter of a cell away from itself, and bends by 151 degrees at most"
    } else {
        "faults do not cross or branch, and keep nine tenths of the width of a cell away from each other; they may meet end to end, at a right angle or more"
    };
    Diagnostic::at(b.1.span(), message, help)
}
