//! Faults as figures show them.

use super::plan::{FaultView, Outline, PointView};
use asperity_cycles::medium;
use asperity_output::plots::{RuptureLine, RuptureShape, Surface};

/// Largest component of a unit vector across an axis: rounding.
const STRAIGHT: f64 = 1e-9;

/// Points of a fault as figures show them.
pub(crate) fn shape(in_space: bool, fault: &FaultView, points: &[PointView]) -> RuptureShape {
    if in_space {
        return RuptureShape::Surface(seen(points.iter().map(|p| &p.at), fault.faces.clone(), points));
    }
    let along = |axis: usize| points.iter().all(|p| p.normal[1 - axis].abs() > 1.0 - STRAIGHT);
    let line = match [along(0), along(1)] {
        [true, _] => ("x", points.iter().map(|p| p.at[0]).collect(), false),
        [_, true] => ("y", points.iter().map(|p| p.at[1]).collect(), false),
        _ => ("Distance along the fault", points.iter().map(|p| p.along).collect(), true),
    };
    RuptureShape::Line(RuptureLine { label: line.0.into(), along: line.1, down: line.2 })
}

/// Corners of triangles, as figures show them.
pub(crate) fn corners(outline: &Outline, points: &[PointView]) -> RuptureShape {
    let faces = outline.corners.iter().map(|corners| corners.to_vec()).collect();
    RuptureShape::Surface(seen(outline.nodes.iter(), faces, points))
}

/// Values at the corners of triangles: means of the finite values of the triangles around them.
pub(crate) fn at_corners(outline: &Outline, values: &[f64]) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); outline.nodes.len()];
    for (corners, value) in outline.corners.iter().zip(values).filter(|(_, value)| value.is_finite()) {
        for &corner in corners {
            sums[corner] = (sums[corner].0 + value, sums[corner].1 + 1.0);
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

/// A surface seen along an axis to which it is perpendicular, or along the normal of its first point. y points up where it lies in the surface.
fn seen<'a>(
    places: impl Iterator<Item = &'a [f64; 3]>,
    faces: Vec<Vec<usize>>,
    points: &[PointView],
) -> Surface {
    let (names, unit) =
        (["x", "y", "z"], |axis: usize| std::array::from_fn(|c| f64::from(u8::from(c == axis))));
    let across = (0..3).find(|&c| points.iter().all(|p| p.normal[c].abs() > 1.0 - STRAIGHT));
    let (axes, labels): ([[f64; 3]; 2], [String; 2]) = match (across, points.first()) {
        (Some(axis), _) => {
            let [a, b] = [[2, 1], [0, 2], [0, 1]][axis];
            ([unit(a), unit(b)], [names[a].into(), names[b].into()])
        }
        (None, Some(first)) => (
            [first.slides, first.across.unwrap_or_else(|| medium::across(&first.normal, &first.slides))],
            ["Along the rake".into(), "Across the rake".into()],
        ),
        (None, None) => ([unit(0), unit(1)], ["x".into(), "y".into()]),
    };
    let on = |at: &[f64; 3], e: &[f64; 3]| at.iter().zip(e).map(|(x, e)| x * e).sum::<f64>();
    let places = places.map(|at| (on(at, &axes[0]), on(at, &axes[1]))).collect();
    Surface { places, faces, labels }
}
