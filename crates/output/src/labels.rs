//! Labels of positions.

use super::units;
use std::collections::BTreeSet;

/// Labels that distinguish positions: the coordinates in which they differ, in a common unit.
pub(crate) fn position_labels(positions: impl Iterator<Item = [f64; 3]>) -> Vec<String> {
    let positions: Vec<[f64; 3]> = positions.collect();
    let bounds = |axis: usize| {
        let values = positions.iter().map(|p| p[axis]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)))
    };
    let largest = positions.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut axes: Vec<usize> = (0..3)
        .filter(|&axis| {
            let (lo, hi) = bounds(axis);
            hi - lo > SAME_PLACE * largest
        })
        .collect();
    if axes.is_empty() {
        axes = vec![0, 1];
    }
    let unit = units::LENGTH.choose(largest);
    let label = |p: &[f64; 3], digits: i32| {
        // Round to this number of digits of the largest coordinate.
        let fine = 10.0_f64.powi(digits - 1 - (largest / unit.factor).max(1.0).log10() as i32);
        let parts = axes.iter().map(|&axis| {
            let value = (p[axis] / unit.factor * fine).round() / fine + 0.0;
            format!("{} = {value}", ["x", "y", "z"][axis])
        });
        format!("{} {}", parts.collect::<Vec<_>>().join("; "), unit.name)
    };
    let labels = |digits: i32| positions.iter().map(|p| label(p, digits)).collect::<Vec<_>>();
    let different = |labels: &[String]| labels.iter().collect::<BTreeSet<_>>().len() == labels.len();
    // Four digits are easy to read; more are used only if they are needed.
    (4..9).map(labels).find(|labels| different(labels)).unwrap_or_else(|| labels(9))
}

/// Coordinates closer than this fraction of the largest one count as equal, as generated meshes place nodes to rounding.
const SAME_PLACE: f64 = 1e-9;
