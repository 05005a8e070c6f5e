//! Facets of first order into which the faces of both sides are divided.
//!
//! A face of first order is its own facet. One of second order is divided through its mid-nodes, so that corners of facets are nodes
//! (Puso, Laursen and Solberg 2008) or the middle of a face of eight nodes (`centre`). Facets decide what overlaps and which positions face each other; displacements and
//! positions that are averaged remain those of the whole face. A facet is a parallelogram or a triangle in the natural coordinates
//! of its face, which are thus affine in its own.
//!
//! Puso, M. A., Laursen, T. A. and Solberg, J. (2008), A segment-to-segment mortar contact method for quadratic elements and
//! large deformations, Computer Methods in Applied Mechanics and Engineering 197, 555-566.

use super::scalar::Scalar;
use crate::SegmentKind;
use crate::shape::shape;
use crate::spec::Segment;
use crate::vector::{cross, norm, sub};

/// Most corners of a facet.
pub(super) const NODES: usize = 4;

/// A facet of either side.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Kind, of first order.
    pub kind: SegmentKind,
    /// Nodes at its corners, or the middle of its face.
    pub nodes: Vec<usize>,
    /// Local numbers of its corners in the face; that of the middle of a face of eight nodes is 8.
    pub corners: &'static [usize],
    pub face: Face,
    /// Values of the functions of its corners at each node of the face. These functions are in the span of those of the face, and
    /// their values at its nodes are the coefficients.
    pub functions: Vec<[f64; NODES]>,
    /// Largest relative deviation of the Jacobian from its mean, in the reference configuration.
    pub distortion: f64,
}

/// The face of which a facet is a part.
#[derive(Clone, Debug)]
pub(super) struct Face {
    pub kind: SegmentKind,
    pub nodes: Vec<usize>,
    /// Its natural coordinates at the origin of those of the facet.
    origin: [f64; 2],
    /// Their slopes along each natural coordinate of the facet.
    along: [[f64; 2]; 2],
    /// Slopes of the natural coordinates of the facet along each of the face.
    back: [[f64; 2]; 2],
}

/// A facet of a kind of face: its kind and the local numbers of its corners.
type Part = (SegmentKind, &'static [usize]);

/// Facets of a kind of face.
pub(super) fn parts(kind: SegmentKind) -> &'static [Part] {
    use SegmentKind::{Quad4, Quad8, Quad9, Seg2, Seg3, Tri3, Tri6};
    match kind {
        Seg2 => &[(Seg2, &[0, 1])],
        Seg3 => &[(Seg2, &[0, 2]), (Seg2, &[2, 1])],
        Tri3 => &[(Tri3, &[0, 1, 2])],
        Tri6 => &[(Tri3, &[0, 3, 5]), (Tri3, &[3, 1, 4]), (Tri3, &[5, 4, 2]), (Tri3, &[3, 4, 5])],
        Quad4 => &[(Quad4, &[0, 1, 2, 3])],
        Quad8 | Quad9 => {
            &[(Quad4, &[0, 4, 8, 7]), (Quad4, &[4, 1, 5, 8]), (Quad4, &[8, 5, 2, 6]), (Quad4, &[7, 8, 6, 3])]
        }
    }
}

/// Facets of a face whose nodes have the reference `positions`, as has the middle of a face of eight nodes.
pub(super) fn facets<const D: usize>(
    face: &Segment,
    middle: Option<usize>,
    positions: &[[f64; D]],
) -> Vec<Facet> {
    let facet = |&(kind, corners): &Part| {
        let all = || face.nodes.iter().copied().chain(middle);
        let nodes: Vec<usize> = corners.iter().filter_map(|&k| all().nth(k)).collect();
        let x: Vec<[f64; D]> = nodes.iter().map(|&n| positions[n]).collect();
        let distortion = distortion(kind, &x);
        let face = Face::new(face, kind, corners);
        let functions = (0..face.nodes.len()).map(|k| face.corner_functions(kind, k)).collect();
        Facet { kind, nodes, corners, face, functions, distortion }
    };
    parts(face.kind).iter().map(facet).collect()
}

impl Facet {
    /// Numbers of the nodes of the face, followed by that of its middle if it is a corner.
    #[inline]
    pub(super) fn movers(&self) -> impl Iterator<Item = usize> + '_ {
        let middle = self.corners.iter().position(|&k| k == self.face.nodes.len());
        self.face.nodes.iter().copied().chain(middle.map(|corner| self.nodes[corner]))
    }

    /// Integrals of the products of a function with those of the corners, from the integrals of its products with those of the face.
    #[inline]
    pub(super) fn with_corners(&self, with_face: &[f64]) -> [f64; NODES] {
        let mut out = [0.0; NODES];
        for (functions, w) in self.functions.iter().zip(with_face) {
            out.iter_mut().zip(functions).for_each(|(o, f)| *o += f * w);
        }
        out
    }
}

impl Face {
    fn new(face: &Segment, kind: SegmentKind, corners: &[usize]) -> Self {
        let nodes = face.nodes.clone();
        if face.kind.first_order() {
            let unit = [[1.0, 0.0], [0.0, 1.0]];
            return Self { kind: face.kind, nodes, origin: [0.0; 2], along: unit, back: unit };
        }
        let at = |k: usize| node_at(face.kind, corners[k]);
        // The image of (0, 0), and those of the unit vectors, from three corners.
        let (first, last) = (at(1), at(corners.len() - 1));
        let half = |p: [f64; 2]| -> [f64; 2] { std::array::from_fn(|i| 0.5 * (p[i] - at(0)[i])) };
        let middle = |p: [f64; 2], q: [f64; 2]| -> [f64; 2] { std::array::from_fn(|i| 0.5 * (p[i] + q[i])) };
        let (origin, along) = match kind {
            SegmentKind::Tri3 => (at(0), [half(first), half(last)].map(|e| e.map(|v| 2.0 * v))),
            SegmentKind::Seg2 => (middle(at(0), first), [half(first), [0.0, 1.0]]),
            _ => (middle(first, last), [half(first), half(last)]),
        };
        let [[a, b], [c, d]] = along;
        let det = a * d - b * c;
        Self { kind: face.kind, nodes, origin, along, back: [[d / det, -b / det], [-c / det, a / det]] }
    }

    /// Values of the functions of the corners of its facet, of this kind, at node `k`.
    fn corner_functions(&self, facet: SegmentKind, k: usize) -> [f64; NODES] {
        let xi = self.facet_coordinates(&node_at(self.kind, k));
        std::array::from_fn(|corner| shape(facet, xi).value[corner])
    }

    /// Natural coordinates of the face at those of the facet.
    #[inline]
    pub(super) fn at<T: Scalar>(&self, xi: &[T; 2]) -> [T; 2] {
        std::array::from_fn(|i| {
            T::constant(self.origin[i]) + xi[0].times(self.along[0][i]) + xi[1].times(self.along[1][i])
        })
    }

    /// Natural coordinates of the facet at those of the face.
    #[inline]
    pub(super) fn facet_coordinates<T: Scalar>(&self, at: &[T; 2]) -> [T; 2] {
        if self.kind.first_order() {
            return *at;
        }
        let off: [T; 2] = std::array::from_fn(|i| at[i] - T::constant(self.origin[i]));
        std::array::from_fn(|m| off[0].times(self.back[0][m]) + off[1].times(self.back[1][m]))
    }

    /// Ratio of lengths or areas in the natural coordinates of the face to those of the facet.
    pub(super) fn scale(&self) -> f64 {
        let [[a, b], [c, d]] = self.along;
        (a * d - b * c).abs()
    }

    /// Slopes of a function in the natural coordinates of the face, from those in the coordinates of the facet.
    #[inline]
    pub(super) fn slopes(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.back.map(|b| b[0] * x + b[1] * y)
    }
}

/// Largest relative deviation of the Jacobian from its mean at the corners of a facet at `x`. It is 0 on lines and triangles.
fn distortion<const D: usize>(kind: SegmentKind, x: &[[f64; D]]) -> f64 {
    if kind != SegmentKind::Quad4 {
        return 0.0;
    }
    let jacobian = |k: usize| norm(&cross(&sub(&x[(k + 1) % 4], &x[k]), &sub(&x[(k + 3) % 4], &x[k])));
    let (low, high) = (0..4).map(jacobian).fold((f64::INFINITY, 0.0f64), |(l, h), j| (l.min(j), h.max(j)));
    (high - low) / (high + low)
}

/// Natural coordinates in the middle of a facet.
#[inline]
pub(super) fn middle(kind: SegmentKind) -> [f64; 2] {
    if kind == SegmentKind::Tri3 { [1.0 / 3.0; 2] } else { [0.0; 2] }
}

/// Natural coordinates of local node `k` of a face.
pub(super) fn node_at(kind: SegmentKind, k: usize) -> [f64; 2] {
    const LINE: [[f64; 2]; 3] = [[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];
    const TRIANGLE: [[f64; 2]; 6] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
    const SQUARE: [[f64; 2]; 9] = [
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 1.0],
        [-1.0, 1.0],
        [0.0, -1.0],
        [1.0, 0.0],
        [0.0, 1.0],
        [-1.0, 0.0],
        [0.0, 0.0],
    ];
    match kind {
        SegmentKind::Seg2 | SegmentKind::Seg3 => LINE[k],
        SegmentKind::Tri3 | SegmentKind::Tri6 => TRIANGLE[k],
        SegmentKind::Quad4 | SegmentKind::Quad8 | SegmentKind::Quad9 => SQUARE[k],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mortar::centre::Centres;

    const KINDS: [SegmentKind; 7] = [
        SegmentKind::Seg2,
        SegmentKind::Seg3,
        SegmentKind::Tri3,
        SegmentKind::Tri6,
        SegmentKind::Quad4,
        SegmentKind::Quad8,
        SegmentKind::Quad9,
    ];

    #[test]
    fn corners_of_facets_are_nodes_of_their_faces_and_facets_cover_them() {
        for kind in KINDS {
            let d: u8 = if matches!(kind, SegmentKind::Seg2 | SegmentKind::Seg3) { 1 } else { 2 };
            let face = Segment { kind, nodes: (0..kind.nodes()).collect() };
            let x: Vec<[f64; 3]> =
                face.nodes.iter().map(|&k| [node_at(kind, k)[0], node_at(kind, k)[1], 0.0]).collect();
            let mut share = 0.0;
            let mut x = x;
            let middle = Centres::new(x.len()).add(&face, &mut x);
            for facet in facets(&face, middle, &x) {
                for (corner, &k) in facet.corners.iter().enumerate() {
                    let at = facet.face.at(&node_at(facet.kind, corner));
                    assert!(
                        (0..usize::from(d)).all(|i| (at[i] - node_at(kind, k)[i]).abs() < 1e-15),
                        "{kind} {corner}"
                    );
                    let Some(values) = facet.functions.get(k) else { continue };
                    (0..facet.nodes.len()).for_each(|c| {
                        assert!(
                            (values[c] - if c == corner { 1.0 } else { 0.0 }).abs() < 1e-15,
                            "{kind} {values:?}"
                        );
                    });
                }
                let size = if facet.kind == SegmentKind::Tri3 { 0.5 } else { 2.0f64.powi(d.into()) };
                let [[a, b], [c, e]] = facet.face.along;
                share += size * (a * e - b * c);
            }
            let whole = if matches!(kind, SegmentKind::Tri3 | SegmentKind::Tri6) {
                0.5
            } else {
                2.0f64.powi(d.into())
            };
            assert!((share - whole).abs() < 1e-14, "{kind}: {share} of {whole}");
        }
    }
}
