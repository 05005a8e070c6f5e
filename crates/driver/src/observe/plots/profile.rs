//! Tractions along an interface at stage ends.

use super::super::record::StageEnd;
use super::super::view::InterfaceMesh;
use super::axes::{Axis, Frame};
use super::colour::{Rgb, viridis};
use super::curves::{LEGEND, legend, title};
use super::figure::Figure;
use super::units::{LENGTH, STRESS};

/// Two positions closer than this fraction of the interface's extent are one: nodes of one line across it.
const SAME_LINE: f64 = 1e-6;

/// Normal (full) and shear traction (dashed) along the longest extent of the interface, averaged across it by area;
/// `None` when there is nothing to draw.
pub(super) fn tractions(
    scene: &str,
    mesh: &InterfaceMesh,
    interface: usize,
    ends: &[StageEnd],
) -> Option<Figure> {
    let axis = longest(mesh)?;
    let places: Vec<f64> = mesh.positions.iter().map(|p| p[axis]).collect();
    let mut curves: Vec<(String, Rgb, bool, Vec<(f64, f64)>)> = Vec::new();
    for (i, end) in ends.iter().enumerate() {
        let fields = end.interfaces.get(interface)?;
        let colour = viridis(0.25 + 0.5 * i as f64 / (ends.len().max(2) - 1) as f64);
        let along = |values: &[f64]| averaged(&places, &mesh.areas, values);
        curves.push((format!("{}: normal", end.name), colour, false, along(&fields.normal_traction)));
        curves.push((format!("{}: shear", end.name), colour, true, along(&fields.shear_traction)));
    }
    let finite = curves.iter().flat_map(|c| c.3.iter()).map(|p| p.1.abs()).filter(|v| v.is_finite());
    let (stress, length) = (STRESS.of(finite.fold(0.0, f64::max)), LENGTH.of(most(&places)));
    let (lo, hi) = places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &x| (lo.min(x), hi.max(x)));
    let values = curves.iter().flat_map(|c| c.3.iter()).map(|p| p.1 / stress.factor);
    let frame = Frame {
        at: (96.0, 40.0),
        size: (560.0, 380.0),
        x: Axis::exact((lo / length.factor, hi / length.factor), format!("{} [{}]", ["x", "y", "z"][axis], length.name)),
        y: Axis::linear(values, 0.05, format!("Traction [{}]", stress.name)),
    };
    if curves.is_empty() {
        return None;
    }
    let mut figure = Figure::new(96.0 + 560.0 + LEGEND, 480.0);
    title(&mut figure, &frame, scene, &mesh.name);
    frame.grid(&mut figure);
    for (_, colour, dashed, points) in &curves {
        let line: Vec<_> = points
            .iter()
            .filter(|(_, v)| v.is_finite())
            .map(|(x, v)| frame.point(x / length.factor, v / stress.factor))
            .collect();
        if *dashed {
            figure.dashed(&line, (6.0, 4.0), 1.8, *colour);
        } else {
            figure.line(line, 1.8, *colour);
        }
    }
    frame.draw(&mut figure);
    let entries: Vec<_> = curves.into_iter().map(|(name, colour, dashed, _)| (name, colour, dashed)).collect();
    legend(&mut figure, &frame, &entries);
    Some(figure)
}

/// The axis along which the interface is longest; `None` when it is a point.
fn longest(mesh: &InterfaceMesh) -> Option<usize> {
    let extent = |axis: usize| {
        let values = mesh.positions.iter().map(|p| p[axis]);
        let (lo, hi) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
        hi - lo
    };
    let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b)))?;
    (extent(axis) > 0.0 && extent(axis).is_finite()).then_some(axis)
}

fn most(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| most.max(v.abs()))
}

/// Values sorted by place; those at one place become their mean, weighted by area.
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
