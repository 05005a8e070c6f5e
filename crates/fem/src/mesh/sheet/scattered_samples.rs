//! Values at scattered positions of a plane, and between them.

use super::border::trimmed;
use super::edges::edges;
use spade::handles::{FaceHandle, InnerTag};
use spade::{DelaunayTriangulation, HasPosition, Point2, PositionInTriangulation, Triangulation as _};
use std::collections::BTreeMap;

/// Position of a sample.
#[derive(Clone, Copy, Debug)]
struct SamplePosition([f64; 2]);

impl HasPosition for SamplePosition {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.0[0], self.0[1])
    }
}

/// Reason why samples span no surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ScatterError {
    /// Too few positions, or all on one line.
    #[error("{positions} positions lie on one line or are fewer than three")]
    Few {
        /// Number of distinct positions.
        positions: usize,
    },
    /// Two values at one position.
    #[error("two values, {} and {}, are given at ({}, {})", .values[0], .values[1], .at[0], .at[1])]
    Twice {
        /// Position.
        at: [f64; 2],
        /// Values.
        values: [f64; 2],
    },
}

/// Distance beyond the border of the samples within which a position counts as on it, over their extent: rounding.
const ON_BORDER: f64 = 1e-9;

/// Samples of a plane with the Delaunay triangles between them, without flat ones at the border, which bridge its bays.
#[derive(Debug)]
pub struct ScatteredSamples {
    triangulation: DelaunayTriangulation<SamplePosition>,
    /// Distinct positions, with their values.
    samples: Vec<[f64; 3]>,
    /// Corners of the triangles by their number in the triangulation.
    faces: BTreeMap<usize, [usize; 3]>,
    /// Distances from samples to the farthest of their neighbours.
    reach: Vec<f64>,
    /// Mean of the samples.
    middle: [f64; 2],
}

impl ScatteredSamples {
    /// Triangles between samples, each with two coordinates and a value. Samples may be repeated.
    ///
    /// # Errors
    /// [`ScatterError`] if the samples span no surface or contradict each other.
    pub fn new(samples: &[[f64; 3]]) -> Result<Self, ScatterError> {
        let mut triangulation: DelaunayTriangulation<SamplePosition> = DelaunayTriangulation::new();
        let mut kept: Vec<[f64; 3]> = Vec::new();
        for &[x, y, value] in samples {
            if let Some(vertex) = triangulation.locate_vertex(Point2::new(x, y)) {
                let other = kept[vertex.index()][2];
                if other != value {
                    return Err(ScatterError::Twice { at: [x, y], values: [other, value] });
                }
                continue;
            }
            let few = |_| ScatterError::Few { positions: kept.len() };
            triangulation.insert(SamplePosition([x, y])).map_err(few)?;
            kept.push([x, y, value]);
        }
        let corners = |face: FaceHandle<'_, InnerTag, SamplePosition, (), (), ()>| {
            (face.index(), face.vertices().map(|vertex| vertex.index()))
        };
        let faces = trimmed(&kept, triangulation.inner_faces().map(corners).collect());
        if faces.is_empty() {
            return Err(ScatterError::Few { positions: kept.len() });
        }
        let mut reach = vec![0.0_f64; kept.len()];
        for [a, b] in faces.values().flat_map(edges) {
            let length = (kept[a][0] - kept[b][0]).hypot(kept[a][1] - kept[b][1]);
            reach[a] = reach[a].max(length);
            reach[b] = reach[b].max(length);
        }
        let count = kept.len() as f64;
        let middle = std::array::from_fn(|c| kept.iter().map(|sample| sample[c]).sum::<f64>() / count);
        Ok(Self { triangulation, samples: kept, faces, reach, middle })
    }

    /// Distinct samples, in the order in which they were given.
    #[must_use]
    pub fn samples(&self) -> &[[f64; 3]] {
        &self.samples
    }

    /// Corners of the triangles, by their numbers.
    pub(super) fn faces(&self) -> &BTreeMap<usize, [usize; 3]> {
        &self.faces
    }

    /// Corners of a triangle that contains a position, and the barycentric coordinates of the position in it.
    #[must_use]
    pub fn shares(&self, x: [f64; 2]) -> Option<([usize; 3], [f64; 3])> {
        let corners = self.around(x)?;
        Some((corners, self.within(x, corners)))
    }

    /// Value at a position, linear on the triangles; `None` outside them.
    #[must_use]
    pub fn linear(&self, x: [f64; 2]) -> Option<f64> {
        // A position on the border may lie outside by rounding.
        let inside = || std::array::from_fn(|c| x[c] + ON_BORDER * (self.middle[c] - x[c]));
        let corners = self.around(x).or_else(|| self.around(inside()))?;
        let shares = self.within(x, corners);
        Some(shares.into_iter().zip(corners).map(|(share, n)| share * self.samples[n][2]).sum())
    }

    /// Value of the sample nearest to a position; `None` outside the triangles, if none is as near as its own neighbours are.
    #[must_use]
    pub fn nearest(&self, x: [f64; 2]) -> Option<f64> {
        let vertex = self.triangulation.nearest_neighbor(Point2::new(x[0], x[1]))?.index();
        let sample = &self.samples[vertex];
        let near = (x[0] - sample[0]).hypot(x[1] - sample[1]) <= self.reach[vertex];
        (near || self.around(x).is_some()).then_some(sample[2])
    }

    fn within(&self, x: [f64; 2], corners: [usize; 3]) -> [f64; 3] {
        let [a, b, c] = corners.map(|n| &self.samples[n]);
        let area = |p: &[f64; 2], q: &[f64; 3], r: &[f64; 3]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let whole = area(&[a[0], a[1]], b, c);
        [area(&x, b, c) / whole, area(&x, c, a) / whole, area(&x, a, b) / whole]
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
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners and middle of a square of 2, with the value x + 10 y.
    fn square() -> ScatteredSamples {
        let at = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
        ScatteredSamples::new(&at.map(|[x, y]| [x, y, x + 10.0 * y])).unwrap()
    }

    #[test]
    fn values_are_linear_up_to_the_border_and_none_beyond() {
        let samples = square();
        assert!((samples.linear([0.5, 0.25]).unwrap() - 3.0).abs() < 1e-14);
        assert!((samples.linear([2.0 + 1e-10, 1.0]).unwrap() - 12.0).abs() < 1e-8);
        assert_eq!(samples.linear([2.01, 1.0]), None);
    }

    #[test]
    fn the_nearest_value_reaches_as_far_beyond_the_border_as_neighbours_are() {
        let samples = square();
        assert_eq!(samples.nearest([0.3, 0.1]), Some(0.0));
        assert_eq!(samples.nearest([-1.5, 0.0]), Some(0.0));
        assert_eq!(samples.nearest([-2.5, 0.0]), None);
    }

    #[test]
    fn samples_that_contradict_each_other_or_lie_on_a_line_are_refused() {
        let twice =
            ScatteredSamples::new(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 2.0]]);
        assert_eq!(twice.unwrap_err(), ScatterError::Twice { at: [0.0; 2], values: [1.0, 2.0] });
        let line = ScatteredSamples::new(&[[0.0, 0.0, 1.0], [1.0, 1.0, 2.0], [2.0, 2.0, 3.0]]);
        assert_eq!(line.unwrap_err(), ScatterError::Few { positions: 3 });
    }
}
