//! Multipliers as unknowns of the system: equations and tangent of the points. [`Unknowns`] has the formulas.

use super::Interface;
use crate::enforce::{Buffers, REGULAR, Unknowns};
use crate::measure::{Attachment, NormalPoint, ShearPoint, Tractions};
use crate::shear::Shear;
use crate::spec::SurfaceNode;
use asperity_friction::law::Regime;
use std::ops::Range;

impl<const D: usize> Interface<D> {
    /// Reads the multipliers from the system vector, if they are unknowns.
    pub(crate) fn read_multipliers(&mut self, u: &[f64]) {
        if self.unknowns.is_some() {
            self.renew_multipliers();
        }
        if let (Some(unknowns), Some(multipliers)) = (&mut self.unknowns, &mut self.multipliers) {
            unknowns.read(u, multipliers);
        }
    }

    /// Sets the trial tractions of the closed points to the multipliers. The multipliers are the tractions that act on the
    /// bodies, and they do not carry the rounding of gaps times a large penalty.
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

    /// Adds the equations of the points to the residual.
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

    /// Scales c_n and c_t of point `p`.
    fn scales(&self, p: usize, unit: f64) -> (f64, f64) {
        if !self.contact.trial[p].closed {
            return (1.0, 1.0);
        }
        let slides = |s: &Shear| s.law.has_elastic_domain() && s.trial.regime[p] == Regime::Slip;
        let held = self.shear.as_ref().is_some_and(|s| !slides(s));
        (unit / self.penalty.stiffness, if held { unit / self.tangential_penalty } else { 1.0 })
    }

    /// Writes the tangent of the forces and of the points' equations.
    pub(crate) fn mixed_tangent(&mut self, values: &mut [f64]) {
        let Some(mut unknowns) = self.unknowns.take() else { return };
        let mut buffers = std::mem::take(&mut unknowns.buffers);
        self.gradients(&mut buffers);
        self.geometric(&mut buffers);
        self.measure.areas(&mut buffers.areas);
        let (mut at, mut from) = (0, 0);
        for b in 0..unknowns.points.len() {
            let size = unknowns.pattern.block(b).len();
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

    /// Computes the measure's tangent over the closed points for unit stiffness and no traction.
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

    /// Computes the measure's tangent with the multipliers as tractions and no stiffness, if forces follow the motion.
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

    /// Writes block `b`. `inner` is the range of its displacement part among the values of the measure.
    fn mixed_block(
        &self,
        unknowns: &Unknowns,
        b: usize,
        inner: Range<usize>,
        buffers: &mut Buffers,
        block: &mut [f64],
    ) {
        let (p, each) = (unknowns.points[b], unknowns.each);
        let dofs = unknowns.pattern.block(b);
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

    /// Writes the columns of the multipliers: their forces on the nodes.
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

    /// Reads ∇g and ∇Δu from the rows of the node with the largest weight.
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

    /// Writes the equations of a closed point.
    fn closed_rows(&self, unknowns: &Unknowns, p: usize, n: usize, gradients: &[f64], block: &mut [f64]) {
        let size = n + unknowns.each;
        let s = unknowns.unit;
        let ws = unknowns.weights[p] * s;
        let c = unknowns.weights[p] * self.scales(p, s).1;
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
                    *to += c * self.tangential_penalty * y * d;
                }
                row[n + 1 + l] = c * s * (y - same) - REGULAR * ws * same;
            }
            let coupling = c * point.d_normal * eta[m];
            for (to, g) in row.iter_mut().zip(gap) {
                *to -= coupling * self.penalty.stiffness * g;
            }
            row[n] = coupling * s;
        }
    }
}

/// Finds the positions of the attachments among the nodes of a block.
fn place<const D: usize>(nodes: &[SurfaceNode<D>], dofs: &[usize], buffers: &mut Buffers) {
    buffers.places.clear();
    // By construction, every node that a point acts on is in its block.
    let find = |a: &Attachment| dofs.iter().step_by(D).position(|&d| d == nodes[a.node].dof);
    buffers.places.extend(buffers.attachments.iter().filter_map(find));
}
