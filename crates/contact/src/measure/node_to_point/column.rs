//! Derivatives of a tracked point's force in the direction of single nodal displacements.

use super::finite::frame_of;
use crate::measure::{Geometry, NormalPoint, ShearPoint};
use crate::search::project::{curvature, gather, interpolate};
use crate::shape::{MOST_NODES, Shape, shape};
use crate::spec::Segment;
use crate::vector::{add, axpy, cross, dot, norm, scaled, solve_tangential, sub};

/// Local geometry of a segment at one point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local<const D: usize> {
    pub shape: Shape,
    /// Position \[m\].
    pub point: [f64; D],
    /// Base vectors e_m; the second is zero in two dimensions.
    pub e: [[f64; D]; 2],
    /// e_1,1, e_1,2, e_2,2.
    pub curvature: [[f64; D]; 3],
    /// Outward unit normal.
    pub n: [f64; D],
    /// Orthonormal tangents.
    pub frame: [[f64; D]; 2],
    /// C_11, C_12, C_22.
    metric: [f64; 3],
}

impl<const D: usize> Local<D> {
    pub(super) fn new(segment: &Segment, positions: &[[f64; D]], xi: [f64; 2]) -> Self {
        let shape = shape(segment.kind, xi);
        let mut buffer = [[0.0; D]; MOST_NODES];
        let x = gather(&segment.nodes, |n| positions[n], &mut buffer);
        let (point, e) = interpolate(&shape, x);
        let (n, frame) = frame_of(&e);
        let metric = [dot(&e[0], &e[0]), dot(&e[0], &e[1]), dot(&e[1], &e[1])];
        Self { shape, point, e, curvature: curvature(&shape, x), n, frame, metric }
    }

    /// The frame of `anchor`, carried to this tangent plane by the smallest rotation from its normal to this one.
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

    /// `C - g_n b`.
    fn corrected_metric(&self, gap: f64) -> [f64; 3] {
        std::array::from_fn(|k| self.metric[k] - gap * dot(&self.n, &self.curvature[k]))
    }

    /// Increments of gap and ξ for increments of the slave and the master nodes.
    pub(super) fn rates(
        &self,
        gap: f64,
        slave: &[f64; D],
        nodes: &[usize],
        du: &[[f64; D]],
    ) -> (f64, [f64; 2]) {
        let mut relative = *slave;
        let mut stretch = [0.0; 2];
        for (k, &node) in nodes.iter().enumerate() {
            axpy(&mut relative, -self.shape.value[k], &du[node]);
            let along = dot(&self.n, &du[node]);
            stretch[0] += self.shape.first[0][k] * along;
            stretch[1] += self.shape.first[1][k] * along;
        }
        let rhs = std::array::from_fn(|m| dot(&relative, &self.e[m]) + gap * stretch[m]);
        (dot(&self.n, &relative), solve_tangential(D - 1, &self.corrected_metric(gap), &rhs))
    }

    /// δn = -(n·δe_m) e^m.
    fn normal_rate(&self, de: &[[f64; D]; 2]) -> [f64; D] {
        let c = [-dot(&self.n, &de[0]), -dot(&self.n, &de[1])];
        let c = solve_tangential(D - 1, &self.metric, &c);
        let mut dn = scaled(&self.e[0], c[0]);
        axpy(&mut dn, c[1], &self.e[1]);
        dn
    }
}

/// A closed point with everything its derivatives need.
pub(super) struct Column<'a, const D: usize> {
    here: &'a Local<D>,
    there: &'a Local<D>,
    frame: [[f64; D]; 2],
    /// x_c - x_a.
    d: [f64; D],
    gap: f64,
    matrix: [f64; 3],
    normal: &'a NormalPoint,
    shear: Option<&'a ShearPoint>,
    stiffness: f64,
    /// Force per area on the slave.
    pub force: [f64; D],
}

impl<'a, const D: usize> Column<'a, D> {
    pub(super) fn new(
        here: &'a Local<D>,
        there: &'a Local<D>,
        geometry: &Geometry<D>,
        p: usize,
        normal: &'a NormalPoint,
        shear: Option<&'a ShearPoint>,
        stiffness: f64,
    ) -> Self {
        let gap = geometry.gap[p];
        let mut force = scaled(&here.n, normal.traction);
        if let Some(s) = shear {
            axpy(&mut force, -1.0, &geometry.tangential(p, &s.traction));
        }
        let matrix = here.corrected_metric(gap);
        let d = sub(&here.point, &there.point);
        Self { here, there, frame: geometry.frame[p], d, gap, matrix, normal, shear, stiffness, force }
    }

    /// δf and δξ for a unit displacement along axis `i` of one node: the slave, or the node with local number `gamma` on the
    /// held segment and `alpha` on the anchor's.
    pub(super) fn derivative(
        &self,
        slave: bool,
        gamma: Option<usize>,
        alpha: Option<usize>,
        i: usize,
    ) -> ([f64; D], [f64; 2]) {
        let (here, n) = (self.here, &self.here.n);
        let weight = gamma.map_or(0.0, |g| here.shape.value[g]);
        let slope = gamma.map_or([0.0; 2], |g| [here.shape.first[0][g], here.shape.first[1][g]]);
        let relative = f64::from(u8::from(slave)) - weight;
        let rhs = std::array::from_fn(|m| relative * here.e[m][i] + self.gap * n[i] * slope[m]);
        let dxi = solve_tangential(D - 1, &self.matrix, &rhs);
        let mut de = [[0.0; D]; 2];
        for m in 0..2 {
            de[m][i] = slope[m];
            axpy(&mut de[m], dxi[0], &here.curvature[m]);
            axpy(&mut de[m], dxi[1], &here.curvature[m + 1]);
        }
        let dn = here.normal_rate(&de);
        let df_n = -self.normal.stiffness * relative * n[i];
        let mut df = scaled(n, df_n);
        axpy(&mut df, self.normal.traction, &dn);
        if let Some(shear) = self.shear {
            let mut dx = scaled(&here.e[0], dxi[0]);
            axpy(&mut dx, dxi[1], &here.e[1]);
            dx[i] += weight - alpha.map_or(0.0, |a| self.there.shape.value[a]);
            axpy(&mut df, -1.0, &self.shear_derivative(shear, &dn, df_n, &dx, alpha, i));
        }
        (df, dxi)
    }

    /// δt, with `dx = δ(x_c - x_a)`.
    fn shear_derivative(
        &self,
        shear: &ShearPoint,
        dn: &[f64; D],
        df_n: f64,
        dx: &[f64; D],
        alpha: Option<usize>,
        i: usize,
    ) -> [f64; D] {
        let da = self.frame_derivative(dn, alpha, i);
        let eta = &shear.direction;
        let trial: [f64; 2] =
            std::array::from_fn(|j| self.stiffness * (dot(&da[j], &self.d) + dot(&self.frame[j], dx)));
        let along = dot(eta, &trial);
        let radial = (shear.d_trial - shear.ratio) * along + shear.d_normal * df_n;
        let mut dt = [0.0; D];
        for j in 0..2 {
            axpy(&mut dt, shear.ratio * trial[j] + radial * eta[j], &self.frame[j]);
            axpy(&mut dt, shear.traction[j], &da[j]);
        }
        dt
    }

    /// δa', the derivative of the carried frame.
    fn frame_derivative(&self, dn: &[f64; D], alpha: Option<usize>, i: usize) -> [[f64; D]; 2] {
        let there = self.there;
        let (na, n) = (&there.n, &self.here.n);
        let mut de = [[0.0; D]; 2];
        if let Some(a) = alpha {
            de[0][i] = there.shape.first[0][a];
            de[1][i] = there.shape.first[1][a];
        }
        let dna = there.normal_rate(&de);
        let mut da1 = de[0];
        axpy(&mut da1, -dot(&de[0], &there.frame[0]), &there.frame[0]);
        let da1 = scaled(&da1, norm(&there.e[0]).recip());
        let da = [da1, add(&cross(&dna, &there.frame[0]), &cross(na, &da1))];
        let (sum, dsum) = (add(na, n), add(&dna, dn));
        let beta = 1.0 + dot(na, n);
        let dbeta = dot(&dna, n) + dot(na, dn);
        std::array::from_fn(|j| {
            let a = &there.frame[j];
            let along = dot(n, a);
            let dalong = dot(dn, a) + dot(n, &da[j]);
            let mut out = da[j];
            axpy(&mut out, -(dalong - along * dbeta / beta) / beta, &sum);
            axpy(&mut out, -along / beta, &dsum);
            out
        })
    }
}
