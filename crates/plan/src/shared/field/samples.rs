//! Values between the positions of a file.

use asperity_fem::mesh::sheet::{ScatterError, ScatteredSamples};

/// Distance beyond the ends of a line within which a position counts as on it, over its length: rounding.
const ON_END: f64 = 1e-9;

/// Samples on a line or a plane.
#[derive(Debug)]
pub enum Samples {
    /// Positions that ascend, with their values.
    Line {
        /// The positions and values.
        points: Vec<(f64, f64)>,
        /// True for values of the nearest position.
        nearest: bool,
    },
    /// Positions of a plane.
    Plane {
        /// The positions and values.
        samples: ScatteredSamples,
        /// True for values of the nearest position.
        nearest: bool,
    },
}

impl Samples {
    /// Samples at positions with one or two coordinates.
    ///
    /// # Errors
    /// [`ScatterError`] for positions without extent, or with two values.
    pub fn new(positions: &[Vec<f64>], values: &[f64], nearest: bool) -> Result<Self, ScatterError> {
        let rows = positions.iter().zip(values);
        if positions.iter().any(|x| x.len() == 2) {
            let samples: Vec<[f64; 3]> = rows.map(|(x, v)| [x[0], x[1], *v]).collect();
            return Ok(Self::Plane { samples: ScatteredSamples::new(&samples)?, nearest });
        }
        let mut points: Vec<(f64, f64)> = rows.map(|(x, v)| (x[0], *v)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup();
        if let Some(twice) = points.windows(2).find(|w| w[0].0 == w[1].0) {
            let values = [twice[0].1, twice[1].1];
            return Err(ScatterError::Twice { at: [twice[0].0, 0.0], values });
        }
        if points.len() < 2 {
            return Err(ScatterError::Few { positions: points.len() });
        }
        Ok(Self::Line { points, nearest })
    }

    /// Number of distinct positions.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Line { points, .. } => points.len(),
            Self::Plane { samples, .. } => samples.samples().len(),
        }
    }

    /// Value at a position; `None` outside the samples.
    #[must_use]
    pub fn at(&self, x: &[f64]) -> Option<f64> {
        match self {
            Self::Line { points, nearest: false } => {
                let ends = [points[0].0, points[points.len() - 1].0];
                within(ends, x[0]).then(|| linear(points, x[0]))
            }
            Self::Line { points, nearest: true } => {
                nearest(points.len(), |k| points[k].0, x[0]).map(|k| points[k].1)
            }
            Self::Plane { samples, nearest: false } => samples.linear([x[0], x[1]]),
            Self::Plane { samples, nearest: true } => samples.nearest([x[0], x[1]]),
        }
    }

    /// Interpolation as text.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match self {
            Self::Line { nearest: true, .. } | Self::Plane { nearest: true, .. } => "the nearest",
            Self::Line { .. } => "linear between them",
            Self::Plane { .. } => "linear on triangles between them",
        }
    }
}

/// Value at a position between nodes, of which `node` has position and value: linear between them, constant beyond them.
pub(crate) fn between(count: usize, node: impl Fn(usize) -> (f64, f64), x: f64) -> f64 {
    let (mut low, mut k) = (0, count);
    while low < k {
        let middle = low.midpoint(k);
        if node(middle).0 <= x { low = middle + 1 } else { k = middle }
    }
    if k == 0 || k == count {
        return node(k.min(count - 1)).1;
    }
    let (a, b) = (node(k - 1), node(k));
    let s = (x - a.0) / (b.0 - a.0);
    (1.0 - s) * a.1 + s * b.1
}

/// True if a position lies between the first and the last.
pub(super) fn within([first, last]: [f64; 2], x: f64) -> bool {
    let close = ON_END * (last - first);
    first - close <= x && x <= last + close
}

fn linear(points: &[(f64, f64)], x: f64) -> f64 {
    between(points.len(), |k| points[k], x)
}

/// The nearest of `count` positions that ascend; `None` beyond an end, if it is farther away than its neighbour is.
pub(super) fn nearest(count: usize, at: impl Fn(usize) -> f64, x: f64) -> Option<usize> {
    let k = (0..count).min_by(|&i, &j| (at(i) - x).abs().total_cmp(&(at(j) - x).abs()))?;
    let next = if k + 1 < count { k + 1 } else { k - 1 };
    let near = (at(k) - x).abs() <= (at(next) - at(k)).abs();
    (within([at(0), at(count - 1)], x) || near).then_some(k)
}
