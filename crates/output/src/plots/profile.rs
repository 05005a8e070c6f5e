//! Tractions along an interface at the ends of stages.

use super::super::record::StageEnd;
use super::super::view::InterfaceMesh;
use super::axes::{Axis, Frame};
use super::colour::viridis;
use super::curves::{Entry, legend};
use super::figure::{Dash, Figure, Point};
use super::title::title;
use super::units::{LENGTH, STRESS};

/// Nodes closer than this fraction of the extent of the interface count as one position: they lie on the same line across it.
const SAME_LINE: f64 = 1e-6;

/// Width right of the frame for the legend, whose entries name stages.
const LEGEND: f64 = 240.0;

/// Curve of a traction along the interface.
struct Curve {
    entry: Entry,
    /// Position \[m\] and traction \[Pa\].
    points: Vec<Point>,
}

/// Normal (solid) and shear traction (dashed) along the longest extent of the interface, averaged across it by area. `None` if
/// there is nothing to draw.
pub(super) fn tractions(
    scene: &str,
    mesh: &InterfaceMesh,
    interface: usize,
    ends: &[StageEnd],
) -> Option<Figure> {
    let axis = longest(mesh)?;
    let places: Vec<f64> = mesh.positions.iter().map(|p| p[axis]).collect();
    let curves = curves(mesh, &places, interface, ends);
    if curves.is_empty() {
        return None;
    }
    let values = || curves.iter().flat_map(|curve| curve.points.iter()).map(|p| p.1);
    let largest = values().map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let (stress, length) =
        (STRESS.of(largest), LENGTH.of(places.iter().fold(0.0, |most, v| most.max(v.abs()))));
    let (lo, hi) = bounds(&places);
    let label = format!("{} [{}]", ["x", "y", "z"][axis], length.name);
    let frame = Frame {
        at: (96.0, 40.0),
        size: (560.0, 380.0),
        x: Axis::exact((lo / length.factor, hi / length.factor), label),
        y: Axis::linear(values().map(|v| v / stress.factor), 0.05, format!("Traction [{}]", stress.name)),
    };
    let mut figure = Figure::new(96.0 + 560.0 + LEGEND, 480.0);
    title(&mut figure, &frame, scene, &mesh.name);
    frame.grid(&mut figure);
    for Curve { entry, points } in &curves {
        let finite = points.iter().filter(|(_, v)| v.is_finite());
        let line: Vec<Point> =
            finite.map(|(x, v)| frame.point(x / length.factor, v / stress.factor)).collect();
        figure.dashed(line, entry.dash, 1.8, entry.colour);
    }
    frame.draw(&mut figure);
    legend(&mut figure, &frame, curves.into_iter().map(|curve| curve.entry));
    Some(figure)
}

/// Two curves for the end of each stage.
fn curves(mesh: &InterfaceMesh, places: &[f64], interface: usize, ends: &[StageEnd]) -> Vec<Curve> {
    let mut curves = Vec::with_capacity(2 * ends.len());
    for (i, end) in ends.iter().enumerate() {
        let Some(fields) = end.interfaces.get(interface) else { continue };
        let colour = viridis(0.25 + 0.5 * i as f64 / (ends.len().max(2) - 1) as f64);
        for (name, values, dashed) in
            [("normal", &fields.mean_normal_traction, false), ("shear", &fields.mean_shear_traction, true)]
        {
            let dash: Dash = if dashed { &[6.0, 4.0] } else { &[] };
            let entry = Entry { name: format!("{name}, end of “{}”", end.name), colour, dash };
            curves.push(Curve { entry, points: averaged(places, &mesh.areas, values) });
        }
    }
    curves
}

/// Axis along which the interface is longest; `None` if it is a point.
fn longest(mesh: &InterfaceMesh) -> Option<usize> {
    let extent = |axis: usize| {
        let (lo, hi) = bounds(&mesh.positions.iter().map(|p| p[axis]).collect::<Vec<_>>());
        hi - lo
    };
    let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b)))?;
    (extent(axis) > 0.0 && extent(axis).is_finite()).then_some(axis)
}

fn bounds(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &x| (lo.min(x), hi.max(x)))
}

/// Values sorted by position. Values at the same position are replaced by their mean, weighted by area.
fn averaged(places: &[f64], areas: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
    let (Some(&first), Some(&last)) = (order.first(), order.last()) else { return Vec::new() };
    let near = SAME_LINE * (places[last] - places[first]);
    let mean = |group: &[usize]| {
        let weight = |i: usize| if areas[i] > 0.0 { areas[i] } else { 1.0 };
        let total: f64 = group.iter().map(|&i| weight(i)).sum();
        (places[group[0]], group.iter().map(|&i| weight(i) * values[i]).sum::<f64>() / total)
    };
    order.chunk_by(|&a, &b| places[b] - places[a] <= near).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_at_one_place_count_by_their_area() {
        let found = averaged(&[1.0, 0.0, 0.0], &[1.0, 1.0, 3.0], &[7.0, 4.0, 8.0]);
        assert_eq!(found, [(0.0, 7.0), (1.0, 7.0)]);
    }
}
