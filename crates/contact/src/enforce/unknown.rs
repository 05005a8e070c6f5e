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
use crate::interface::Interface;
use crate::measure::{Attachment, Measure, NormalPoint, ShearPoint, Tractions};
use crate::shear::Shear;
use crate::spec::SurfaceNode;
use asperity_fem::term::Pattern;
use asperity_friction::law::Regime;
use std::ops::Range;

/// Diagonal of a held point over w s. The square root of rounding: an iteration is off by 1e-8 of the correction before, and a
/// multiplier that nothing determines takes up rounding of gaps times 1e8, that is 1e-8 of the tractions.
const REGULAR: f64 = 1e-8;

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct Unknowns {
    /// First degree of freedom.
    first: usize,
    /// Unknowns of a point.
    each: usize,
    /// s \[Pa/m\].
    unit: f64,
    /// w \[m², m in two dimensions\].
    weights: Vec<f64>,
    /// χ of the last commit, point-major \[m\].
    pub committed: Vec<f64>,
    /// χ of the last residual.
    present: Vec<f64>,
    /// Blocks of the measure with the unknowns of their points, then the unknowns of points without a block.
    pub pattern: Pattern,
    /// Point of each block.
    points: Vec<usize>,
    /// Blocks of the measure.
    blocks: usize,
    buffers: Buffers,
}

/// Working memory of the tangent.
#[derive(Clone, Debug, Default)]
struct Buffers {
    gradients: Vec<f64>,
    geometric: Vec<f64>,
    normal: Vec<NormalPoint>,
    shear: Vec<ShearPoint>,
    areas: Vec<f64>,
    attachments: Vec<Attachment>,
    /// Places of the attachments in a block.
    places: Vec<usize>,
    /// ∇g, ∇Δu_1, ∇Δu_2 one after another.
    rows: Vec<f64>,
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
        if !always && inner.version == self.pattern.version {
            return;
        }
        self.points.clear();
        measure.block_points(&mut self.points);
        self.blocks = self.points.len();
        let (first, each) = (self.first, self.each);
        let own = |p: usize| first + p * each..first + (p + 1) * each;
        let mut pattern = Pattern { version: inner.version, starts: vec![0], dofs: Vec::new() };
        let close = |pattern: &mut Pattern| pattern.starts.push(pattern.dofs.len());
        for (block, &p) in inner.blocks().zip(&self.points) {
            pattern.dofs.extend_from_slice(block);
            pattern.dofs.extend(own(p));
            close(&mut pattern);
        }
        let mut with = vec![false; self.weights.len()];
        self.points.iter().for_each(|&p| with[p] = true);
        for p in (0..with.len()).filter(|&p| !with[p]) {
            pattern.dofs.extend(own(p));
            close(&mut pattern);
            self.points.push(p);
        }
        self.pattern = pattern;
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
    fn tangential(&self, p: usize, m: usize, multipliers: &Multipliers) -> f64 {
        let k = p * self.each + 1 + m;
        multipliers.shear.get(p).map_or_else(|| self.unit * (self.present[k] - self.committed[k]), |l| l[m])
    }
}

impl<const D: usize> Interface<D> {
    /// Multipliers at the system vector, where they are unknowns.
    pub(crate) fn read_multipliers(&mut self, u: &[f64]) {
        if self.unknowns.is_some() {
            self.renew_multipliers();
        }
        if let (Some(unknowns), Some(multipliers)) = (&mut self.unknowns, &mut self.multipliers) {
            unknowns.read(u, multipliers);
        }
    }

    /// Makes the multipliers the trial tractions of the closed points: they are what the bodies feel, and do not carry the
    /// rounding of gaps times a large penalty.
    pub(crate) fn adopt_multipliers(&mut self) {
        let (Some(unknowns), Some(multipliers)) = (&mut self.unknowns, &self.multipliers) else { return };
        unknowns.committed.copy_from_slice(&unknowns.present);
        let floor = if self.tied.is_some() { f64::NEG_INFINITY } else { 0.0 };
        for (p, c) in self.contact.trial.iter_mut().enumerate().filter(|(_, c)| c.closed) {
            c.traction = multipliers.normal[p].max(floor);
            if let Some(shear) = &mut self.shear {
                shear.trial.traction[p] = multipliers.shear[p];
            }
        }
    }

    /// Adds the equations of the points.
    pub(crate) fn returns(&self, r: &mut [f64]) {
        let (Some(unknowns), Some(multipliers)) = (&self.unknowns, &self.multipliers) else { return };
        for (p, w) in unknowns.weights.iter().enumerate() {
            let (normal, tangential) = self.scales(p, unknowns.unit);
            let at = unknowns.first + p * unknowns.each;
            r[at] += w * normal * (self.contact.trial[p].traction - multipliers.normal[p]);
            for m in 0..unknowns.each - 1 {
                let t = self.shear.as_ref().map_or(0.0, |s| s.trial.traction[p][m]);
                r[at + 1 + m] += w * tangential * (t - unknowns.tangential(p, m, multipliers));
            }
        }
    }

    /// c_n and c_t of point `p`.
    fn scales(&self, p: usize, unit: f64) -> (f64, f64) {
        if !self.contact.trial[p].closed {
            return (1.0, 1.0);
        }
        let slides = |s: &Shear| s.law.has_elastic_domain() && s.trial.regime[p] == Regime::Slip;
        let held = self.shear.as_ref().is_some_and(|s| !slides(s));
        (unit / self.penalty.stiffness, if held { unit / self.tangential_penalty } else { 1.0 })
    }

    /// Writes the tangent of forces and equations.
    pub(crate) fn mixed_tangent(&mut self, values: &mut [f64]) {
        let Some(mut unknowns) = self.unknowns.take() else { return };
        let mut buffers = std::mem::take(&mut unknowns.buffers);
        self.gradients(&mut buffers);
        self.geometric(&mut buffers);
        self.measure.areas(&mut buffers.areas);
        let (mut at, mut from) = (0, 0);
        for b in 0..unknowns.points.len() {
            let size = unknowns.pattern.starts[b + 1] - unknowns.pattern.starts[b];
            let block = &mut values[at..at + size * size];
            at += block.len();
            block.fill(0.0);
            let n = size - unknowns.each;
            let inner = from..from + n * n;
            from = inner.end;
            self.mixed_block(&unknowns, b, inner, &mut buffers, block);
        }
        unknowns.buffers = buffers;
        self.unknowns = Some(unknowns);
    }

    /// The measure's tangent for unit stiffness without traction, of the closed points.
    fn gradients(&self, buffers: &mut Buffers) {
        for (n, c) in buffers.normal.iter_mut().zip(&self.contact.trial) {
            *n = NormalPoint { closed: c.closed, traction: 0.0, stiffness: 1.0 };
        }
        buffers.shear.fill(ShearPoint { ratio: 1.0, d_trial: 1.0, ..ShearPoint::default() });
        buffers.gradients.clear();
        buffers.gradients.resize(self.measure.pattern().values(), 0.0);
        let shear = self.shear.as_ref().map(|_| buffers.shear.as_slice());
        let tractions = Tractions { normal: &buffers.normal, shear, stiffness: 1.0 };
        self.measure.tangent(&self.geometry, tractions, &mut buffers.gradients);
    }

    /// The measure's tangent for the multipliers as tractions without stiffness, where forces follow the motion.
    fn geometric(&self, buffers: &mut Buffers) {
        buffers.geometric.clear();
        let (true, Some(multipliers)) = (self.measure.follows(), &self.multipliers) else { return };
        for (p, n) in buffers.normal.iter_mut().enumerate() {
            let closed = self.geometry.paired[p];
            *n = NormalPoint { closed, traction: multipliers.normal[p], stiffness: 0.0 };
        }
        for (s, l) in buffers.shear.iter_mut().zip(&multipliers.shear) {
            *s = ShearPoint { traction: *l, ..ShearPoint::default() };
        }
        buffers.geometric.resize(buffers.gradients.len(), 0.0);
        let shear = self.shear.as_ref().map(|_| buffers.shear.as_slice());
        let tractions = Tractions { normal: &buffers.normal, shear, stiffness: 0.0 };
        self.measure.tangent(&self.geometry, tractions, &mut buffers.geometric);
    }

    /// Block `b`; `inner` is the range of its displacements' part among the values of the measure.
    fn mixed_block(
        &self,
        unknowns: &Unknowns,
        b: usize,
        inner: Range<usize>,
        buffers: &mut Buffers,
        block: &mut [f64],
    ) {
        let (p, each) = (unknowns.points[b], unknowns.each);
        let dofs = &unknowns.pattern.dofs[unknowns.pattern.starts[b]..unknowns.pattern.starts[b + 1]];
        let (size, n) = (dofs.len(), dofs.len() - each);
        if b < unknowns.blocks {
            self.measure.attachments(p, &mut buffers.attachments);
            place::<D>(&self.nodes, &dofs[..n], buffers);
            if !buffers.geometric.is_empty() {
                for (to, from) in
                    block.chunks_exact_mut(size).zip(buffers.geometric[inner.clone()].chunks_exact(n))
                {
                    to[..n].copy_from_slice(from);
                }
            }
            self.columns(unknowns, p, n, buffers, block);
        }
        if self.contact.trial[p].closed && b < unknowns.blocks && !buffers.attachments.is_empty() {
            self.read_gradients(p, &inner, n, buffers);
            self.closed_rows(unknowns, p, n, &buffers.rows, block);
        } else {
            for m in n..n + each {
                block[m * size + m] = -unknowns.weights[p] * unknowns.unit;
            }
        }
    }

    /// What the multipliers exert on the nodes.
    fn columns(&self, unknowns: &Unknowns, p: usize, n: usize, buffers: &Buffers, block: &mut [f64]) {
        let size = n + unknowns.each;
        let (normal, frame) = (&self.geometry.normal[p], &self.geometry.frame[p]);
        let tangents = if self.shear.is_some() { unknowns.each - 1 } else { 0 };
        for (a, place) in buffers.attachments.iter().zip(&buffers.places) {
            let c = buffers.areas[p] * unknowns.unit * a.weight;
            for i in 0..D {
                let row = (place * D + i) * size + n;
                block[row] -= c * normal[i];
                for (m, e) in frame.iter().enumerate().take(tangents) {
                    block[row + 1 + m] += c * e[i];
                }
            }
        }
    }

    /// ∇g and ∇Δu from the rows of the node with the largest weight.
    fn read_gradients(&self, p: usize, inner: &Range<usize>, n: usize, buffers: &mut Buffers) {
        let mut best = (0, 0.0_f64);
        for (a, &place) in buffers.attachments.iter().zip(&buffers.places) {
            if a.weight.abs() > best.1.abs() {
                best = (place, a.weight);
            }
        }
        let scale = (buffers.areas[p] * best.1).recip();
        let values = &buffers.gradients[inner.clone()];
        let rows = &values[best.0 * D * n..(best.0 + 1) * D * n];
        let frame = &self.geometry.frame[p];
        buffers.rows.clear();
        for v in [&self.geometry.normal[p], &frame[0], &frame[1]] {
            buffers.rows.extend((0..n).map(|j| scale * (0..D).map(|i| v[i] * rows[i * n + j]).sum::<f64>()));
        }
    }

    /// The equations of a closed point.
    fn closed_rows(&self, unknowns: &Unknowns, p: usize, n: usize, gradients: &[f64], block: &mut [f64]) {
        let size = n + unknowns.each;
        let (e_n, e_t, s) = (self.penalty.stiffness, self.tangential_penalty, unknowns.unit);
        let (w, ws) = (unknowns.weights[p], unknowns.weights[p] * s);
        let c = w * self.scales(p, s).1;
        let (gap, slides) = gradients.split_at(n);
        for (to, g) in block[n * size..].iter_mut().zip(gap) {
            *to = -ws * g;
        }
        block[n * size + n] = -REGULAR * ws;
        let tangents = unknowns.each - 1;
        for m in 0..tangents {
            let row = &mut block[(n + 1 + m) * size..][..size];
            let Some(point) = self.shear.as_ref().map(|s| &s.points[p]) else {
                row[n + 1 + m] = -c * s;
                continue;
            };
            let eta = &point.direction;
            for l in 0..tangents {
                let same = f64::from(u8::from(l == m));
                let y = point.ratio * same + (point.d_trial - point.ratio) * eta[m] * eta[l];
                for (to, d) in row.iter_mut().zip(&slides[l * n..(l + 1) * n]) {
                    *to += c * e_t * y * d;
                }
                row[n + 1 + l] = c * s * (y - same) - REGULAR * ws * same;
            }
            let coupling = c * point.d_normal * eta[m];
            for (to, g) in row.iter_mut().zip(gap) {
                *to -= coupling * e_n * g;
            }
            row[n] = coupling * s;
        }
    }
}

/// Finds the attachments among the nodes of a block.
fn place<const D: usize>(nodes: &[SurfaceNode<D>], dofs: &[usize], buffers: &mut Buffers) {
    buffers.places.clear();
    // Every node a point acts on is in its block by construction.
    let find = |a: &Attachment| dofs.iter().step_by(D).position(|&d| d == nodes[a.node].dof);
    buffers.places.extend(buffers.attachments.iter().filter_map(find));
}
