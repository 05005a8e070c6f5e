//! Normals of slave points in finite sliding.
//!
//! On faces of second order the normal of point A is that of its function, `n_A = Σ_k c_Ak (e_1 × e_2)_k` with the normals at the
//! nodes k of each adjacent face, which have the length of the Jacobian, and `c_Ak = ∫ψ_A N_k dξ` over the natural coordinates of
//! the face. This is `∫ψ_A n dA` where the Jacobian is in the span of the functions of the face, as on lines of three and triangles
//! of six nodes. A motion along the surface's own normals is then, on average, along n_A. The normal at the node encloses with it an
//! angle of the curvature times the distance of the node from the centre of its function, which on unequal faces is a share of
//! their size. Points would slip by that share of what their surfaces approach each other.
//!
//! On faces of first order it is the normal at the node, which differs from that of the function only where faces are warped.
//!
//! In small sliding, where overlaps are constant, the normal is the integral over them (`small`).

use super::facet::node_at;
use super::sides::{AdjacentFace, Sides, bases_of};
use crate::shape::{MOST_NODES, shape};
use crate::vector::{axpy, cross, perpendicular, scaled};

/// Change of a sum of normals with a displacement of a node: `u × arm` in space, the slope times the displacement turned in the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arm<const D: usize> {
    arm: [f64; D],
    slope: f64,
}

impl<const D: usize> Arm<D> {
    /// Change for a unit displacement along an axis.
    #[inline]
    pub(super) fn change(&self, axis: usize) -> [f64; D] {
        let mut unit = [0.0; D];
        unit[axis] = 1.0;
        if D == 2 { scaled(&perpendicular(&[unit, unit]), self.slope) } else { cross(&unit, &self.arm) }
    }
}

impl<const D: usize> Sides<D> {
    /// Sum of the outward normals of the faces adjacent to slave point `p`, each weighted with its Jacobian.
    #[inline]
    pub(super) fn normal_sum(&self, p: usize, x: &[[f64; D]]) -> [f64; D] {
        let mut sum = [0.0; D];
        for b in &self.around[p] {
            let face = &self.faces[b.face];
            for (k, share) in b.shares() {
                let e = bases_of(&shape(face.kind, node_at(face.kind, k)), &face.nodes, x);
                axpy(&mut sum, share, &perpendicular(&e));
            }
        }
        sum
    }

    /// Changes of the part of an adjacent face in that sum with the displacements of the nodes of the face.
    pub(super) fn arms(&self, b: &AdjacentFace, x: &[[f64; D]]) -> [Arm<D>; MOST_NODES] {
        let face = &self.faces[b.face];
        let mut out = [Arm { arm: [0.0; D], slope: 0.0 }; MOST_NODES];
        for (k, share) in b.shares() {
            let s = shape(face.kind, node_at(face.kind, k));
            let e = bases_of(&s, &face.nodes, x);
            for (l, Arm { arm, slope }) in out.iter_mut().enumerate().take(face.nodes.len()) {
                *slope += share * s.first[0][l];
                axpy(arm, share * s.first[0][l], &e[1]);
                axpy(arm, -share * s.first[1][l], &e[0]);
            }
        }
        out
    }
}
