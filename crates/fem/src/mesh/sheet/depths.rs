//! Depth as a function of the position on a map, from scattered samples.

use super::SheetError;
use super::edges::{Edge, edges};
use super::scattered_samples::ScatteredSamples;
use super::slopes::slopes;
use std::collections::{BTreeMap, BTreeSet};

/// Depth \[m\] as a function of the position on the map \[m\].
///
/// In a Delaunay triangle of samples with depths z_i, slopes g_i and barycentric coordinates λ_i it is the mean of the plane
/// `Σ λ_i z_i` and of the tangent planes `Σ λ_i (z_i + g_i (x - x_i))`. Their errors on a quadratic surface are
/// `± Σ λ_i (x - x_i) H (x - x_i)/2`, so that the mean is exact there.
#[derive(Debug)]
pub struct Depths {
    /// East, north and depth of the samples, and the triangles between them.
    samples: ScatteredSamples,
    slopes: Vec<[f64; 2]>,
}

/// A contour.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Positions \[m\].
    pub spots: Vec<[f64; 2]>,
    /// True if it returns to its beginning.
    pub closed: bool,
}

impl Depths {
    /// Interpolation between samples of east, north and depth \[m\].
    ///
    /// # Errors
    /// [`SheetError`] if the samples span no surface or contradict each other.
    pub fn new(samples: &[[f64; 3]]) -> Result<Self, SheetError> {
        let samples = ScatteredSamples::new(samples)?;
        let slopes = slopes(samples.samples(), samples.faces().values());
        Ok(Self { samples, slopes })
    }

    /// Least and largest depth of the samples \[m\].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let depths = self.samples.samples().iter().map(|sample| sample[2]);
        depths.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
    }

    /// Depth at a position \[m\]; `None` outside the samples.
    #[must_use]
    pub fn at(&self, x: [f64; 2]) -> Option<f64> {
        let (corners, shares) = self.samples.shares(x)?;
        let samples = self.samples.samples();
        let value = |(share, n): (f64, usize)| {
            let (sample, slope) = (&samples[n], &self.slopes[n]);
            let tangent = slope[0] * (x[0] - sample[0]) + slope[1] * (x[1] - sample[1]);
            share * (sample[2] + 0.5 * tangent)
        };
        Some(shares.into_iter().zip(corners).map(value).sum())
    }

    /// Contours of a depth of the plane triangles between samples, each from border to border or closed.
    #[must_use]
    pub fn contours(&self, depth: f64) -> Vec<Line> {
        // Triangles beside the edges that cross the depth: a crossed triangle has two of them.
        let samples = self.samples.samples();
        let crossed = |[a, b]: Edge| (samples[a][2] < depth) != (samples[b][2] < depth);
        let mut beside: BTreeMap<Edge, Vec<[Edge; 2]>> = BTreeMap::new();
        for corners in self.samples.faces().values() {
            let found: Vec<Edge> = edges(corners).into_iter().filter(|&edge| crossed(edge)).collect();
            if let [a, b] = found[..] {
                beside.entry(a).or_default().push([a, b]);
                beside.entry(b).or_default().push([b, a]);
            }
        }
        let (mut seen, mut all) = (BTreeSet::new(), Vec::new());
        let (open, inside): (Vec<_>, Vec<_>) = beside.iter().partition(|(_, faces)| faces.len() == 1);
        for (closed, edge) in open.iter().map(|e| (false, e.0)).chain(inside.iter().map(|e| (true, e.0))) {
            let mut line = Line { spots: Vec::new(), closed };
            let mut next = Some(*edge);
            while let Some(edge) = next.filter(|&edge| seen.insert(edge)) {
                line.spots.push(self.crossing(edge, depth));
                next = beside[&edge].iter().map(|[_, other]| *other).find(|other| !seen.contains(other));
            }
            if !line.spots.is_empty() {
                all.push(line);
            }
        }
        all
    }

    /// Position at which an edge between two samples crosses a depth \[m\].
    fn crossing(&self, [a, b]: Edge, depth: f64) -> [f64; 2] {
        let samples = self.samples.samples();
        let (a, b) = (&samples[a], &samples[b]);
        let share = (depth - a[2]) / (b[2] - a[2]);
        std::array::from_fn(|c| a[c] + share * (b[c] - a[c]))
    }
}
