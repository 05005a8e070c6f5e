//! Finite sliding with a pairing that follows the motion.
//!
//! A point is *held* by one segment between searches. The closest point x_c on the (continued) segment is recomputed at each
//! measurement. The closest point of the last commit, the *anchor*, moves with the master as a material point x_a, and the
//! tangential increment is `d = x_c - x_a` in the present tangent plane. On one flat segment it equals `e_m Δξ_m` with the
//! present base vectors, whatever the rotation. Across coplanar segments it is the sum of the path. Across a kink of angle θ it
//! is the chord, which is shorter than the path by at most θ²/8 of it, in the one step that crosses.
//!
//! Tangential history is stored as components in the orthonormal frame of the anchor, `a_1 = e_1/|e_1|`, `a_2 = n_a × a_1`.
//! This frame is carried to the present tangent plane by the smallest rotation that takes n_a to n:
//! `a' = a - (n·a)/(1 + n_a·n) (n_a + n)`. Components are therefore unchanged by a rigid rotation, and the force turns with the
//! master.
//!
//! Linearisation, with `A_ml = e_m·e_l - g_n n·e_m,l` the curvature-corrected metric:
//! `A_ml δξ_l = δ(u_s - N u)·e_m + g_n n·N_γ,m δx_γ`, `δg_n = n·δ(u_s - N u)`, `δn = -(n·δe_m) e^m`,
//! `δe_m = N_γ,m δx_γ + e_m,l δξ_l`. The reaction `N_γ f` moves with ξ, which adds `N_γ,m δξ_m f`. The blocks are built in
//! [`super::kernel`]. On smoothed surfaces γ runs over all nodes on which the segment depends.
//!
//! Points are processed in pieces of fixed size on any number of threads. No point depends on another, so results do not depend
//! on the number of threads.

use super::kernel::{Columns, Friction, Kernel};
use super::local::Local;
use super::track::{CHUNK, Place, Point, track};
use crate::measure::bound::{Bound, fits};
use crate::measure::measure_state::{MeasureState, PairingState};
use crate::measure::{Attachment, Exit, Geometry, Measure, Slides, Tractions};
use crate::search::project::{BORDER, depth, margins};
use crate::search::smooth::MOST_SUPPORT;
use crate::search::surface::{Surface, Weights};
use crate::spec::{SlavePoint, SurfaceNode};
use crate::vector::{add, axpy, dot, sub};
use asperity_fem::term::{Blocks, Pattern};

/// Node-to-point measure of finite sliding.
#[derive(Clone, Debug)]
pub struct NodeToPointMeasure<const D: usize> {
    surface: Surface<D>,
    reference: Vec<[f64; D]>,
    dofs: Vec<usize>,
    points: Vec<Point>,
    /// Positions of all nodes at the last measurement.
    x: Vec<[f64; D]>,
    /// Range in which the result of the last search holds.
    bound: Bound<D>,
    /// Largest number of nodes on which a segment depends.
    widest: usize,
    /// Nodes of all blocks: the slave, those of the held segment, and those of the anchor's segment that are not among them.
    nodes: Vec<usize>,
    /// Start of each point's block in `nodes`.
    starts: Vec<usize>,
    /// Start of each point's block among the values of a tangent.
    offsets: Vec<usize>,
    pattern: Pattern,
}

impl<const D: usize> NodeToPointMeasure<D> {
    /// Pairs the slave points on `surface` in the reference configuration. Also returns the number of projections made.
    #[must_use]
    pub fn new(nodes: &[SurfaceNode<D>], slave: &[SlavePoint], surface: Surface<D>) -> (Self, u64) {
        let reference: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
        let widest = (0..surface.segments().len()).map(|k| surface.support(k).len()).max().unwrap_or(0);
        let mut measure = Self {
            surface,
            bound: Bound::default(),
            widest,
            x: reference.clone(),
            reference,
            dofs: nodes.iter().map(|n| n.dof).collect(),
            points: slave.iter().map(Point::new).collect(),
            nodes: Vec::new(),
            starts: vec![0; slave.len() + 1],
            offsets: vec![0; slave.len() + 1],
            pattern: Pattern::default(),
        };
        let mut projections = 0;
        measure.search(&vec![[0.0; D]; nodes.len()], &mut projections);
        // The reference configuration counts as committed.
        measure.points.iter_mut().for_each(|p| p.fresh = false);
        (measure, projections)
    }

    /// Discards the range of the last search, so that the next search is made in full.
    pub fn forget(&mut self) {
        self.bound = Bound::default();
    }

    fn configure(&mut self, u: &[[f64; D]]) {
        for ((x, r), u) in self.x.iter_mut().zip(&self.reference).zip(u) {
            *x = add(r, u);
        }
        self.surface.configure(&self.x);
    }

    /// Rebuilds the blocks if the segments of a point have changed.
    fn rebuild(&mut self) {
        let mut changed = false;
        for point in &mut self.points {
            let key = point.place.zip(point.anchor).map(|(h, a)| (h.segment, a.segment));
            changed |= key != point.key;
            point.key = key;
        }
        if changed {
            self.build();
        }
    }

    /// Builds the blocks of the points' segments and a new pattern.
    fn build(&mut self) {
        self.nodes.clear();
        let mut blocks = Blocks::default();
        for (p, point) in self.points.iter().enumerate() {
            let from = self.nodes.len();
            if let Some((held, anchor)) = point.key {
                self.nodes.push(point.slave.node);
                self.nodes.extend_from_slice(self.surface.support(held));
                if anchor != held {
                    for n in self.surface.support(anchor) {
                        if !self.nodes[from..].contains(n) {
                            self.nodes.push(*n);
                        }
                    }
                }
                blocks.push(self.nodes[from..].iter().flat_map(|&n| self.dofs[n]..self.dofs[n] + D));
            }
            let size = (self.nodes.len() - from) * D;
            self.starts[p + 1] = self.nodes.len();
            self.offsets[p + 1] = self.offsets[p] + size * size;
        }
        self.pattern = blocks.into();
    }

    #[inline]
    pub(super) fn local(&self, place: &Place) -> Local<D> {
        Local::new(&self.surface.evaluate(place.segment, &self.x, place.xi))
    }

    /// Linearised motion of a point on its held segment: `(dg_n, dξ)`.
    fn rates(
        &self,
        point: &Point,
        place: &Place,
        local: &Local<D>,
        gap: f64,
        du: &[[f64; D]],
    ) -> (f64, [f64; 2]) {
        let weights: Weights<MOST_SUPPORT> = self.surface.weights(place.segment, place.xi);
        let mut relative = du[point.slave.node];
        let mut stretch = [0.0; 2];
        for (k, &node) in self.surface.support(place.segment).iter().enumerate() {
            axpy(&mut relative, -weights.value[k], &du[node]);
            let along = dot(&local.n, &du[node]);
            stretch[0] += weights.first[0][k] * along;
            stretch[1] += weights.first[1][k] * along;
        }
        local.rates(gap, &relative, stretch)
    }

    /// Finds the rows of a segment's nodes in the block of point `p`. With `leading` they directly follow the slave.
    fn rows<const M: usize>(&self, p: usize, segment: usize, leading: bool, rows: &mut [usize; M]) -> usize {
        let support = self.surface.support(segment);
        let block = &self.nodes[self.starts[p]..self.starts[p + 1]];
        for (k, (row, node)) in rows.iter_mut().zip(support).enumerate() {
            *row = if leading { k + 1 } else { 1 + block[1..].iter().position(|n| n == node).unwrap_or(0) };
        }
        support.len()
    }

    /// Writes the block of point `p`.
    fn block<const M: usize, const K: usize>(
        &self,
        p: usize,
        geometry: &Geometry<D>,
        tractions: &Tractions<'_>,
        block: &mut [f64],
    ) {
        let point = &self.points[p];
        let (Some(place), Some(anchor), true) = (point.place, point.anchor, tractions.normal[p].closed)
        else {
            block.fill(0.0);
            return;
        };
        let (here, there) = (self.local(&place), self.local(&anchor));
        let friction = tractions.shear.map(|s| Friction {
            point: &s[p],
            stiffness: tractions.stiffness,
            there: &there,
            frame: &geometry.frame[p],
        });
        let weights: Weights<M> = self.surface.weights(place.segment, place.xi);
        let mut columns = Columns::<K>::zero();
        let mut rows = [0; M];
        let held = point.key.map(|k| k.0);
        let n = self.rows(p, place.segment, held == Some(place.segment), &mut rows);
        for (k, &row) in rows[..n].iter().enumerate() {
            columns.value[row] = weights.value[k];
            columns.first[0][row] = weights.first[0][k];
            columns.first[1][row] = weights.first[1][k];
        }
        if friction.is_some() {
            let weights: Weights<M> = self.surface.weights(anchor.segment, anchor.xi);
            let mut rows = [0; M];
            let n = self.rows(p, anchor.segment, held == Some(anchor.segment), &mut rows);
            for (k, &row) in rows[..n].iter().enumerate() {
                columns.anchor_value[row] = weights.value[k];
                columns.anchor_first[0][row] = weights.first[0][k];
                columns.anchor_first[1][row] = weights.first[1][k];
            }
        }
        let kernel = Kernel::new(&here, geometry.gap[p], &tractions.normal[p], friction);
        let nodes = self.starts[p + 1] - self.starts[p];
        kernel.write(point.slave.area, nodes, &columns, &rows[..n], &weights, block);
    }

    /// Writes the blocks of the points `from..to`, in pieces.
    fn blocks<const M: usize, const K: usize>(
        &self,
        (from, to): (usize, usize),
        geometry: &Geometry<D>,
        tractions: &Tractions<'_>,
        values: &mut [f64],
    ) {
        if to - from > CHUNK {
            let middle = from + (to - from).div_ceil(2).next_multiple_of(CHUNK);
            let (left, right) = values.split_at_mut(self.offsets[middle] - self.offsets[from]);
            rayon::join(
                || self.blocks::<M, K>((from, middle), geometry, tractions, left),
                || self.blocks::<M, K>((middle, to), geometry, tractions, right),
            );
            return;
        }
        let mut rest = values;
        for p in from..to {
            let (block, tail) = rest.split_at_mut(self.offsets[p + 1] - self.offsets[p]);
            rest = tail;
            self.block::<M, K>(p, geometry, tractions, block);
        }
    }

    /// Evaluates one point and writes it to `out`; the increment is the chord in the carried frame.
    fn measure_point(
        surface: &Surface<D>,
        x: &[[f64; D]],
        point: &mut Point,
        out: &mut View<'_, D>,
        p: usize,
    ) {
        let (Some(place), Some(anchor)) = (point.place, point.anchor) else {
            out.paired[p] = false;
            out.gap[p] = f64::INFINITY;
            out.increment[p] = [0.0; 2];
            return;
        };
        let slave = x[point.slave.node];
        out.paired[p] = true;
        let Some(xi) = surface.foot(place.segment, x, &slave, place.xi) else {
            out.gap[p] = f64::NAN;
            return;
        };
        point.place = Some(Place { segment: place.segment, xi });
        let here = Local::new(&surface.evaluate(place.segment, x, xi));
        let there = Local::new(&surface.evaluate(anchor.segment, x, anchor.xi));
        let frame = here.carry(&there);
        let d = sub(&here.point, &there.point);
        out.gap[p] = dot(&here.n, &sub(&slave, &here.point));
        out.normal[p] = here.n;
        out.frame[p] = frame;
        out.increment[p] = [dot(&frame[0], &d), dot(&frame[1], &d)];
    }

    /// Evaluates points in pieces.
    fn sweep(surface: &Surface<D>, x: &[[f64; D]], points: &mut [Point], mut out: View<'_, D>) {
        if points.len() <= CHUNK {
            for (p, point) in points.iter_mut().enumerate() {
                Self::measure_point(surface, x, point, &mut out, p);
            }
            return;
        }
        let middle = points.len().div_ceil(2).next_multiple_of(CHUNK);
        let (left, right) = points.split_at_mut(middle);
        let (out_left, out_right) = out.split_at(middle);
        rayon::join(|| Self::sweep(surface, x, left, out_left), || Self::sweep(surface, x, right, out_right));
    }
}

/// Mutable view of part of a geometry.
struct View<'a, const D: usize> {
    paired: &'a mut [bool],
    gap: &'a mut [f64],
    normal: &'a mut [[f64; D]],
    frame: &'a mut [[[f64; D]; 2]],
    increment: &'a mut [[f64; 2]],
}

impl<'a, const D: usize> View<'a, D> {
    fn new(g: &'a mut Geometry<D>) -> Self {
        Self {
            paired: &mut g.paired,
            gap: &mut g.gap,
            normal: &mut g.normal,
            frame: &mut g.frame,
            increment: &mut g.increment,
        }
    }

    fn split_at(self, n: usize) -> (Self, Self) {
        let (paired, paired_2) = self.paired.split_at_mut(n);
        let (gap, gap_2) = self.gap.split_at_mut(n);
        let (normal, normal_2) = self.normal.split_at_mut(n);
        let (frame, frame_2) = self.frame.split_at_mut(n);
        let (increment, increment_2) = self.increment.split_at_mut(n);
        (
            Self { paired, gap, normal, frame, increment },
            Self { paired: paired_2, gap: gap_2, normal: normal_2, frame: frame_2, increment: increment_2 },
        )
    }
}

impl<const D: usize> Measure<D> for NodeToPointMeasure<D> {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn block_points(&self, out: &mut Vec<usize>) {
        out.extend((0..self.points.len()).filter(|&p| self.points[p].key.is_some()));
    }

    fn search(&mut self, u: &[[f64; D]], projections: &mut u64) -> bool {
        self.configure(u);
        if self.bound.holds(&self.x) {
            return false;
        }
        self.surface.refit(&self.x);
        let radius = track(&self.surface, &self.x, &mut self.points, projections);
        self.bound.prove(&self.x, radius);
        self.rebuild();
        true
    }

    fn measure(&mut self, u: &[[f64; D]], out: &mut Geometry<D>) {
        self.configure(u);
        Self::sweep(&self.surface, &self.x, &mut self.points, View::new(out));
    }

    fn spread(&self, force: &[[f64; D]], residual: &mut [f64]) {
        for (point, f) in self.points.iter().zip(force) {
            let Some(place) = point.place else { continue };
            // Open points exert no force.
            if *f == [0.0; D] {
                continue;
            }
            let mut add = |node: usize, c: f64| {
                let d = self.dofs[node];
                for (r, fi) in residual[d..d + D].iter_mut().zip(f) {
                    *r += c * fi;
                }
            };
            let area = point.slave.area;
            add(point.slave.node, -area);
            let support = self.surface.support(place.segment);
            if self.widest <= 4 {
                let weights: Weights<4> = self.surface.weights(place.segment, place.xi);
                support.iter().zip(weights.value).for_each(|(&n, w)| add(n, area * w));
            } else {
                let weights: Weights<MOST_SUPPORT> = self.surface.weights(place.segment, place.xi);
                support.iter().zip(weights.value).for_each(|(&n, w)| add(n, area * w));
            }
        }
    }

    fn tangent(&self, geometry: &Geometry<D>, tractions: Tractions<'_>, values: &mut [f64]) {
        let range = (0, self.points.len());
        // Room for twice the nodes of a segment (held segment and anchor's segment) and the slave.
        match self.widest {
            0..=2 => self.blocks::<2, 5>(range, geometry, &tractions, values),
            3..=4 => self.blocks::<4, 9>(range, geometry, &tractions, values),
            5..=9 => self.blocks::<9, 19>(range, geometry, &tractions, values),
            10..=16 => self.blocks::<16, 33>(range, geometry, &tractions, values),
            _ => self.blocks::<MOST_SUPPORT, { 2 * MOST_SUPPORT + 1 }>(range, geometry, &tractions, values),
        }
    }

    fn slides(&self, geometry: &Geometry<D>, du: &[[f64; D]], out: &mut Slides) {
        for (p, point) in self.points.iter().enumerate() {
            let Some(place) = point.place else {
                out.gap[p] = 0.0;
                out.increment[p] = [0.0; 2];
                continue;
            };
            let local = self.local(&place);
            let (gap, dxi) = self.rates(point, &place, &local, geometry.gap[p], du);
            let mut slide = [0.0; D];
            axpy(&mut slide, dxi[0], &local.e[0]);
            axpy(&mut slide, dxi[1], &local.e[1]);
            out.gap[p] = gap;
            out.increment[p] = [dot(&geometry.frame[p][0], &slide), dot(&geometry.frame[p][1], &slide)];
        }
    }

    fn exit(&self, du: &[[f64; D]]) -> Option<Exit> {
        let mut best: Option<Exit> = None;
        for (p, point) in self.points.iter().enumerate() {
            let Some(place) = point.place else { continue };
            let local = self.local(&place);
            let kind = self.surface.segments()[place.segment].kind;
            let gap = dot(&local.n, &sub(&self.x[point.slave.node], &local.point));
            let (_, dxi) = self.rates(point, &place, &local, gap, du);
            let (now, then) = (margins(kind, place.xi), margins(kind, add(&place.xi, &dxi)));
            for (a, b) in now.into_iter().zip(then) {
                // A point on or beyond the border is already leaving and sets no limit.
                if a > BORDER && b < 0.0 && best.is_none_or(|e| a / (a - b) < e.fraction) {
                    best = Some(Exit { fraction: a / (a - b), point: p });
                }
            }
        }
        best
    }

    fn commit(&mut self, _geometry: &Geometry<D>, reframe: &mut dyn FnMut(usize, &[[f64; D]; 2])) {
        for p in 0..self.points.len() {
            self.points[p].fresh = false;
            let Some(place) = self.points[p].place else {
                self.points[p].anchor = None;
                continue;
            };
            reframe(p, &self.local(&place).frame);
            let kind = self.surface.segments()[place.segment].kind;
            let point = &mut self.points[p];
            let outwards = point
                .anchor
                .is_some_and(|a| a.segment != place.segment || depth(kind, place.xi) < depth(kind, a.xi));
            point.leaving = outwards && depth(kind, place.xi) <= BORDER;
            point.anchor = Some(place);
            if point.leaving {
                self.bound = Bound::default();
            }
        }
    }

    fn revert(&mut self) {
        for point in &mut self.points {
            point.anchor = point.anchor.filter(|_| !point.fresh);
            point.fresh = false;
            if point.place.map(|h| h.segment) != point.anchor.map(|a| a.segment) {
                self.bound = Bound::default();
            }
            point.place = point.anchor;
        }
    }

    fn attachments(&self, p: usize, out: &mut Vec<Attachment>) {
        out.clear();
        if let Some(place) = self.points[p].place {
            let weights: Weights<MOST_SUPPORT> = self.surface.weights(place.segment, place.xi);
            let support = self.surface.support(place.segment);
            out.push(Attachment { node: self.points[p].slave.node, weight: 1.0, slave: true });
            let master = support.iter().zip(weights.value);
            out.extend(master.map(|(&node, n)| Attachment { node, weight: -n, slave: false }));
        }
    }

    fn areas(&self, out: &mut [f64]) {
        for (a, p) in out.iter_mut().zip(&self.points) {
            *a = p.slave.area;
        }
    }

    fn collocated(&self) -> bool {
        true
    }

    fn follows(&self) -> bool {
        true
    }

    fn save(&self) -> MeasureState {
        let tracked = |point: &Point| PairingState {
            anchor: point.anchor.map(|a| (a.segment, a.xi)),
            leaving: point.leaving,
            block: point.key,
        };
        MeasureState::NodeToPoint {
            points: self.points.iter().map(tracked).collect(),
            proved: self.bound.save(),
        }
    }

    fn restore(&mut self, saved: &MeasureState) -> bool {
        let MeasureState::NodeToPoint { points, proved } = saved else { return false };
        let segments = self.surface.segments().len();
        let exist = |t: &PairingState| {
            t.anchor.is_none_or(|a| a.0 < segments)
                && t.block.is_none_or(|(a, b)| a < segments && b < segments)
        };
        if points.len() != self.points.len() || !points.iter().all(exist) || !fits::<D>(proved, self.x.len())
        {
            return false;
        }
        for (point, saved) in self.points.iter_mut().zip(points) {
            point.anchor = saved.anchor.map(|(segment, xi)| Place { segment, xi });
            (point.place, point.fresh) = (point.anchor, false);
            (point.leaving, point.key) = (saved.leaving, saved.block);
        }
        self.bound = Bound::restore(proved);
        self.build();
        true
    }
}
