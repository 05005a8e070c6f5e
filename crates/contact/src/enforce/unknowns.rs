//! Multipliers as unknowns of the system, in addition to the displacements.
//!
//! Each slave point has one unknown χ along the normal and, with a law, D - 1 in the tangent plane: `λ = λ_0 + s (χ - χ_0)`.
//! λ_0 and χ_0 are those of the last commit. The stiffness s makes χ a length of the size of displacements. λ acts on the
//! bodies. The equation of a point is the return of its traction,
//!
//! `w c_n (f_n - λ_n) = 0`, `f_n = <λ_n - E_n g_n>`, and `w c_t (t - λ_t) = 0`, t the response of the law to `λ_t + E_t Δu`
//!
//! (Alart and Curnier 1991): `g_n = 0` for a closed point, `λ = 0` for an open one, `Δu = 0` in stick, the law in slip. The
//! scales c give every branch its natural size: s/E if a motion must vanish (closed, stick, laws without an elastic domain), 1
//! if a traction must vanish (open, slip on a yield surface). The penalties do not enter the solution, nor the tangent of a
//! closed point that sticks; they only decide on which side of a kink an iterate lies. Newton's method is semi-smooth and
//! converges quadratically in the end.
//!
//! Let a be the area, s_k the weights of the nodes and a_m the tangents, with `∂t = Y (s δχ_t + E_t ∇Δu δu) + η t_n δf_n` and
//! `Y = ratio (I - η⊗η) + d_trial η⊗η`. The block of a point in (u, χ_n, χ_t) is
//!
//! ```text
//! | G                                   -a s_k s n       a s_k s a_m      |
//! | -w s ∇g                             0                0                |   closed
//! | w c_t (E_t Y ∇Δu - E_n t_n η ∇g)    w c_t s t_n η    w c_t s (Y - I)  |
//! ```
//!
//! and has `-w s` on the diagonal of an open point. G is the contribution of forces that move with the geometry; it vanishes in
//! small sliding. The gradients ∇g and ∇Δu are read from the tangent of the measure for unit stiffness and no traction, which
//! has `a s_k (n⊗∇g + a_m⊗∇Δu_m)` in the rows of node k.
//!
//! Two points may constrain the same motion, or a motion that is prescribed on both sides (a corner on a plane of symmetry).
//! The zero diagonals would then make the system singular, though a solution exists. They are replaced by [`REGULAR`] w s, in
//! the tangent but not in the equations. The solution is unchanged; an iterate is off by that share.
//!
//! Alart, P. and Curnier, A. (1991), A mixed formulation for frictional contact problems prone to Newton like solution methods,
//! Computer Methods in Applied Mechanics and Engineering 92, 353-375.

use super::Multipliers;
use crate::measure::{Attachment, Measure, NormalPoint, ShearPoint};
use asperity_fem::term::{Blocks, Pattern, PatternId};

/// Diagonal of a held point over w s, the square root of rounding. An iterate is off by 1e-8 of the preceding correction. An
/// undetermined multiplier picks up the rounding of gaps times 1e8, which is 1e-8 of the tractions.
pub(crate) const REGULAR: f64 = 1e-8;

/// Multipliers of an interface that are unknowns, with the weights of their equations and their tangent blocks. The symbols are
/// those of the module.
#[derive(Clone, Debug)]
pub(crate) struct Unknowns {
    /// First degree of freedom.
    pub(crate) first: usize,
    /// Number of unknowns per point.
    pub(crate) each: usize,
    /// Stiffness s \[Pa/m\].
    pub(crate) unit: f64,
    /// Weights w \[m², m in two dimensions\].
    pub(crate) weights: Vec<f64>,
    /// χ of the last commit, point-major \[m\].
    pub(crate) committed: Vec<f64>,
    /// χ of the last residual \[m\].
    pub(crate) present: Vec<f64>,
    /// Blocks of the measure, each with the unknowns of its point, followed by the unknowns of points without a block.
    pub(crate) pattern: Pattern,
    /// Pattern of the measure from which `pattern` was made.
    inner: Option<PatternId>,
    /// Point of each block.
    pub(crate) points: Vec<usize>,
    /// Number of blocks of the measure.
    pub(crate) blocks: usize,
    pub(crate) buffers: Buffers,
}

/// Working memory of the tangent.
#[derive(Clone, Debug, Default)]
pub(crate) struct Buffers {
    pub(crate) gradients: Vec<f64>,
    pub(crate) geometric: Vec<f64>,
    pub(crate) normal: Vec<NormalPoint>,
    pub(crate) shear: Vec<ShearPoint>,
    pub(crate) areas: Vec<f64>,
    pub(crate) attachments: Vec<Attachment>,
    /// Positions of the attachments in a block.
    pub(crate) places: Vec<usize>,
    /// ∇g, ∇Δu_1, ∇Δu_2 one after another.
    pub(crate) rows: Vec<f64>,
}

impl Unknowns {
    /// Creates the unknowns of points with these areas, numbered from `first`.
    pub(crate) fn new(first: usize, each: usize, unit: f64, areas: &[f64]) -> Self {
        // A point that faces nothing has no area but still needs an equation.
        let facing = areas.iter().filter(|a| **a > 0.0);
        let mean = facing.clone().sum::<f64>() / facing.count().max(1) as f64;
        let n = areas.len();
        Self {
            first,
            each,
            unit,
            weights: areas.iter().map(|&a| if a > 0.0 { a } else { mean }).collect(),
            committed: vec![0.0; n * each],
            present: vec![0.0; n * each],
            pattern: Pattern::default(),
            inner: None,
            points: Vec::new(),
            blocks: 0,
            buffers: Buffers {
                normal: vec![NormalPoint::default(); n],
                shear: vec![ShearPoint::default(); n],
                areas: vec![0.0; n],
                ..Buffers::default()
            },
        }
    }

    /// Rebuilds the blocks if the pattern of the measure has changed, or if `always` is set.
    pub(crate) fn renew<const D: usize>(&mut self, measure: &dyn Measure<D>, always: bool) {
        let inner = measure.pattern();
        if !always && self.inner == Some(inner.id()) {
            return;
        }
        self.points.clear();
        measure.block_points(&mut self.points);
        self.blocks = self.points.len();
        let (first, each) = (self.first, self.each);
        let own = |p: usize| first + p * each..first + (p + 1) * each;
        let mut blocks = Blocks::default();
        for (block, &p) in inner.blocks().zip(&self.points) {
            blocks.push(block.iter().copied().chain(own(p)));
        }
        let mut with = vec![false; self.weights.len()];
        self.points.iter().for_each(|&p| with[p] = true);
        for p in (0..with.len()).filter(|&p| !with[p]) {
            blocks.push(own(p));
            self.points.push(p);
        }
        self.pattern.renew(blocks);
        self.inner = Some(inner.id());
    }

    /// Adds to the multipliers of the last commit their change at the system vector `u`.
    pub(crate) fn read(&mut self, u: &[f64], out: &mut Multipliers) {
        self.present.copy_from_slice(&u[self.first..self.first + self.committed.len()]);
        let growth = |k: usize| self.unit * (self.present[k] - self.committed[k]);
        for (p, l) in out.normal.iter_mut().enumerate() {
            *l += growth(p * self.each);
        }
        if self.each > 1 {
            for (p, l) in out.shear.iter_mut().enumerate() {
                for (m, l) in l.iter_mut().enumerate().take(self.each - 1) {
                    *l += growth(p * self.each + 1 + m);
                }
            }
        }
    }

    /// Tangential multiplier `m` of point `p`; defined also when no law is active.
    pub(crate) fn tangential(&self, p: usize, m: usize, multipliers: &Multipliers) -> f64 {
        let k = p * self.each + 1 + m;
        multipliers.shear.get(p).map_or_else(|| self.unit * (self.present[k] - self.committed[k]), |l| l[m])
    }
}
