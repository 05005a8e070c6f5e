//! Finite sliding with the overlap of the present configuration.
//!
//! The tangential increment since the last commit is the growth of the averaged distance between material points that faced
//! each other then: `v = Σ_k s_k^then x_k` with the weights `s = (D, -M)/a` of the last commit and present positions, in components
//! along the frame, less those at the last commit. It vanishes in a common rigid motion. The frame turns with the slave surface by the
//! polar rotation of two of its material vectors, so that history needs no rotation.
//!
//! Puso and Laursen (2004b) use the change of the mortar matrices, `Σ_k (s_k^then - s_k^now) x_k`. It differs by the growth of the
//! averaged gap across n_A, since the masters are found along the normals of facets. Bodies that approach along the normal of a curved
//! surface would slip by a share of the turn of a facet.
//!
//! The tangent (`blocks`) includes the derivatives of the overlap: in space those of `overlap`, in the plane by forward
//! differentiation (`scalar::Dual`). Polygon corners at which corners of both facets coincide have one-sided derivatives.
//!
//! Cells and points are processed in pieces on any number of threads. Each point sums over its cells in a fixed order, so
//! results do not depend on the number of threads.
//!
//! Puso, M. A. and Laursen, T. A. (2004b), A mortar segment-to-segment frictional contact method for large deformations,
//! Computer Methods in Applied Mechanics and Engineering 193, 4891-4913.

use super::buffers::Pool;
use super::cell::{Sums, integrate};
use super::facet::{Facet, NODES, node_at};
use super::local::{Change, Distances, Local};
use super::order::{CHUNK, WorkOrder};
use super::overlap::{self, Integrals, MOST};
use super::scalar::Dual;
use super::sides::{Sides, SlaveFacet, Surfaces};
use super::small::FACED;
use super::state::{Cell, MortarMeasure, Point};
use super::straight::Lines;
use crate::measure::bound::{Bound, fits};
use crate::measure::fixed_measure::fixed_frame;
use crate::measure::measure_state::{MeasureState, MortarPointState};
use crate::measure::{Attachment, Exit, Geometry, Measure, Slides, Tractions};
use crate::shape::{MOST_NODES, shape};
use crate::spec::SurfaceNode;
use crate::vector::{add, axpy, dot, norm, scaled, solve_tangential};
use asperity_fem::term::Pattern;
use rayon::prelude::*;

/// Builds the measure in the reference configuration. Also returns the number of facet pairs examined.
#[must_use]
pub fn finite<const D: usize>(
    nodes: &[SurfaceNode<D>],
    surfaces: Surfaces<'_>,
) -> (Box<dyn Measure<D>>, u64) {
    let x: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
    let sides = Sides::new(surfaces, &mut x.clone());
    let dofs = nodes.iter().map(|n| n.dof).collect();
    let (measure, examined) = MortarMeasure::<D>::new(sides, dofs, x);
    (Box::new(measure), examined)
}

impl<const D: usize> MortarMeasure<D> {
    pub(super) fn new(sides: Sides<D>, dofs: Vec<usize>, reference: Vec<[f64; D]>) -> (Self, u64) {
        let n = sides.beside.len();
        let whole = sides.whole_areas(n);
        let points = (0..n)
            .map(|p| Point { whole: whole[p], along: along(&sides, p, &reference), ..Point::default() })
            .collect();
        let order = WorkOrder::new(&sides, &reference);
        let mut measure = Self {
            x: sides.centres.extended(&reference),
            sides,
            reference,
            dofs,
            points,
            locals: Vec::new(),
            cells: Vec::new(),
            first: Vec::new(),
            places: Vec::new(),
            integrals: Vec::new(),
            order,
            pattern: Pattern::default(),
            buffers: Pool::default(),
            found: Vec::new(),
            bound: Bound::default(),
        };
        let mut examined = 0;
        measure.pair(&mut examined);
        measure.anchor();
        measure.points.iter_mut().for_each(|p| p.fresh = false);
        measure.locals = (0..n).map(|p| measure.local(p)).collect();
        (measure, examined)
    }

    fn configure(&mut self, u: &[[f64; D]]) {
        for ((x, r), u) in self.x.iter_mut().zip(&self.reference).zip(u) {
            *x = add(r, u);
        }
        self.sides.centres.follow(&mut self.x);
    }

    /// Facets of a cell, slave then master.
    #[inline]
    pub(super) fn facets(&self, c: &Cell) -> [&Facet; 2] {
        [&self.sides.facets[c.facet].facet, &self.sides.master[c.master]]
    }

    /// Positions of the nodes of a facet's face, and of its middle if that is a corner, with their number.
    #[inline]
    pub(super) fn gather(&self, facet: &Facet) -> ([[f64; D]; MOST_NODES], usize) {
        let (mut out, mut count) = ([[0.0; D]; MOST_NODES], 0);
        for (x, n) in out.iter_mut().zip(facet.movers()) {
            *x = self.x[n];
            count += 1;
        }
        (out, count)
    }

    /// Computes the rows of D and M at the present positions. Cells are integrated one by one; each point then sums over its
    /// own cells.
    fn weigh(&mut self) {
        let mut integrals = std::mem::take(&mut self.integrals);
        self.integrate_cells((0, self.cells.len()), &mut integrals);
        let mut points = std::mem::take(&mut self.points);
        let indexed = points.par_iter_mut().enumerate().with_min_len(CHUNK);
        indexed.for_each(|(p, point)| self.add_up(p, point, &integrals));
        self.points = points;
        self.integrals = integrals;
    }

    /// Computes the integrals of the cells `from..to`.
    fn integrate_cells(&self, (from, to): (usize, usize), out: &mut [f64]) {
        if to - from > CHUNK {
            let middle = from + (to - from).div_ceil(2);
            let (left, right) = out.split_at_mut(self.cells[middle].table - self.cells[from].table);
            rayon::join(
                || self.integrate_cells((from, middle), left),
                || self.integrate_cells((middle, to), right),
            );
            return;
        }
        let mut rest = out;
        for c in &self.cells[from..to] {
            let [s, m] = self.facets(c).map(|facet| facet.face.nodes.len());
            let (mine, tail) = rest.split_at_mut(self.sides.facets[c.facet].weighting.points.len() * (s + m));
            rest = tail;
            self.integrate_cell(c, mine);
        }
    }

    /// Computes the rows of a cell: those of the nodes of the slave's face, followed by those of the master's with opposite sign.
    fn integrate_cell(&self, c: &Cell, mine: &mut [f64]) {
        mine.fill(0.0);
        let Some(values) = self.integrals(c) else { return };
        self.add_rows(c.facet, self.facets(c)[0].face.nodes.len(), mine, |b| {
            [&values.own[b], &values.other[b]]
        });
    }

    /// Integrals over a cell; `None` if the facets do not overlap.
    fn integrals(&self, c: &Cell) -> Option<Integrals> {
        match (D == 2, self.linear(c)) {
            (true, true) => {
                self.lines(c).map(|lines| lines.integrals(&self.sides.rule(c.facet, c.master).line))
            }
            (true, false) => self.integrals_on_lines(c),
            (false, true) => self.in_space(c, overlap::integrals::<NODES>),
            (false, false) => self.in_space(c, overlap::integrals::<MOST>),
        }
    }

    /// Integrals over a cell in the plane.
    fn integrals_on_lines(&self, c: &Cell) -> Option<Integrals> {
        let [slave, master] = self.facets(c);
        let ((own, s), (other, m)) = (self.gather(slave), self.gather(master));
        let (rule, frozen) = (self.sides.rule(c.facet, c.master), self.sides.frozen(c.facet));
        let mut sums = Sums::<f64, MOST>::zero();
        let overlaps = integrate(frozen, &own[..s], master, &other[..m], rule, &mut sums);
        overlaps.then_some(Integrals { own: sums.own, other: sums.other })
    }

    /// True if both faces of a cell are of first order, and thus their own facets.
    pub(super) fn linear(&self, c: &Cell) -> bool {
        self.facets(c).iter().all(|facet| facet.face.kind.first_order())
    }

    /// Lines of first order in the plane; `None` if they do not overlap.
    pub(super) fn lines(&self, c: &Cell) -> Option<Lines<'_, D>> {
        let [x, y] = self.facets(c).map(|facet| [0, 1].map(|k| self.x[facet.nodes[k]]));
        let frozen = self.sides.frozen(c.facet);
        Lines::new(x, y, frozen.reference, frozen.axisymmetric)
    }

    /// Adds to the rows of a facet's points those of its corners.
    fn add_rows<'a>(
        &self,
        facet: usize,
        own: usize,
        mine: &mut [f64],
        corner: impl Fn(usize) -> [&'a [f64]; 2],
    ) {
        let weighting = &self.sides.facets[facet].weighting;
        let n = mine.len() / weighting.points.len();
        for (a, row) in mine.chunks_exact_mut(n).enumerate() {
            let (left, right) = row.split_at_mut(own);
            weighting.sum(a, |share, b| {
                let [own, other] = corner(b);
                left.iter_mut().zip(own).for_each(|(l, v)| *l += share * v);
                right.iter_mut().zip(other).for_each(|(r, v)| *r -= share * v);
            });
        }
    }

    /// Applies `work` to the facets of a cell in space.
    pub(super) fn in_space<R>(&self, c: &Cell, work: impl FnOnce(&overlap::Facets<'_>) -> R) -> R {
        let [slave, master] = self.facets(c);
        let ((own, s), (other, m)) = (self.gather(slave), self.gather(master));
        let mut reference = [[0.0; 3]; MOST_NODES];
        let frozen = self.sides.frozen(c.facet);
        reference.iter_mut().zip(frozen.reference).for_each(|(to, x)| *to = three(*x));
        let [own, other] = [own, other].map(|x| x.map(three));
        work(&overlap::Facets {
            slave: overlap::Side { facet: slave, x: &own[..s] },
            reference: &reference[..frozen.reference.len()],
            master: overlap::Side { facet: master, x: &other[..m] },
            rule: self.sides.rule(c.facet, c.master),
        })
    }

    /// Cells of a facet.
    pub(super) fn cells_of(&self, facet: usize) -> &[Cell] {
        &self.cells[self.first[facet]..self.first[facet + 1]]
    }

    /// Sums weights and area of point `p` over the integrals of the adjacent cells.
    fn add_up(&self, p: usize, point: &mut Point, integrals: &[f64]) {
        point.weights.fill(0.0);
        point.area = 0.0;
        for b in &self.sides.beside[p] {
            let s = self.sides.facets[b.facet].facet.face.nodes.len();
            for c in self.cells_of(b.facet) {
                let n = s + self.sides.master[c.master].face.nodes.len();
                let from = c.table + b.row * n;
                let row = &integrals[from..from + n];
                self.places[from..from + n].iter().zip(row).for_each(|(&at, w)| point.weights[at] += w);
                row[..s].iter().for_each(|w| point.area += w);
            }
        }
    }

    /// Anchors points that now meet the master for the first time; they have not slipped before.
    fn anchor(&mut self) {
        self.weigh();
        for p in 0..self.points.len() {
            if !self.points[p].anchored && self.points[p].faces() {
                let apart = self.local(p).apart();
                self.points[p].keep(apart);
                self.points[p].fresh = true;
            }
        }
    }

    fn local(&self, p: usize) -> Local<D> {
        let point = &self.points[p];
        let share = if point.area == 0.0 { 0.0 } else { point.area.recip() };
        let mut distances = Distances { d: [0.0; D], v: [0.0; D], then: point.apart };
        for ((&n, w), then) in point.nodes.iter().zip(&point.weights).zip(&point.then) {
            axpy(&mut distances.d, share * w, &self.x[n]);
            axpy(&mut distances.v, *then, &self.x[n]);
        }
        let mirror = self.sides.mirrors[p];
        if mirror.any() {
            return Local::mirrored(&self.sides.normal_sum(p, &self.x), mirror, distances);
        }
        let e = self.sides.bases(&self.sides.around[p][0], &self.x);
        let material = point.along.map(|[a, b]| add(&scaled(&e[0], a), &scaled(&e[1], b)));
        Local::new(&self.sides.normal_sum(p, &self.x), material, distances)
    }

    /// Computes δn and δframe for unit displacements of the slave nodes of point `p`, axis by axis.
    pub(super) fn turns(&self, p: usize, out: &mut Vec<Change<D>>) {
        let (point, local) = (&self.points[p], &self.locals[p]);
        out.clear();
        out.resize(point.slaves * D, Change::none());
        // Changes of the sum of normals and of the material vectors, in the place of those of the normal and frame that follow from them.
        for (k, b) in self.sides.around[p].iter().enumerate() {
            let face = &self.sides.faces[b.face];
            let s = shape(face.kind, node_at(face.kind, b.local));
            let arms = self.sides.arms(b, &self.x);
            for (l, node) in face.nodes.iter().enumerate() {
                // Nodes of adjacent faces come first in the block.
                let Some(place) = point.nodes[..point.slaves].iter().position(|n| n == node) else {
                    continue;
                };
                let slopes = [s.first[0][l], s.first[1][l]];
                for (i, change) in out[place * D..(place + 1) * D].iter_mut().enumerate() {
                    axpy(&mut change.n, 1.0, &arms[l].change(i));
                    if k == 0 {
                        for (m, [a, b]) in change.frame.iter_mut().zip(&point.along) {
                            m[i] = a * slopes[0] + b * slopes[1];
                        }
                    }
                }
            }
        }
        for change in out {
            let (normals, material) = (change.n, change.frame);
            local.turn(&normals, &material, change);
        }
    }

    /// Adds to the increments of gaps the contribution of the changing overlap of a cell.
    fn overlap_slide(&self, c: &Cell, du: &[[f64; D]], out: &mut Slides) {
        let [slave, master] = self.facets(c);
        let moved = |facet: &Facet| -> [[Dual<1>; D]; MOST_NODES] {
            let mut out = self.gather(facet).0.map(|p| p.map(|v| Dual { v, d: [0.0] }));
            for (o, n) in out.iter_mut().zip(facet.movers()) {
                let by = self.sides.centres.mean(n, du);
                o.iter_mut().zip(by).for_each(|(o, by)| o.d[0] = by);
            }
            out
        };
        let (x, y) = (moved(slave), moved(master));
        let mut sums = Sums::<Dual<1>, MOST_NODES>::zero();
        let (rule, frozen) = (self.sides.rule(c.facet, c.master), self.sides.frozen(c.facet));
        let (s, m) = (slave.movers().count(), master.movers().count());
        if !integrate(frozen, &x[..s], master, &y[..m], rule, &mut sums) {
            return;
        }
        let weighting = &self.sides.facets[c.facet].weighting;
        for (a, &p) in weighting.points.iter().enumerate().filter(|(_, p)| self.points[**p].faces()) {
            let local = &self.locals[p];
            let mut dp = [0.0; D];
            weighting.sum(a, |share, b| {
                for (w, &n) in sums.own[b].iter().zip(&slave.face.nodes) {
                    axpy(&mut dp, share * w.d[0], &self.x[n]);
                    axpy(&mut dp, -share * w.d[0], &local.d);
                }
                for (w, &n) in sums.other[b].iter().zip(&master.face.nodes) {
                    axpy(&mut dp, -share * w.d[0], &self.x[n]);
                }
            });
            out.gap[p] += dot(&local.n, &dp) / self.points[p].area;
        }
    }
}

impl<const D: usize> MortarMeasure<D> {
    /// True if all nodes of the faces of a pair of facets are in the blocks of the pair's points.
    fn beside_blocks(&self, [facet, master]: &[usize; 2], points: &[MortarPointState]) -> bool {
        let (own, other) = (&self.sides.facets[*facet], &self.sides.master[*master]);
        let mut nodes = own.facet.face.nodes.iter().chain(&other.face.nodes);
        nodes.all(|n| own.weighting.points.iter().all(|&p| points[p].nodes.contains(n)))
    }
}

impl Point {
    /// True if the point faces the master.
    fn faces(&self) -> bool {
        self.area > FACED * self.whole
    }

    /// Stores the present weights, and the components of the averaged distance along the frame, as those of the last commit.
    fn keep(&mut self, apart: [f64; 2]) {
        self.apart = apart;
        for (then, w) in self.then.iter_mut().zip(&self.weights) {
            *then = w / self.area;
        }
        self.anchored = true;
    }
}

/// Position padded to three coordinates.
fn three<const D: usize>(x: [f64; D]) -> [f64; 3] {
    std::array::from_fn(|i| x.get(i).copied().unwrap_or(0.0))
}

/// Components of the small-sliding frame's vectors in the base vectors of the first face adjacent to point `p`.
fn along<const D: usize>(sides: &Sides<D>, p: usize, x: &[[f64; D]]) -> [[f64; 2]; 2] {
    let first = &sides.around[p][0];
    let e = sides.bases(first, x);
    let normals = sides.normal_sum(p, x);
    let frame = fixed_frame(&scaled(&normals, -norm(&normals).recip()));
    let metric = [dot(&e[0], &e[0]), dot(&e[0], &e[1]), dot(&e[1], &e[1])];
    frame.map(|t| solve_tangential(D - 1, &metric, &[dot(&e[0], &t), dot(&e[1], &t)]))
}

impl<const D: usize> Measure<D> for MortarMeasure<D> {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn block_points(&self, out: &mut Vec<usize>) {
        out.extend_from_slice(self.order.all());
    }

    fn search(&mut self, u: &[[f64; D]], projections: &mut u64) -> bool {
        self.configure(u);
        let due = !self.bound.holds(&self.x);
        if due {
            self.pair(projections);
        }
        if self.points.iter().any(|p| !p.anchored) {
            self.anchor();
        }
        due
    }

    fn measure(&mut self, u: &[[f64; D]], out: &mut Geometry<D>) {
        self.configure(u);
        self.weigh();
        let mut locals = std::mem::take(&mut self.locals);
        let indexed = locals.par_iter_mut().enumerate().with_min_len(CHUNK);
        indexed.for_each(|(p, local)| *local = self.local(p));
        self.locals = locals;
        for (p, (point, local)) in self.points.iter().zip(&self.locals).enumerate() {
            // A NaN area must not make the point count as unpaired.
            out.paired[p] = point.anchored && (point.faces() || point.area.is_nan());
            out.gap[p] = if out.paired[p] { local.gap() } else { f64::INFINITY };
            out.increment[p] = if out.paired[p] { local.increment() } else { [0.0; 2] };
            out.normal[p] = local.n;
            out.frame[p] = local.frame;
        }
    }

    fn spread(&self, force: &[[f64; D]], residual: &mut [f64]) {
        for (point, f) in self.points.iter().zip(force) {
            for (&n, w) in point.nodes.iter().zip(&point.weights) {
                for (r, fi) in residual[self.dofs[n]..self.dofs[n] + D].iter_mut().zip(f) {
                    *r -= w * fi;
                }
            }
        }
    }

    fn tangent(&self, _geometry: &Geometry<D>, tractions: Tractions<'_>, values: &mut [f64]) {
        self.blocks(0, self.order.pieces(), &tractions, values);
    }

    fn slides(&self, _geometry: &Geometry<D>, du: &[[f64; D]], out: &mut Slides) {
        let mut buffers = self.buffers.take();
        for (p, point) in self.points.iter().enumerate() {
            out.gap[p] = 0.0;
            out.increment[p] = [0.0; 2];
            if !point.faces() {
                continue;
            }
            let local = &self.locals[p];
            let mut add = |gap: f64, along: [f64; 2]| {
                out.gap[p] += gap;
                out.increment[p].iter_mut().zip(along).for_each(|(to, by)| *to += by);
            };
            for ((&n, w), then) in point.nodes.iter().zip(&point.weights).zip(&point.then) {
                let along = local.frame.map(|e| then * dot(&e, &du[n]));
                add(w / point.area * dot(&local.n, &du[n]), along);
            }
            self.turns(p, &mut buffers.turns);
            for (&n, turns) in point.nodes.iter().zip(buffers.turns.chunks_exact(D)) {
                for (turn, du) in turns.iter().zip(&du[n]) {
                    add(du * dot(&turn.n, &local.d), turn.frame.map(|e| du * dot(&e, &local.v)));
                }
            }
        }
        self.buffers.keep(buffers);
        for c in &self.cells {
            self.overlap_slide(c, du, out);
        }
    }

    fn exit(&self, _du: &[[f64; D]]) -> Option<Exit> {
        None
    }

    fn commit(&mut self, _geometry: &Geometry<D>, _reframe: &mut dyn FnMut(usize, &[[f64; D]; 2])) {
        for (point, local) in self.points.iter_mut().zip(&self.locals) {
            point.fresh = false;
            if point.faces() {
                point.keep(local.apart());
            } else {
                point.anchored = false;
                point.then.fill(0.0);
            }
        }
    }

    fn revert(&mut self) {
        for point in self.points.iter_mut().filter(|p| p.fresh) {
            point.fresh = false;
            point.anchored = false;
            point.then.fill(0.0);
        }
    }

    fn averages(&self, p: usize, out: &mut Vec<(usize, f64)>) {
        out.clear();
        let point = &self.points[p];
        if !point.faces() {
            return;
        }
        for b in &self.sides.beside[p] {
            let SlaveFacet { facet, weighting, .. } = &self.sides.facets[b.facet];
            for c in self.cells_of(b.facet) {
                let s = facet.face.nodes.len();
                let from = c.table + b.row * (s + self.sides.master[c.master].face.nodes.len());
                let with_corners = facet.with_corners(&self.integrals[from..from + s]);
                weighting.add_shares(&with_corners, |q, w| out.push((q, w / point.area)));
            }
        }
    }

    fn attachments(&self, p: usize, out: &mut Vec<Attachment>) {
        out.clear();
        let point = &self.points[p];
        if point.faces() {
            let all = point.nodes.iter().zip(&point.weights).enumerate();
            out.extend(all.filter(|(_, (_, w))| **w != 0.0).map(|(k, (&node, w))| Attachment {
                node,
                weight: w / point.area,
                slave: k < point.slaves,
            }));
        }
    }

    fn areas(&self, out: &mut [f64]) {
        for (a, p) in out.iter_mut().zip(&self.points) {
            *a = if p.faces() { p.area } else { 0.0 };
        }
    }

    fn collocated(&self) -> bool {
        false
    }

    fn follows(&self) -> bool {
        true
    }

    fn save(&self) -> MeasureState {
        let facing = |point: &Point| MortarPointState {
            nodes: point.nodes.clone(),
            slaves: point.slaves,
            then: point.then.clone(),
            apart: point.apart,
            anchored: point.anchored,
        };
        MeasureState::Mortar {
            points: self.points.iter().map(facing).collect(),
            pairs: self.cells.iter().map(|c| [c.facet, c.master]).collect(),
            proved: self.bound.save(),
        }
    }

    fn restore(&mut self, saved: &MeasureState) -> bool {
        let MeasureState::Mortar { points, pairs, proved } = saved else { return false };
        let (facets, masters) = (self.sides.facets.len(), self.sides.master.len());
        let exist = |p: &MortarPointState| {
            p.nodes.iter().all(|&n| n < self.reference.len())
                && p.then.len() == p.nodes.len()
                && p.slaves <= p.nodes.len()
        };
        let fit = points.len() == self.points.len()
            && points.iter().all(exist)
            && pairs.iter().all(|p| p[0] < facets && p[1] < masters && self.beside_blocks(p, points))
            && fits::<D>(proved, self.x.len());
        if !fit {
            return false;
        }
        for (point, saved) in self.points.iter_mut().zip(points) {
            point.nodes.clone_from(&saved.nodes);
            point.then.clone_from(&saved.then);
            point.apart = saved.apart;
            point.weights = vec![0.0; saved.nodes.len()];
            (point.slaves, point.anchored, point.fresh) = (saved.slaves, saved.anchored, false);
        }
        self.tabulate(pairs);
        self.bound = Bound::restore(proved);
        true
    }
}
