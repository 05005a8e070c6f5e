//! Faults as figures show them.

use super::plan::{FaultView, PointView};
use asperity_output::plots::{RuptureLine, RuptureShape, Surface};

/// Largest component of a unit vector across an axis: rounding.
const STRAIGHT: f64 = 1e-9;

/// Points of a fault as figures show them.
pub(crate) fn shape(in_space: bool, fault: &FaultView, points: &[PointView]) -> RuptureShape {
    if in_space {
        return RuptureShape::Surface(surface(fault, points));
    }
    let along = |axis: usize| points.iter().all(|p| p.normal[1 - axis].abs() > 1.0 - STRAIGHT);
    let line = match [along(0), along(1)] {
        [true, _] => ("x", points.iter().map(|p| p.at[0]).collect(), false),
        [_, true] => ("y", points.iter().map(|p| p.at[1]).collect(), false),
        _ => ("Distance along the fault", points.iter().map(|p| p.along).collect(), true),
    };
    RuptureShape::Line(RuptureLine { label: line.0.into(), along: line.1, down: line.2 })
}

/// A surface seen along an axis to which it is perpendicular, or along the normal of its first point. y points up where it lies in the surface.
fn surface(fault: &FaultView, points: &[PointView]) -> Surface {
    let (names, unit) =
        (["x", "y", "z"], |axis: usize| std::array::from_fn(|c| f64::from(u8::from(c == axis))));
    let across = (0..3).find(|&c| points.iter().all(|p| p.normal[c].abs() > 1.0 - STRAIGHT));
    let (axes, labels): ([[f64; 3]; 2], [String; 2]) = match (across, points.first()) {
        (Some(axis), _) => {
            let [a, b] = [[2, 1], [0, 2], [0, 1]][axis];
            ([unit(a), unit(b)], [names[a].into(), names[b].into()])
        }
        (None, Some(first)) => (
            [first.slides, first.across.unwrap_or([0.0; 3])],
            ["Along the rake".into(), "Across the rake".into()],
        ),
        (None, None) => ([unit(0), unit(1)], ["x".into(), "y".into()]),
    };
    let on = |p: &PointView, e: &[f64; 3]| p.at.iter().zip(e).map(|(x, e)| x * e).sum::<f64>();
    let places = points.iter().map(|p| (on(p, &axes[0]), on(p, &axes[1]))).collect();
    Surface { places, faces: fault.faces.clone(), labels }
}
