//! The tangent block of one tracked point.
//!
//! A displacement δu of node k enters through few scalars. These are its weight N_k and slopes N_k,m on the held segment, the
//! same on the anchor's segment (v_k, v_k,m), and w_k = 1 for the slave, -N_k for master nodes. With the inverse a of
//! `A = C - g_n b`, dual vectors e^m, and f the force per area,
//!
//! `δξ_m = w a_ml e_l·δu + g_n a_ml N_k,l n·δu`, `δn = -e^m (N_k,m n·δu + b_ml δξ_l)`, `δf_n = -E_n w n·δu`,
//! `δt = Y δ(x_c - x_a) + G δn + anchor terms + d_normal δf_n η`,
//!
//! so that `δf = [w J + (N_k,m r_m) ⊗ n - (N_k - v_k) Y - v_k,m h_m ⊗ n_a - v_k,1 h ⊗ a_2] δu`. The matrices and vectors depend
//! on the point alone, so the cost of a block is that of its entries.

use super::local::{Local, inverse};
use crate::measure::{NormalPoint, ShearPoint};
use crate::search::surface::Weights;
use crate::vector::{add, axpy, dot, norm, scaled, sub};

/// Quantities of a point that do not depend on the displaced node.
pub(super) struct Kernel<const D: usize> {
    n: [f64; D],
    force: [f64; D],
    /// Products a_ml e_l.
    dxi: [[f64; D]; 2],
    /// Products g_n a_11, g_n a_12, g_n a_22.
    spread: [f64; 3],
    /// Matrix J.
    relative: [[f64; D]; D],
    /// Vectors r_m.
    slope: [[f64; D]; 2],
    drag: Option<Drag<D>>,
}

/// Contribution of friction through the anchor.
struct Drag<const D: usize> {
    /// Matrix Y.
    chord: [[f64; D]; D],
    /// Vectors n_a and a_2 of the anchor.
    anchor: [[f64; D]; 2],
    /// Vectors h_m.
    turn: [[f64; D]; 2],
    /// Vector h.
    twist: [f64; D],
}

/// Weights of the nodes of a block; the slave is node 0.
pub(super) struct Columns<const K: usize> {
    pub value: [f64; K],
    pub first: [[f64; K]; 2],
    pub anchor_value: [f64; K],
    pub anchor_first: [[f64; K]; 2],
}

impl<const K: usize> Columns<K> {
    pub(super) fn zero() -> Self {
        Self { value: [0.0; K], first: [[0.0; K]; 2], anchor_value: [0.0; K], anchor_first: [[0.0; K]; 2] }
    }
}

/// Frictional state of a point.
pub(super) struct Friction<'a, const D: usize> {
    pub point: &'a ShearPoint,
    /// Tangential penalty E_t \[Pa/m\].
    pub stiffness: f64,
    /// Geometry at the anchor.
    pub there: &'a Local<D>,
    /// The carried frame.
    pub frame: &'a [[f64; D]; 2],
}

/// Products m_ml v_l of a symmetric matrix, given by its entries 11, 12 and 22, with two vectors.
#[inline]
fn both<const D: usize>(m: [f64; 3], v: &[[f64; D]; 2]) -> [[f64; D]; 2] {
    let mut out = [scaled(&v[0], m[0]), scaled(&v[0], m[1])];
    axpy(&mut out[0], m[1], &v[1]);
    axpy(&mut out[1], m[2], &v[1]);
    out
}

impl<const D: usize> Kernel<D> {
    pub(super) fn new(
        here: &Local<D>,
        gap: f64,
        normal: &NormalPoint,
        friction: Option<Friction<'_, D>>,
    ) -> Self {
        let n = here.n;
        let a = inverse::<D>(&here.corrected_metric(gap));
        let c = inverse::<D>(&here.metric());
        let dual = both(c, &here.e);
        let b: [f64; 3] = std::array::from_fn(|k| dot(&n, &here.curvature[k]));
        let bend = both(b, &dual);
        let dxi = both(a, &here.e);
        let spread = scaled(&a, gap);
        let mut force = scaled(&n, normal.traction);
        // Z e^m and Z B_l, with Z = f_n I - G; U_l = -(Z B_l + Y e_l); q = n - d_normal η.
        let mut z_dual = dual.map(|v| scaled(&v, normal.traction));
        let mut u = bend.map(|v| scaled(&v, -normal.traction));
        let mut q = n;
        let drag = friction.map(|f| {
            let drag = Slide::new(here, &f);
            for j in 0..2 {
                axpy(&mut force, -f.point.traction[j], &f.frame[j]);
                axpy(&mut q, -f.point.d_normal * f.point.direction[j], &f.frame[j]);
            }
            for m in 0..2 {
                axpy(&mut z_dual[m], -1.0, &drag.turned(&dual[m]));
                axpy(&mut u[m], 1.0, &drag.turned(&bend[m]));
                axpy(&mut u[m], -1.0, &times(&drag.chord, &here.e[m]));
            }
            drag.on_anchor()
        });
        let mut relative = [[0.0; D]; D];
        for i in 0..D {
            axpy(&mut relative[i], -normal.stiffness * q[i], &n);
            for l in 0..2 {
                axpy(&mut relative[i], u[l][i], &dxi[l]);
            }
        }
        let mut slope = both(spread, &u);
        for m in 0..2 {
            axpy(&mut slope[m], -1.0, &z_dual[m]);
        }
        Self { n, force, dxi, spread, relative, slope, drag }
    }

    /// Derivatives ∂f/∂u_k and ∂ξ_m/∂u_k.
    #[inline]
    fn column<const K: usize>(&self, c: &Columns<K>, k: usize) -> ([[f64; D]; D], [[f64; D]; 2]) {
        let w = if k == 0 { 1.0 } else { -c.value[k] };
        let s = [c.first[0][k], c.first[1][k]];
        let mut r = scaled(&self.slope[0], s[0]);
        axpy(&mut r, s[1], &self.slope[1]);
        let mut df: [[f64; D]; D] = std::array::from_fn(|i| {
            let mut row = scaled(&self.relative[i], w);
            axpy(&mut row, r[i], &self.n);
            row
        });
        if let Some(drag) = &self.drag {
            let along = c.anchor_value[k] - c.value[k];
            let t = [c.anchor_first[0][k], c.anchor_first[1][k]];
            let mut turn = scaled(&drag.turn[0], t[0]);
            axpy(&mut turn, t[1], &drag.turn[1]);
            for i in 0..D {
                axpy(&mut df[i], along, &drag.chord[i]);
                axpy(&mut df[i], -turn[i], &drag.anchor[0]);
                axpy(&mut df[i], -t[0] * drag.twist[i], &drag.anchor[1]);
            }
        }
        let g =
            [self.spread[0] * s[0] + self.spread[1] * s[1], self.spread[1] * s[0] + self.spread[2] * s[1]];
        let dxi = std::array::from_fn(|m| {
            let mut v = scaled(&self.dxi[m], w);
            axpy(&mut v, g[m], &self.n);
            v
        });
        (df, dxi)
    }

    /// Writes the block of `nodes` nodes. `rows` are the positions of the held segment's nodes in it, with their weights.
    pub(super) fn write<const M: usize, const K: usize>(
        &self,
        area: f64,
        nodes: usize,
        columns: &Columns<K>,
        rows: &[usize],
        weights: &Weights<M>,
        block: &mut [f64],
    ) {
        let size = nodes * D;
        if rows.len() + 1 < nodes {
            block.fill(0.0);
        }
        for k in 0..nodes {
            let (df, dxi) = self.column(columns, k);
            for i in 0..D {
                let to = &mut block[i * size + k * D..][..D];
                for (t, v) in to.iter_mut().zip(&df[i]) {
                    *t = -area * v;
                }
            }
            for (g, &row) in rows.iter().enumerate() {
                let value = area * weights.value[g];
                let mut moved = scaled(&dxi[0], area * weights.first[0][g]);
                axpy(&mut moved, area * weights.first[1][g], &dxi[1]);
                for i in 0..D {
                    let to = &mut block[(row * D + i) * size + k * D..][..D];
                    for j in 0..D {
                        to[j] = value * df[i][j] + self.force[i] * moved[j];
                    }
                }
            }
        }
    }
}

/// Derivatives of the shear traction: `δt = Y δx + Σ_j L_j δa'_j + ...` with `L_j = V_j ⊗ d + t_j I`.
struct Slide<'a, const D: usize> {
    here: &'a Local<D>,
    there: &'a Local<D>,
    t: [f64; 2],
    /// Vectors V_k = Σ_j a'_j m_jk.
    v: [[f64; D]; 2],
    /// Matrix Y = Σ_k V_k ⊗ a'_k.
    chord: [[f64; D]; D],
    /// Chord d = x_c - x_a.
    d: [f64; D],
    /// Vector n_a + n, and β = 1 + n_a·n in `beta`.
    sum: [f64; D],
    beta: f64,
    /// Products n·a_j/β.
    lean: [f64; 2],
}

impl<'a, const D: usize> Slide<'a, D> {
    fn new(here: &'a Local<D>, f: &Friction<'a, D>) -> Self {
        let (p, there) = (f.point, f.there);
        let m = |j: usize, k: usize| {
            let same = if j == k { p.ratio } else { 0.0 };
            f.stiffness * (same + (p.d_trial - p.ratio) * p.direction[j] * p.direction[k])
        };
        let v: [[f64; D]; 2] = std::array::from_fn(|k| {
            let mut v = scaled(&f.frame[0], m(0, k));
            axpy(&mut v, m(1, k), &f.frame[1]);
            v
        });
        let mut chord = [[0.0; D]; D];
        for i in 0..D {
            axpy(&mut chord[i], v[0][i], &f.frame[0]);
            axpy(&mut chord[i], v[1][i], &f.frame[1]);
        }
        let beta = 1.0 + dot(&there.n, &here.n);
        Self {
            here,
            there,
            t: p.traction,
            v,
            chord,
            d: sub(&here.point, &there.point),
            sum: add(&there.n, &here.n),
            beta,
            lean: std::array::from_fn(|j| dot(&here.n, &there.frame[j]) / beta),
        }
    }

    /// Product G x = Σ_j L_j G_j x with `G_j = -(n_a + n) ⊗ (a_j - lean_j n_a)/β - lean_j I`.
    fn turned(&self, x: &[f64; D]) -> [f64; D] {
        let mut out = [0.0; D];
        for j in 0..2 {
            let along = dot(x, &self.there.frame[j]) - self.lean[j] * dot(x, &self.there.n);
            let mut y = scaled(&self.sum, -along / self.beta);
            axpy(&mut y, -self.lean[j], x);
            axpy(&mut out, dot(&self.d, &y), &self.v[j]);
            axpy(&mut out, self.t[j], &y);
        }
        out
    }

    /// Product L_j Q x with `Q = I - (n_a + n) ⊗ n/β`.
    fn carried(&self, j: usize, x: &[f64; D]) -> [f64; D] {
        let mut y = *x;
        axpy(&mut y, -dot(&self.here.n, x) / self.beta, &self.sum);
        let mut out = scaled(&y, self.t[j]);
        axpy(&mut out, dot(&self.d, &y), &self.v[j]);
        out
    }

    /// Derivatives with respect to the anchor's base vectors: δn_a = -e_a^m n_a·δe_a,m, δa_1 = (n_a ⊗ n_a + a_2 ⊗ a_2)
    /// δe_a,1/|e_a,1|, δa_2 = -(a_2·δn_a) n_a - (a_2·δa_1) a_1.
    fn on_anchor(self) -> Drag<D> {
        let there = self.there;
        let [a1, a2] = &there.frame;
        let length = norm(&there.e[0]).recip();
        let c = inverse::<D>(&there.metric());
        let dual: [[f64; D]; 2] = std::array::from_fn(|m| {
            let mut v = scaled(&there.e[0], c[m]);
            axpy(&mut v, c[m + 1], &there.e[1]);
            v
        });
        let mut turn = [scaled(&self.carried(0, &there.n), length), [0.0; D]];
        let normal = self.carried(1, &there.n);
        for m in 0..2 {
            axpy(&mut turn[m], dot(&dual[m], a2), &normal);
            for j in 0..2 {
                axpy(&mut turn[m], self.lean[j], &self.carried(j, &dual[m]));
            }
        }
        let mut twist = scaled(&self.carried(0, a2), length);
        axpy(&mut twist, -length, &self.carried(1, a1));
        Drag { chord: self.chord, anchor: [there.n, *a2], turn, twist }
    }
}

/// Product M x.
#[inline]
fn times<const D: usize>(m: &[[f64; D]; D], x: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|i| dot(&m[i], x))
}
