//! Positions of grid lines: equal cells between fixed points, geometric sequences beyond.

use super::{FaultMeshError, MOST_CELLS, Spacing};

/// Relative deviation from the asked size that equal cells may have so as to end at a bend: not noticed by any quantity
/// that depends on the size.
const FIT: f64 = 0.05;

/// Halvings of an interval of ratios, enough to exhaust the digits of a number.
const HALVINGS: usize = 60;

/// Distances from the begin, 0 and `length` included: the ratio `r <= growth` of neighbouring sizes is constant, the first
/// size is `r` times `before`, the size of the cell in front.
pub(super) fn geometric(
    before: f64,
    length: f64,
    growth: f64,
    place: &'static str,
) -> Result<Vec<f64>, FaultMeshError> {
    if length < 0.5 * before {
        return Err(FaultMeshError::Gap { place, length, size: before });
    }
    let sum = |r: f64, n: usize| {
        let (mut total, mut size) = (0.0, before);
        for _ in 0..n {
            size *= r;
            total += size;
        }
        total
    };
    // Rounding of a length that is a whole number of cells must not cost a cell.
    let enough = length * (1.0 - f64::EPSILON.sqrt());
    let (mut n, mut total, mut size) = (0, 0.0, before);
    while total < enough {
        size *= growth;
        total += size;
        n += 1;
        if n > MOST_CELLS {
            return Err(FaultMeshError::TooMany { most: MOST_CELLS });
        }
    }
    // A single cell may have half the size of the one before; the sum grows with r.
    let (mut lo, mut hi) = (0.5, growth);
    for _ in 0..HALVINGS {
        let r = 0.5 * (lo + hi);
        if sum(r, n) < length { lo = r } else { hi = r }
    }
    let mut at = vec![0.0];
    let (mut total, mut size) = (0.0, before);
    for _ in 1..n {
        size *= hi;
        total += size;
        at.push(total);
    }
    at.push(length);
    Ok(at)
}

/// Distances along the fault of its nodes; the fixed points are among them. `vertices`: distances of the vertices, ascending
/// from 0 to the length.
pub(super) fn along(vertices: &[f64], spacing: Spacing) -> Result<Vec<f64>, FaultMeshError> {
    let length = vertices[vertices.len() - 1];
    match spacing {
        Spacing::Constant(size) => uniform(vertices, size),
        Spacing::Zone { from, to, size, ratio } => {
            if !(0.0 <= from && from < to && to <= length) {
                return Err(FaultMeshError::Zone { from, to, length });
            }
            let inner = || vertices.iter().copied().filter(|&v| from < v && v < to);
            let zone: Vec<f64> = [from].into_iter().chain(inner()).chain([to]).collect();
            let middle = uniform(&zone, size)?;
            let n = middle.len();
            let above = vertices.iter().rev().filter(|&&v| v < from).map(|v| from - v);
            let above = beyond(middle[1] - middle[0], above, ratio)?;
            let below = vertices.iter().filter(|&&v| v > to).map(|v| v - to);
            let below = beyond(middle[n - 1] - middle[n - 2], below, ratio)?;
            let mut all: Vec<f64> = above.iter().rev().map(|d| from - d).collect();
            if let Some(first) = all.first_mut() {
                *first = 0.0;
            }
            all.extend(middle);
            all.extend(below.iter().map(|d| to + d));
            Ok(all)
        }
    }
}

/// Equal cells from fixed point to fixed point.
fn uniform(fixed: &[f64], size: f64) -> Result<Vec<f64>, FaultMeshError> {
    let mut at = vec![fixed[0]];
    for w in fixed.windows(2) {
        let (from, to) = (w[0], w[1]);
        let n = ((to - from) / size).round();
        if n > MOST_CELLS as f64 {
            return Err(FaultMeshError::TooMany { most: MOST_CELLS });
        }
        if n < 1.0 || ((to - from) / n - size).abs() > FIT * size {
            let coarse = ((to - from) / size).floor().max(1.0);
            let [coarser, finer] = [coarse, coarse + 1.0].map(|n| (to - from) / n);
            return Err(FaultMeshError::Size { size, from, to, coarser, finer });
        }
        let n = n as usize;
        at.extend((1..n).map(|k| from + (to - from) * (k as f64 / n as f64)));
        at.push(to);
    }
    Ok(at)
}

/// Distances from the zone, growing from fixed point to fixed point.
fn beyond(before: f64, fixed: impl Iterator<Item = f64>, ratio: f64) -> Result<Vec<f64>, FaultMeshError> {
    let (mut size, mut reached, mut all) = (before, 0.0, Vec::new());
    for next in fixed {
        let piece = geometric(
            size,
            next - reached,
            ratio,
            "between a zone or bend of the fault and the next bend or tip",
        )?;
        let n = piece.len();
        size = piece[n - 1] - piece[n - 2];
        all.extend(piece[1..].iter().map(|d| reached + d));
        reached = next;
    }
    Ok(all)
}
