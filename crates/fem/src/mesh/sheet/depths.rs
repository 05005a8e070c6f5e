//! Depth as a function of the position on a map, from scattered samples.

use super::SheetError;
use super::border::trimmed;
use super::edges::{Edge, edges};
use super::slopes::slopes;
use spade::{DelaunayTriangulation, HasPosition, Point2, PositionInTriangulation, Triangulation as _};
use std::collections::{BTreeMap, BTreeSet};

/// Position of a sample on the map.
#[derive(Clone, Copy, Debug)]
struct At([f64; 2]);

impl HasPosition for At {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.0[0], self.0[1])
    }
}

/// Depth \[m\] as a function of the position on the map \[m\].
///
/// In a Delaunay triangle of samples with depths z_i, slopes g_i and barycentric coordinates λ_i it is the mean of the plane
/// `Σ λ_i z_i` and of the tangent planes `Σ λ_i (z_i + g_i (x - x_i))`. Their errors on a quadratic surface are
/// `± Σ λ_i (x - x_i) H (x - x_i)/2`, so that the mean is exact there.
#[derive(Debug)]
pub struct Depths {
    triangulation: DelaunayTriangulation<At>,
    /// East, north and depth of the samples.
    samples: Vec<[f64; 3]>,
    /// Corners of the triangles by their number in the triangulation, without those left out at the border.
    faces: BTreeMap<usize, [usize; 3]>,
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
        let mut triangulation: DelaunayTriangulation<At> = DelaunayTriangulation::new();
        let mut kept: Vec<[f64; 3]> = Vec::new();
        for &[x, y, depth] in samples {
            if let Some(vertex) = triangulation.locate_vertex(Point2::new(x, y)) {
                let other = kept[vertex.index()][2];
                if other != depth {
                    return Err(SheetError::Twice { at: [x, y], depths: [other, depth] });
                }
                continue;
            }
            let few = |_| SheetError::Few { positions: kept.len() };
            triangulation.insert(At([x, y])).map_err(few)?;
            kept.push([x, y, depth]);
        }
        let corners = |face: spade::handles::FaceHandle<'_, spade::handles::InnerTag, At, (), (), ()>| {
            (face.index(), face.vertices().map(|vertex| vertex.index()))
        };
        let faces = trimmed(&kept, triangulation.inner_faces().map(corners).collect());
        if faces.is_empty() {
            return Err(SheetError::Few { positions: kept.len() });
        }
        let slopes = slopes(&kept, faces.values());
        Ok(Self { triangulation, samples: kept, faces, slopes })
    }

    /// Least and largest depth of the samples \[m\].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let depths = self.samples.iter().map(|sample| sample[2]);
        depths.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
    }

    /// Depth at a position \[m\]; `None` outside the samples.
    #[must_use]
    pub fn at(&self, x: [f64; 2]) -> Option<f64> {
        let corners = self.around(x)?;
        let [a, b, c] = corners.map(|n| &self.samples[n]);
        let area = |p: &[f64; 2], q: &[f64; 3], r: &[f64; 3]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let whole = area(&[a[0], a[1]], b, c);
        let shares = [area(&x, b, c) / whole, area(&x, c, a) / whole, area(&x, a, b) / whole];
        let value = |(share, n): (f64, usize)| {
            let (sample, slope) = (&self.samples[n], &self.slopes[n]);
            let tangent = slope[0] * (x[0] - sample[0]) + slope[1] * (x[1] - sample[1]);
            share * (sample[2] + 0.5 * tangent)
        };
        Some(shares.into_iter().zip(corners).map(value).sum())
    }

    /// Corners of a triangle that contains a position.
    fn around(&self, x: [f64; 2]) -> Option<[usize; 3]> {
        let of = |face: usize| self.faces.get(&face).copied();
        match self.triangulation.locate(Point2::new(x[0], x[1])) {
            PositionInTriangulation::OnFace(face) => of(face.index()),
            PositionInTriangulation::OnEdge(edge) => {
                let edge = self.triangulation.directed_edge(edge);
                let sides = [edge.face(), edge.rev().face()];
                sides.into_iter().filter_map(|face| face.as_inner()).find_map(|face| of(face.index()))
            }
            PositionInTriangulation::OnVertex(vertex) => {
                let vertex = self.triangulation.vertex(vertex);
                let mut faces = vertex.out_edges().filter_map(|edge| edge.face().as_inner());
                faces.find_map(|face| of(face.index()))
            }
            _ => None,
        }
    }

    /// Contours of a depth of the plane triangles between samples, each from border to border or closed.
    #[must_use]
    pub fn contours(&self, depth: f64) -> Vec<Line> {
        // Triangles beside the edges that cross the depth: a crossed triangle has two of them.
        let crossed = |[a, b]: Edge| (self.samples[a][2] < depth) != (self.samples[b][2] < depth);
        let mut beside: BTreeMap<Edge, Vec<[Edge; 2]>> = BTreeMap::new();
        for corners in self.faces.values() {
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
        let (a, b) = (&self.samples[a], &self.samples[b]);
        let share = (depth - a[2]) / (b[2] - a[2]);
        std::array::from_fn(|c| a[c] + share * (b[c] - a[c]))
    }
}
