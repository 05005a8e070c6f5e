//! Faults as figures show them.

use super::compass::{Compass, View};
use asperity_output::figures::{RuptureLine, RuptureShape, Surface};
use asperity_plan::faults::{FaultView, Outline, PointView};

/// Largest component of a unit vector across an axis: rounding.
const STRAIGHT: f64 = 1e-9;

/// Points of a fault as figures show them.
pub(crate) fn shape(
    in_space: bool,
    fault: &FaultView,
    points: &[PointView],
    compass: &Compass<'_>,
) -> RuptureShape {
    if in_space {
        let view = View::from_points(points, compass, false);
        return RuptureShape::Surface(view.surface(points.iter().map(|p| &p.at), fault.faces.clone()));
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
pub(crate) fn corners(outline: &Outline, points: &[PointView], compass: &Compass<'_>) -> Surface {
    let faces = outline.corners.iter().map(|corners| corners.to_vec()).collect();
    View::from_points(points, compass, true).surface(outline.nodes.iter(), faces)
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
