//! Local geometry of a segment at one point.

use crate::search::patch::Patch;
use crate::vector::{add, axpy, cross, dot, perpendicular, solve_tangential, unit};

/// Position, base vectors and derived quantities.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local<const D: usize> {
    /// Position \[m\].
    pub point: [f64; D],
    /// Base vectors e_m; the second is zero in two dimensions.
    pub e: [[f64; D]; 2],
    /// Second derivatives e_1,1, e_1,2, e_2,2.
    pub curvature: [[f64; D]; 3],
    /// Outward unit normal.
    pub n: [f64; D],
    /// Orthonormal tangents a_1 = e_1/|e_1|, a_2 = n × a_1 (zero in two dimensions).
    pub frame: [[f64; D]; 2],
}

impl<const D: usize> Local<D> {
    #[inline]
    pub(super) fn new(patch: &Patch<D>) -> Self {
        let n = unit(&perpendicular(&patch.e));
        let a1 = unit(&patch.e[0]);
        Self { point: patch.point, e: patch.e, curvature: patch.curvature, n, frame: [a1, cross(&n, &a1)] }
    }

    /// Metric C_11, C_12, C_22.
    #[inline]
    pub(super) fn metric(&self) -> [f64; 3] {
        [dot(&self.e[0], &self.e[0]), dot(&self.e[0], &self.e[1]), dot(&self.e[1], &self.e[1])]
    }

    /// Corrected metric `C - g_n b` with b_ml = n·e_m,l.
    #[inline]
    pub(super) fn corrected_metric(&self, gap: f64) -> [f64; 3] {
        let metric = self.metric();
        std::array::from_fn(|k| metric[k] - gap * dot(&self.n, &self.curvature[k]))
    }

    /// Frame of `anchor`, carried to this tangent plane by the smallest rotation from its normal to this one.
    #[inline]
    pub(super) fn carry(&self, anchor: &Self) -> [[f64; D]; 2] {
        let sum = add(&anchor.n, &self.n);
        let beta = 1.0 + dot(&anchor.n, &self.n);
        std::array::from_fn(|j| {
            let mut a = anchor.frame[j];
            let along = dot(&self.n, &a);
            axpy(&mut a, -along / beta, &sum);
            a
        })
    }

    /// Increments of gap and ξ for the relative displacement `slave - Σ N_γ u_γ` and the normal components `n·Σ N_γ,m u_γ`.
    #[inline]
    pub(super) fn rates(&self, gap: f64, relative: &[f64; D], stretch: [f64; 2]) -> (f64, [f64; 2]) {
        let rhs = std::array::from_fn(|m| dot(relative, &self.e[m]) + gap * stretch[m]);
        (dot(&self.n, relative), solve_tangential(D - 1, &self.corrected_metric(gap), &rhs))
    }
}

/// Inverse of the symmetric matrix `[a_11, a_12, a_22]` of size D - 1.
#[inline]
pub(super) fn inverse<const D: usize>(a: &[f64; 3]) -> [f64; 3] {
    if D == 2 {
        return [a[0].recip(), 0.0, 0.0];
    }
    let det = (a[0] * a[2] - a[1] * a[1]).recip();
    [a[2] * det, -a[1] * det, a[0] * det]
}
