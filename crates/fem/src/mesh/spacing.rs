//! Positions of grid lines: equal cells between fixed points, geometric sequences beyond them.

use std::cmp::Ordering;

/// Largest number of cells of a mesh generated with given sizes: more do not fit a factorisation on any machine for which this
/// crate is intended.
pub const MOST_CELLS: usize = 10_000_000;

/// Sizes of cells along a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Spacing {
    /// One size \[m\]; between fixed points, the nearest size that divides the distance, at most 5 % off.
    Constant(f64),
    /// One size within a zone, growing beyond it.
    Zone {
        /// Start of the zone, along the line from its start \[m\].
        from: f64,
        /// End of the zone \[m\].
        to: f64,
        /// Size within \[m\].
        size: f64,
        /// Largest ratio of neighbouring sizes beyond, at least 1 \[-\].
        ratio: f64,
    },
    /// Sizes at distances along the line from its start, both \[m\], with ascending distances: linear between, constant beyond.
    /// The sizes are upper limits for the cells.
    Graded(Vec<[f64; 2]>),
}

/// Reasons why a line cannot be divided. Distances are along the line, from its start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpacingError {
    /// A number out of its range.
    #[error("{name} = {value} is not admissible: {admissible}")]
    Value {
        /// Name.
        name: &'static str,
        /// Given value.
        value: f64,
        /// Admissible values.
        admissible: &'static str,
    },
    /// A zone that is not on the line.
    #[error("the zone from {from} m to {to} m does not lie on the line, which runs from 0 m to {length} m")]
    Zone {
        /// Start \[m\].
        from: f64,
        /// End \[m\].
        to: f64,
        /// Length of the line \[m\].
        length: f64,
    },
    /// Equal cells that do not fit between two fixed points.
    #[error(
        "cells of {size} m do not fit the piece from {from} m to {to} m (between bends and ends of zones); {coarser} m and \
         {finer} m do"
    )]
    Size {
        /// Given size \[m\].
        size: f64,
        /// Start of the piece \[m\].
        from: f64,
        /// End of the piece \[m\].
        to: f64,
        /// Next larger size that fits \[m\].
        coarser: f64,
        /// Next smaller size that fits \[m\].
        finer: f64,
    },
    /// A distance too short for the cells beside it.
    #[error(
        "{place} there are {length} m, less than half of the neighbouring cell of {size} m: give at least {size} m, or finer \
         cells, or let what ends there reach the boundary"
    )]
    Gap {
        /// Position on the line.
        place: &'static str,
        /// Distance \[m\].
        length: f64,
        /// Size of the neighbouring cell \[m\].
        size: f64,
    },
    /// More cells than can be intended.
    #[error(
        "the mesh would have more than {most} cells: a coarser size, a larger growth ratio or a smaller box is needed"
    )]
    TooMany {
        /// Limit.
        most: usize,
    },
}

impl Spacing {
    /// Checks that the numbers are in their ranges, whatever the line.
    ///
    /// # Errors
    /// [`SpacingError::Value`].
    pub fn check(&self) -> Result<(), SpacingError> {
        let least = |name, value: f64, least: f64, admissible| {
            if value.is_finite() && value >= least {
                Ok(())
            } else {
                Err(SpacingError::Value { name, value, admissible })
            }
        };
        let size = |value| least("size", value, f64::MIN_POSITIVE, "a positive number of metres");
        match self {
            &Self::Constant(value) => size(value),
            &Self::Zone { size: value, ratio, .. } => {
                size(value)?;
                least("ratio", ratio, 1.0, "at least 1 (1.05 to 1.5 are usual)")
            }
            Self::Graded(table) => {
                let admissible = "distances that ascend, at least one";
                if table.is_empty() {
                    return Err(SpacingError::Value { name: "spacing", value: 0.0, admissible });
                }
                let falls = |w: &&[[f64; 2]]| w[0][0].partial_cmp(&w[1][0]) != Some(Ordering::Less);
                if let Some(w) = table.windows(2).find(falls) {
                    return Err(SpacingError::Value { name: "distance", value: w[1][0], admissible });
                }
                table.iter().try_for_each(|e| size(e[1]))
            }
        }
    }

    /// Positions of the grid lines of an axis from `min` to `max`, both included exactly \[m\]. Positions in zones and tables
    /// are coordinates along the axis.
    ///
    /// # Errors
    /// See [`SpacingError`]; its distances are measured from `min`.
    pub fn line(&self, min: f64, max: f64) -> Result<Vec<f64>, SpacingError> {
        self.check()?;
        let length = max - min;
        if !(length > 0.0 && length.is_finite()) {
            return Err(SpacingError::Value { name: "length", value: length, admissible: "positive" });
        }
        let shifted = match self {
            Self::Constant(size) => Self::Constant(*size),
            &Self::Zone { from, to, size, ratio } => {
                Self::Zone { from: from - min, to: to - min, size, ratio }
            }
            Self::Graded(table) => Self::Graded(table.iter().map(|e| [e[0] - min, e[1]]).collect()),
        };
        let mut at = along(&[0.0, length], &shifted)?;
        at.iter_mut().for_each(|x| *x += min);
        // The ends are exact, so that bodies meet and sides are found.
        let last = at.len() - 1;
        at[last] = max;
        Ok(at)
    }
}

/// Largest relative deviation of equal cells from the requested size, made to end at a bend: too small to affect any quantity
/// that depends on the size.
const FIT: f64 = 0.05;

/// Number of halvings of an interval of ratios that exhausts the digits of a number.
const HALVINGS: usize = 60;

/// Distances from the start, including 0 and `length`: the ratio `r <= growth` of neighbouring sizes is constant, and the first
/// size is `r` times `before`, the size of the preceding cell.
pub(super) fn geometric(
    before: f64,
    length: f64,
    growth: f64,
    place: &'static str,
) -> Result<Vec<f64>, SpacingError> {
    if length < 0.5 * before {
        return Err(SpacingError::Gap { place, length, size: before });
    }
    let sum = |r: f64, n: usize| {
        let (mut total, mut size) = (0.0, before);
        for _ in 0..n {
            size *= r;
            total += size;
        }
        total
    };
    // Rounding of a length that is a whole number of cells must not remove a cell.
    let enough = length * (1.0 - f64::EPSILON.sqrt());
    let (mut n, mut total, mut size) = (0, 0.0, before);
    while total < enough {
        size *= growth;
        total += size;
        n += 1;
        if n > MOST_CELLS {
            return Err(SpacingError::TooMany { most: MOST_CELLS });
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

/// Distances of the nodes along the fault, including the fixed points. `vertices` are the distances of the vertices, ascending
/// from 0 to the length.
pub(super) fn along(vertices: &[f64], spacing: &Spacing) -> Result<Vec<f64>, SpacingError> {
    let length = vertices[vertices.len() - 1];
    match spacing {
        &Spacing::Constant(size) => uniform(vertices, size),
        Spacing::Graded(table) => graded(vertices, table),
        &Spacing::Zone { from, to, size, ratio } => {
            if !(0.0 <= from && from < to && to <= length) {
                return Err(SpacingError::Zone { from, to, length });
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
fn uniform(fixed: &[f64], size: f64) -> Result<Vec<f64>, SpacingError> {
    let mut at = vec![fixed[0]];
    for w in fixed.windows(2) {
        let (from, to) = (w[0], w[1]);
        let n = ((to - from) / size).round();
        if n > MOST_CELLS as f64 {
            return Err(SpacingError::TooMany { most: MOST_CELLS });
        }
        if n < 1.0 || ((to - from) / n - size).abs() > FIT * size {
            let coarse = ((to - from) / size).floor().max(1.0);
            let [coarser, finer] = [coarse, coarse + 1.0].map(|n| (to - from) / n);
            return Err(SpacingError::Size { size, from, to, coarser, finer });
        }
        let n = n as usize;
        at.extend((1..n).map(|k| from + (to - from) * (k as f64 / n as f64)));
        at.push(to);
    }
    Ok(at)
}

/// Cells whose sizes follow a table of (distance, size), linear between its entries: equal parts of `n(z) = ∫ dz/size`.
fn graded(fixed: &[f64], table: &[[f64; 2]]) -> Result<Vec<f64>, SpacingError> {
    let mut at = vec![fixed[0]];
    for w in fixed.windows(2) {
        let (from, to) = (w[0], w[1]);
        // Pieces of the table between the fixed points: start, size there, end, size there.
        let inner = table.iter().map(|e| e[0]).filter(|&z| from < z && z < to);
        let ends: Vec<f64> = [from].into_iter().chain(inner).chain([to]).collect();
        let pieces: Vec<Piece> = ends
            .windows(2)
            .map(|e| Piece { from: e[0], to: e[1], sizes: [size_at(table, e[0]), size_at(table, e[1])] })
            .collect();
        let total: f64 = pieces.iter().map(Piece::cells).sum();
        // Rounding of a whole number of cells must not add a cell.
        let n = (total * (1.0 - f64::EPSILON.sqrt())).ceil().max(1.0);
        if n > MOST_CELLS as f64 {
            return Err(SpacingError::TooMany { most: MOST_CELLS });
        }
        let (mut piece, mut before) = (0, 0.0);
        for k in 1..n as usize {
            let wanted = total * (k as f64 / n);
            while piece + 1 < pieces.len() && before + pieces[piece].cells() < wanted {
                before += pieces[piece].cells();
                piece += 1;
            }
            at.push(pieces[piece].after(wanted - before));
        }
        at.push(to);
    }
    Ok(at)
}

/// A piece of a fault along which the size of cells is linear.
struct Piece {
    from: f64,
    to: f64,
    sizes: [f64; 2],
}

impl Piece {
    /// d(size)/dz.
    fn slope(&self) -> f64 {
        (self.sizes[1] - self.sizes[0]) / (self.to - self.from)
    }

    /// `∫ dz/size` over the piece: with slope k, `ln(1 + k L/size_0)/k`, in a form that is stable for small k.
    fn cells(&self) -> f64 {
        let x = self.sizes[1] / self.sizes[0] - 1.0;
        (self.to - self.from) / self.sizes[0] * if x == 0.0 { 1.0 } else { x.ln_1p() / x }
    }

    /// Distance at which the integral is `cells`.
    fn after(&self, cells: f64) -> f64 {
        let y = self.slope() * cells;
        self.from + self.sizes[0] * cells * if y == 0.0 { 1.0 } else { y.exp_m1() / y }
    }
}

/// Size at a distance: linear between entries, constant beyond.
fn size_at(table: &[[f64; 2]], z: f64) -> f64 {
    let k = table.partition_point(|e| e[0] <= z);
    if k == 0 {
        return table[0][1];
    }
    if k == table.len() {
        return table[k - 1][1];
    }
    let s = (z - table[k - 1][0]) / (table[k][0] - table[k - 1][0]);
    (1.0 - s) * table[k - 1][1] + s * table[k][1]
}

/// Distances from the zone, growing from fixed point to fixed point.
fn beyond(before: f64, fixed: impl Iterator<Item = f64>, ratio: f64) -> Result<Vec<f64>, SpacingError> {
    let (mut size, mut reached, mut all) = (before, 0.0, Vec::new());
    for next in fixed {
        let piece =
            geometric(size, next - reached, ratio, "between a zone or bend and the next bend or end")?;
        let n = piece.len();
        size = piece[n - 1] - piece[n - 2];
        all.extend(piece[1..].iter().map(|d| reached + d));
        reached = next;
    }
    Ok(all)
}
