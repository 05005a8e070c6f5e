//! Depth as a smooth function of the position, from scattered samples.

use super::SheetError;
use spade::handles::UndirectedEdgeHandle;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation as _};
use std::collections::BTreeSet;

/// A sample of a surface.
#[derive(Clone, Copy, Debug)]
struct Sample {
    at: [f64; 2],
    depth: f64,
}

impl HasPosition for Sample {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.at[0], self.at[1])
    }
}

/// A contour.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Positions \[m\].
    pub spots: Vec<[f64; 2]>,
    /// True if it returns to its beginning.
    pub closed: bool,
}

/// Exponent of the squared distance in the weights of the gradients: that of Sibson (1981), with which the interpolation
/// has continuous slopes.
const FLATNESS: f64 = 0.5;

/// Depth \[m\] as a function of the position on the map \[m\]: the interpolation of Sibson (1981) between natural
/// neighbours, which has continuous slopes.
#[derive(Debug)]
pub struct Depths {
    triangulation: DelaunayTriangulation<Sample>,
    gradients: Vec<[f64; 2]>,
    range: [f64; 2],
}

impl Depths {
    /// Interpolation between samples of east, north and depth \[m\].
    ///
    /// # Errors
    /// [`SheetError`] if the samples span no surface or contradict each other.
    pub fn new(samples: &[[f64; 3]]) -> Result<Self, SheetError> {
        let mut triangulation: DelaunayTriangulation<Sample> = DelaunayTriangulation::new();
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for &[x, y, depth] in samples {
            let few = |_| SheetError::Few { positions: 0 };
            let before = triangulation.num_vertices();
            let sample = Sample { at: [x, y], depth };
            if let Some(vertex) = triangulation.locate_vertex(sample.position()) {
                let other = vertex.data().depth;
                if other != depth {
                    return Err(SheetError::Twice { at: [x, y], depths: [other, depth] });
                }
                continue;
            }
            triangulation.insert(sample).map_err(few)?;
            debug_assert!(triangulation.num_vertices() == before + 1);
            range = [range[0].min(depth), range[1].max(depth)];
        }
        if triangulation.num_inner_faces() == 0 {
            return Err(SheetError::Few { positions: triangulation.num_vertices() });
        }
        let neighbours = triangulation.natural_neighbor();
        let gradients =
            triangulation.vertices().map(|v| neighbours.estimate_gradient(v, |v| v.data().depth)).collect();
        Ok(Self { triangulation, gradients, range })
    }

    /// Least and largest depth of the samples \[m\].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Depth at a position \[m\]; `None` outside the samples.
    #[must_use]
    pub fn at(&self, x: [f64; 2]) -> Option<f64> {
        let neighbours = self.triangulation.natural_neighbor();
        let depth = |v: spade::handles::VertexHandle<'_, Sample, _, _, _>| v.data().depth;
        neighbours
            .interpolate_gradient(depth, |v| self.gradients[v.index()], FLATNESS, Point2::new(x[0], x[1]))
            .filter(|depth| depth.is_finite())
    }

    /// Contours of a depth of the plane triangles between samples, each from border to border or closed, as positions \[m\].
    #[must_use]
    pub fn contours(&self, depth: f64) -> Vec<Line> {
        let crossed = |a: &Sample, b: &Sample| (a.depth < depth) != (b.depth < depth);
        let edges: Vec<_> = self
            .triangulation
            .undirected_edges()
            .filter(|edge| {
                let [a, b] = edge.vertices();
                crossed(a.data(), b.data())
            })
            .collect();
        let (on_border, inside): (Vec<_>, Vec<_>) =
            edges.into_iter().partition(|edge| edge.is_part_of_convex_hull());
        let (mut seen, mut all) = (BTreeSet::new(), Vec::new());
        for edge in on_border.iter().chain(&inside) {
            if !seen.insert(edge.index()) {
                continue;
            }
            let mut line =
                Line { spots: vec![self.crossing(edge, depth)], closed: !edge.is_part_of_convex_hull() };
            // The way into the rock on one side; an edge of the border has one face only.
            let directed = edge.as_directed();
            let mut way = if directed.is_outer_edge() { directed.rev() } else { directed };
            while let Some(next) =
                [way.next(), way.prev()].into_iter().find(|e| crossed(e.from().data(), e.to().data()))
            {
                let edge = next.as_undirected();
                line.spots.push(self.crossing(&edge, depth));
                if !seen.insert(edge.index()) || next.rev().is_outer_edge() {
                    break;
                }
                way = next.rev();
            }
            all.push(line);
        }
        all
    }

    /// Position at which an edge between two samples crosses a depth \[m\].
    fn crossing(&self, edge: &UndirectedEdgeHandle<'_, Sample, (), (), ()>, depth: f64) -> [f64; 2] {
        let [a, b] = edge.vertices().map(|v| *v.data());
        let share = (depth - a.depth) / (b.depth - a.depth);
        std::array::from_fn(|c| a.at[c] + share * (b.at[c] - a.at[c]))
    }
}
