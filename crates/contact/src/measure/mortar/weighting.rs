//! Weighting functions ψ_A that average the gap to slave nodes: a non-negative partition of unity.
//!
//! They are the functions of the corners of facets, linear or bilinear on each. On faces of second order, whose own functions are
//! negative in places, these are the functions of the mesh divided through the mid-nodes. The integral of each is positive, and
//! its coefficient is the value at the node.
//!
//! Any partition of unity transmits a uniform pressure exactly, because `Σ_A ψ_A p = p`. A non-negative one also excludes
//! tensile tractions between the nodes.

use super::facet::{Facet, NODES};
use super::rule::Rule;
use crate::SegmentKind;
use crate::shape::{MOST_NODES, shape};
use crate::spec::Segment;
use crate::vector::axpy;

/// Functions ψ_a = Σ_b c_ab λ_b on one facet, one row for each of its points, of the functions λ_b of its corners.
#[derive(Clone, Debug)]
pub(super) struct Weighting {
    /// Slave point of each row.
    pub points: Vec<usize>,
    rows: Vec<[f64; NODES]>,
    /// True if no corner is without a point.
    pub whole: bool,
}

impl Weighting {
    /// Makes the functions of a facet with these local numbers of its `corners` in a `face`. `point_of` gives the slave point of a
    /// node. The function of a corner without (the tip of a split surface) is divided equally among the points of the others, that of
    /// the middle of a face of eight nodes among those of its mid-nodes.
    pub(super) fn new(face: &Segment, corners: &[usize], point_of: impl Fn(usize) -> Option<usize>) -> Self {
        let mut out = Self { points: Vec::new(), rows: Vec::new(), whole: true };
        let mut orphaned = [0.0; NODES];
        for (b, &corner) in corners.iter().enumerate() {
            let points =
                |nodes: &[usize]| -> Vec<usize> { nodes.iter().filter_map(|&n| point_of(n)).collect() };
            let points =
                points(face.nodes.get(corner).map_or_else(|| &face.nodes[4..], std::slice::from_ref));
            #[expect(clippy::cast_precision_loss, reason = "at most four points")]
            let share = 1.0 / points.len() as f64;
            points.iter().for_each(|&p| out.row(p)[b] = share);
            if points.is_empty() {
                (orphaned[b], out.whole) = (1.0, false);
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "at most six rows")]
        let share = 1.0 / out.rows.len() as f64;
        for row in &mut out.rows {
            row.iter_mut().zip(&orphaned).for_each(|(c, o)| *c += share * o);
        }
        out
    }

    /// Row of a point, added if it has none.
    fn row(&mut self, point: usize) -> &mut [f64; NODES] {
        let a = self.points.iter().position(|&p| p == point).unwrap_or_else(|| {
            self.points.push(point);
            self.rows.push([0.0; NODES]);
            self.rows.len() - 1
        });
        &mut self.rows[a]
    }

    /// Passes to `add` the shares of the tractions of points in an integral of their field `Σ_a ψ_a f_a`, from the integrals with the
    /// functions of the corners.
    pub(super) fn add_shares(&self, with_corners: &[f64; NODES], mut add: impl FnMut(usize, f64)) {
        for (row, &p) in self.rows.iter().zip(&self.points) {
            add(p, row.iter().zip(with_corners).map(|(c, w)| c * w).sum());
        }
    }

    /// Row of a point as a sum of the rows of corners, `add(c_ab, b)`.
    #[inline]
    pub(super) fn sum(&self, row: usize, mut add: impl FnMut(f64, usize)) {
        for (b, &share) in self.rows[row].iter().enumerate().filter(|(_, share)| **share != 0.0) {
            add(share, b);
        }
    }

    /// Integrals of the functions of points times those of the face, over a facet in the natural coordinates of the face, a row for each
    /// point. They are weighted with a `radius`, which depends on the functions of the face.
    pub(super) fn products(
        &self,
        facet: &Facet,
        rule: &Rule,
        radius: impl Fn(&[f64; MOST_NODES]) -> f64,
    ) -> Vec<[f64; MOST_NODES]> {
        let mut with_corners = [[0.0; MOST_NODES]; NODES];
        for (xi, weight) in quadrature(facet.kind, rule) {
            let of_face = shape(facet.face.kind, facet.face.at(&xi)).value;
            let weight = weight * facet.face.scale() * radius(&of_face);
            for (row, corner) in with_corners.iter_mut().zip(shape(facet.kind, xi).value) {
                axpy(row, weight * corner, &of_face);
            }
        }
        let row = |a: usize| {
            let mut out = [0.0; MOST_NODES];
            self.sum(a, |share, b| axpy(&mut out, share, &with_corners[b]));
            out
        };
        (0..self.points.len()).map(row).collect()
    }
}

/// Natural coordinates and weights of a rule on a facet.
fn quadrature(kind: SegmentKind, rule: &Rule) -> Vec<([f64; 2], f64)> {
    let line = || rule.line.iter().map(|[t, w]| (2.0 * t - 1.0, 2.0 * w));
    match kind {
        SegmentKind::Tri3 => rule.triangle.iter().map(|([_, s, t], w)| ([*s, *t], *w)).collect(),
        SegmentKind::Seg2 => line().map(|(s, w)| ([s, 0.0], w)).collect(),
        _ => line().flat_map(|(s, v)| line().map(move |(t, w)| ([s, t], v * w))).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mortar::facet::parts;

    /// Sums of the coefficients of each corner over all points.
    fn sums(w: &Weighting) -> [f64; NODES] {
        let mut out = [0.0; NODES];
        for a in 0..w.points.len() {
            w.sum(a, |c, b| {
                assert!(c > 0.0);
                out[b] += c;
            });
        }
        out
    }

    #[test]
    fn functions_of_corners_without_points_are_divided_among_the_others() {
        let face = Segment { kind: SegmentKind::Quad4, nodes: vec![0, 1, 2, 3] };
        let tipped = Weighting::new(&face, &[0, 1, 2, 3], |k| (k != 1).then_some(k + 10));
        assert_eq!(tipped.points, [10, 12, 13]);
        assert!(!tipped.whole && sums(&tipped).iter().all(|s| (s - 1.0).abs() < 1e-15));
    }

    #[test]
    fn the_function_of_the_middle_of_a_face_is_divided_among_its_mid_nodes() {
        let face = Segment { kind: SegmentKind::Quad8, nodes: (0..8).collect() };
        for (_, corners) in parts(face.kind) {
            let w = Weighting::new(&face, corners, Some);
            assert!(w.whole && w.points.len() == 5 && (4..8).all(|m| w.points.contains(&m)), "{w:?}");
            assert!(sums(&w).iter().all(|s| (s - 1.0).abs() < 1e-15));
        }
    }
}
