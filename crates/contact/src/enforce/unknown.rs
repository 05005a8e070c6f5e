//! Multipliers as unknowns of the system, beside the displacements.
//!
//! Each slave point has one unknown χ along the normal and, with a law, D - 1 in the tangent plane; `λ = λ_0 + s (χ - χ_0)`,
//! λ_0 and χ_0 those of the last commit and s a stiffness that makes χ a length of the size of displacements. The bodies feel λ,
//! and the equation of a point is the return of its traction,
//!
//! `w c_n (f_n - λ_n) = 0`, `f_n = <λ_n - E_n g_n>`, and `w c_t (t - λ_t) = 0`, t the answer of the law to `λ_t + E_t Δu`
//!
//! (Alart and Curnier 1991): `g_n = 0` where the point is closed, `λ = 0` where it is open, `Δu = 0` in stick, the law in slip.
//! The scales c give every branch its natural size: s/E where a motion must vanish (closed, stick, laws without an elastic
//! domain), 1 where a traction must (open, slip on a yield surface). The penalties do not enter the solution, and where a point is
//! closed and sticks not even the tangent: they only tell on which side of a kink an iterate is. Newton's method is semi-smooth and
//! ends quadratically.
//!
//! With a the area, s_k the weights of the nodes, a_m the tangents, `∂t = Y (s δχ_t + E_t ∇Δu δu) + η t_n δf_n`,
//! `Y = ratio (I - η⊗η) + d_trial η⊗η`, the block of a point in (u, χ_n, χ_t) is
//!
//! ```text
//! | G                                   -a s_k s n       a s_k s a_m      |
//! | -w s ∇g                             0                0                |   closed
//! | w c_t (E_t Y ∇Δu - E_n t_n η ∇g)    w c_t s t_n η    w c_t s (Y - I)  |
//! ```
//!
//! and `-w s` on the diagonal of an open point. G is what the motion of forces with the geometry adds: nothing in small
//! sliding. The gradients ∇g and ∇Δu are read off the tangent of the measure for unit stiffness without traction, which has
//! `a s_k (n⊗∇g + a_m⊗∇Δu_m)` in the rows of node k.
//!
//! Two points may hold the same motion, or one that is prescribed on both sides (a corner on a plane of symmetry): the
//! zero diagonals would then make the system singular, though a solution exists. They are [`REGULAR`] w s instead, in the
//! tangent and not in the equations, so that the solution is untouched and an iterate is off by that share.
//!
//! Alart, P. and Curnier, A. (1991), A mixed formulation for frictional contact problems prone to Newton like solution methods,
//! Computer Methods in Applied Mechanics and Engineering 92, 353-375.

use super::Multipliers;
use crate::measure::{Attachment, Measure, NormalPoint, ShearPoint};
use asperity_fem::term::{Blocks, Pattern, PatternId};

/// Diagonal of a held point over w s. The square root of rounding: an iteration is off by 1e-8 of the correction before, and a
/// multiplier that nothing determines takes up rounding of gaps times 1e8, that is 1e-8 of the tractions.
pub(crate) const REGULAR: f64 = 1e-8;

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct Unknowns {
    /// First degree of freedom.
    pub(crate) first: usize,
    /// Unknowns of a point.
    pub(crate) each: usize,
    /// s \[Pa/m\].
    pub(crate) unit: f64,
    /// w \[m², m in two dimensions\].
    pub(crate) weights: Vec<f64>,
    /// χ of the last commit, point-major \[m\].
    pub(crate) committed: Vec<f64>,
    /// χ of the last residual.
    pub(crate) present: Vec<f64>,
    /// Blocks of the measure with the unknowns of their points, then the unknowns of points without a block.
    pub(crate) pattern: Pattern,
    /// Pattern of the measure it was made of.
    inner: Option<PatternId>,
    /// Point of each block.
    pub(crate) points: Vec<usize>,
    /// Blocks of the measure.
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
    /// Places of the attachments in a block.
    pub(crate) places: Vec<usize>,
    /// ∇g, ∇Δu_1, ∇Δu_2 one after another.
    pub(crate) rows: Vec<f64>,
}

impl Unknowns {
    /// Unknowns of points with these areas, numbered from `first`.
    pub(crate) fn new(first: usize, each: usize, unit: f64, areas: &[f64]) -> Self {
        // A point that faces nothing has no area, and an equation all the same.
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

    /// Follows the pattern of the measure.
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

    /// Multipliers at the system vector `u`, about those of the last commit.
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

    /// Tangential multiplier `m` of point `p`, also where there is no law at present.
    pub(crate) fn tangential(&self, p: usize, m: usize, multipliers: &Multipliers) -> f64 {
        let k = p * self.each + 1 + m;
        multipliers.shear.get(p).map_or_else(|| self.unit * (self.present[k] - self.committed[k]), |l| l[m])
    }
}
