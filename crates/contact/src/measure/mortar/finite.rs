//! Finite sliding: the overlap of the present configuration.
//!
//! The tangential increment since the last commit is the growth of the averaged distance between material points that
//! faced each other then: with the weights `s = (D, -M)/a` of then and now, `v = Σ_k (s_k^then - s_k^now) x_k` at present
//! positions, in components along the frame (Puso and Laursen 2004b: the change of the mortar matrices, which vanishes
//! in a common rigid motion). The frame is laid along a material vector of the slave surface, so that history needs no
//! turning.
//!
//! The tangent differentiates the overlap forward, number by number (`scalar::Dual`), and the rest in closed form; corners
//! of the polygons that are corners of both facets at once have one-sided derivatives there.
//!
//! Puso, M. A. and Laursen, T. A. (2004b), A mortar segment-to-segment frictional contact method for large deformations,
//! Computer Methods in Applied Mechanics and Engineering 193, 4891-4913.

use super::cell::{Sums, integrate};
use super::local::{Change, Local, Traction};
use super::scalar::Dual;
use super::sides::{Beside, Sides, node_at};
use super::small::FACED;
use crate::measure::fixed::fixed_frame;
use crate::measure::{Attachment, Exit, Geometry, Measure, Slides, Tractions};
use crate::shape::shape;
use crate::spec::{Segment, SlavePoint, SurfaceNode};
use crate::vector::{add, axpy, cross, dot, norm, perpendicular, scaled, solve_tangential};
use asperity_fem::term::Pattern;

/// Most nodes of a facet of first order.
const NODES: usize = 4;

#[derive(Clone, Debug, Default)]
struct Point {
    /// Nodes of its block: those of the slave facets beside it, then those of the masters near it.
    nodes: Vec<usize>,
    /// How many of them are slaves.
    slaves: usize,
    /// Rows of D and -M on these nodes.
    weights: Vec<f64>,
    /// s_k of the last commit.
    then: Vec<f64>,
    area: f64,
    /// About its area when all of its facets face the master.
    whole: f64,
    /// Whether `then` exists: the point faced the master at the last commit, or has met it since.
    anchored: bool,
    /// Met it since.
    fresh: bool,
    /// Start of its block among the values.
    at: usize,
    /// The frame's material vector in the base vectors of the first facet beside the point.
    along: [f64; 2],
}

/// A slave facet with a master facet that may overlap it.
#[derive(Clone, Copy, Debug)]
struct Cell {
    facet: usize,
    master: usize,
    /// Start of its table in `places`: for each point of the facet the places of slave and master nodes in its block.
    table: usize,
}

/// The measure; `M` numbers of a cell vary.
#[derive(Clone, Debug)]
struct Finite<const D: usize, const M: usize> {
    sides: Sides<D>,
    reference: Vec<[f64; D]>,
    dofs: Vec<usize>,
    points: Vec<Point>,
    locals: Vec<Local<D>>,
    x: Vec<[f64; D]>,
    cells: Vec<Cell>,
    places: Vec<usize>,
    pattern: Pattern,
    /// The committed weights must be found from the configuration measured next.
    restored: bool,
    /// Buffers of the search: pairs of facets, candidates of one facet.
    found: (Vec<(usize, usize)>, Vec<usize>),
}

/// Builds the measure in the reference configuration. Returns it with the number of pairs of facets examined.
#[must_use]
pub fn finite<const D: usize>(
    nodes: &[SurfaceNode<D>],
    slave: &[SlavePoint],
    faces: &[Segment],
    master: Vec<Segment>,
    axisymmetric: bool,
) -> (Box<dyn Measure<D>>, u64) {
    let x: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
    let sides = Sides::new(faces, slave, master, &x, axisymmetric);
    let dofs = nodes.iter().map(|n| n.dof).collect();
    if D == 2 {
        let (measure, examined) = Finite::<D, 8>::new(sides, dofs, x);
        (Box::new(measure), examined)
    } else {
        let (measure, examined) = Finite::<D, 24>::new(sides, dofs, x);
        (Box::new(measure), examined)
    }
}

impl<const D: usize, const M: usize> Finite<D, M> {
    fn new(sides: Sides<D>, dofs: Vec<usize>, reference: Vec<[f64; D]>) -> (Self, u64) {
        let n = sides.beside.len();
        let whole = sides.whole_areas(n);
        let points = (0..n)
            .map(|p| Point { whole: whole[p], along: along(&sides, p, &reference), ..Point::default() })
            .collect();
        let mut measure = Self {
            sides,
            x: reference.clone(),
            reference,
            dofs,
            points,
            locals: Vec::new(),
            cells: Vec::new(),
            places: Vec::new(),
            pattern: Pattern::default(),
            restored: false,
            found: Default::default(),
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
    }

    /// Finds the cells anew; blocks change when they do.
    fn pair(&mut self, examined: &mut u64) {
        self.sides.refit(&self.x);
        let (mut pairs, mut candidates) = std::mem::take(&mut self.found);
        pairs.clear();
        for f in 0..self.sides.facets.len() {
            self.sides.candidates(f, &self.x, &mut candidates, examined);
            pairs.extend(candidates.iter().map(|&m| (f, m)));
        }
        if !pairs.iter().copied().eq(self.cells.iter().map(|c| (c.facet, c.master))) {
            self.rebuild(&pairs);
        }
        self.found = (pairs, candidates);
    }

    fn rebuild(&mut self, pairs: &[(usize, usize)]) {
        for p in 0..self.points.len() {
            let mut slaves: Vec<usize> =
                self.sides.beside[p].iter().flat_map(|b| self.sides.facets[b.facet].nodes.clone()).collect();
            slaves.sort_unstable();
            slaves.dedup();
            let point = &mut self.points[p];
            let kept = point.nodes.iter().zip(&point.then).filter(|(_, w)| **w != 0.0 && point.anchored);
            let kept: Vec<(usize, f64)> = kept.map(|(&n, &w)| (n, w)).collect();
            let beside = &self.sides.beside[p];
            let from = beside.iter().flat_map(|b| {
                let first = pairs.partition_point(|c| c.0 < b.facet);
                pairs[first..].iter().take_while(|c| c.0 == b.facet).map(|c| c.1)
            });
            let mut masters: Vec<usize> =
                from.flat_map(|m| self.sides.master[m].nodes.iter().copied()).collect();
            masters.extend(kept.iter().map(|k| k.0));
            masters.sort_unstable();
            masters.dedup();
            masters.retain(|n| slaves.binary_search(n).is_err());
            point.slaves = slaves.len();
            point.nodes = slaves;
            point.nodes.extend(masters);
            point.weights = vec![0.0; point.nodes.len()];
            point.then = vec![0.0; point.nodes.len()];
            for (n, w) in kept {
                if let Some(k) = point.nodes.iter().position(|&m| m == n) {
                    point.then[k] = w;
                }
            }
        }
        self.tabulate(pairs);
    }

    /// Places of the cells' nodes in the blocks, and the pattern.
    fn tabulate(&mut self, pairs: &[(usize, usize)]) {
        self.cells.clear();
        self.places.clear();
        for &(facet, master) in pairs {
            self.cells.push(Cell { facet, master, table: self.places.len() });
            let (own, other) = (&self.sides.facets[facet], &self.sides.master[master]);
            for &p in &own.weighting.points {
                let block = &self.points[p].nodes;
                for n in own.nodes.iter().chain(&other.nodes) {
                    // Every node of a cell is in the blocks of its points by construction.
                    self.places.extend(block.iter().position(|m| m == n));
                }
            }
        }
        let mut at = 0;
        for point in &mut self.points {
            point.at = at;
            at += (point.nodes.len() * D).pow(2);
        }
        let dofs = &self.dofs;
        let blocks: Vec<Vec<usize>> = self
            .points
            .iter()
            .map(|p| p.nodes.iter().flat_map(|&n| dofs[n]..dofs[n] + D).collect())
            .collect();
        self.pattern = Pattern::of_blocks(self.pattern.version + 1, blocks.iter().map(Vec::as_slice));
    }

    /// Positions of a cell's nodes, slave then master.
    #[inline]
    fn gather(&self, c: &Cell) -> ([[f64; D]; NODES], [[f64; D]; NODES]) {
        let (mut own, mut other) = ([[0.0; D]; NODES], [[0.0; D]; NODES]);
        own.iter_mut().zip(&self.sides.facets[c.facet].nodes).for_each(|(x, &n)| *x = self.x[n]);
        other.iter_mut().zip(&self.sides.master[c.master].nodes).for_each(|(x, &n)| *x = self.x[n]);
        (own, other)
    }

    /// Rows of D and M at the present positions.
    fn weigh(&mut self) {
        for point in &mut self.points {
            point.weights.fill(0.0);
            point.area = 0.0;
        }
        let mut sums = Sums::<f64, NODES>::zero();
        for c in &self.cells {
            let (facet, master) = (&self.sides.facets[c.facet], &self.sides.master[c.master]);
            let (own, other) = self.gather(c);
            let (s, m) = (facet.nodes.len(), master.nodes.len());
            let rule = self.sides.rule(c.facet, c.master);
            let frozen = self.sides.frozen(c.facet);
            if !integrate(frozen, &own[..s], master.kind, &other[..m], rule, &mut sums) {
                continue;
            }
            for (a, &p) in facet.weighting.points.iter().enumerate() {
                let places = &self.places[c.table + a * (s + m)..];
                let point = &mut self.points[p];
                for (k, &at) in places[..s].iter().enumerate() {
                    point.weights[at] += sums.own[a][k];
                    point.area += sums.own[a][k];
                }
                for (k, &at) in places[s..s + m].iter().enumerate() {
                    point.weights[at] -= sums.other[a][k];
                }
            }
        }
    }

    /// Points that meet the master now have slipped nothing before.
    fn anchor(&mut self) {
        self.weigh();
        for point in &mut self.points {
            if !point.anchored && point.faces() {
                point.keep();
                point.fresh = true;
            }
        }
    }

    fn local(&self, p: usize) -> Local<D> {
        let point = &self.points[p];
        let share = if point.area == 0.0 { 0.0 } else { point.area.recip() };
        let (mut d, mut v) = ([0.0; D], [0.0; D]);
        for ((&n, w), then) in point.nodes.iter().zip(&point.weights).zip(&point.then) {
            axpy(&mut d, share * w, &self.x[n]);
            axpy(&mut v, then - share * w, &self.x[n]);
        }
        let e = self.sides.bases(self.sides.beside[p][0], &self.x);
        let mut material = scaled(&e[0], point.along[0]);
        axpy(&mut material, point.along[1], &e[1]);
        Local::new(&self.sides.normal_sum(p, &self.x), material, d, v)
    }

    /// δn and δframe for a unit displacement along axis `i` of `node`, one of the slaves of point `p`.
    fn turn(&self, p: usize, node: usize, i: usize, out: &mut Change<D>) {
        let (mut normals, mut material) = ([0.0; D], [0.0; D]);
        for (k, b) in self.sides.beside[p].iter().enumerate() {
            let facet = &self.sides.facets[b.facet];
            let Some(l) = facet.nodes.iter().position(|&n| n == node) else { continue };
            let s = shape(facet.kind, node_at(facet.kind, b.local));
            let slopes = [s.first[0][l], s.first[1][l]];
            let mut unit = [0.0; D];
            unit[i] = 1.0;
            if D == 2 {
                axpy(&mut normals, slopes[0], &perpendicular(&[unit, unit]));
            } else {
                let e = self.sides.bases(*b, &self.x);
                axpy(&mut normals, slopes[0], &cross(&unit, &e[1]));
                axpy(&mut normals, slopes[1], &cross(&e[0], &unit));
            }
            if k == 0 {
                material[i] = self.points[p].along[0] * slopes[0] + self.points[p].along[1] * slopes[1];
            }
        }
        self.locals[p].turn(&normals, &material, out);
    }

    /// What the changing overlap of a cell adds to the blocks of its points.
    fn overlap_tangent(&self, c: &Cell, tractions: &Tractions<'_>, values: &mut [f64]) {
        let (facet, master) = (&self.sides.facets[c.facet], &self.sides.master[c.master]);
        let (s, m) = (facet.nodes.len(), master.nodes.len());
        let (own, other) = self.gather(c);
        let mut sums = Sums::<Dual<M>, NODES>::zero();
        let (x, y) = (seeded::<D, M>(&own, 0), seeded::<D, M>(&other, s * D));
        let rule = self.sides.rule(c.facet, c.master);
        if !integrate(self.sides.frozen(c.facet), &x[..s], master.kind, &y[..m], rule, &mut sums) {
            return;
        }
        for (a, &p) in facet.weighting.points.iter().enumerate() {
            let traction = traction_of(tractions, p);
            if !traction.normal.closed {
                continue;
            }
            let (point, local) = (&self.points[p], &self.locals[p]);
            let places = &self.places[c.table + a * (s + m)..][..s + m];
            let size = point.nodes.len() * D;
            let block = &mut values[point.at..point.at + size * size];
            let force = local.force(&traction);
            for q in 0..(s + m) * D {
                let column = places[q / D] * D + q % D;
                let (mut dp, mut da) = ([0.0; D], 0.0);
                for (k, &place) in places.iter().enumerate() {
                    let dw = if k < s { sums.own[a][k].d[q] } else { -sums.other[a][k - s].d[q] };
                    if k < s {
                        da += dw;
                    }
                    axpy(&mut dp, dw, if k < s { &own[k] } else { &other[k - s] });
                    for (i, f) in force.iter().enumerate() {
                        block[(place * D + i) * size + column] -= dw * f;
                    }
                }
                axpy(&mut dp, -da, &local.d);
                let dd = scaled(&dp, point.area.recip());
                let change = Change { d: dd, v: scaled(&dd, -1.0), ..Change::none() };
                point.subtract(block, size, column, &local.force_change(&traction, &change));
            }
        }
    }

    /// What the motion of a point's nodes at fixed weights adds to its block.
    fn point_tangent(&self, p: usize, traction: &Traction<'_>, values: &mut [f64]) {
        let (point, local) = (&self.points[p], &self.locals[p]);
        let size = point.nodes.len() * D;
        let block = &mut values[point.at..point.at + size * size];
        for (k, &node) in point.nodes.iter().enumerate() {
            let now = point.weights[k] / point.area;
            for i in 0..D {
                let mut change = Change::none();
                if k < point.slaves {
                    self.turn(p, node, i, &mut change);
                }
                change.d[i] = now;
                change.v[i] = point.then[k] - now;
                point.subtract(block, size, k * D + i, &local.force_change(traction, &change));
            }
        }
    }

    /// Adds the part of `slides` that comes from the changing overlap of a cell.
    fn overlap_slide(&self, c: &Cell, du: &[[f64; D]], out: &mut Slides) {
        let (facet, master) = (&self.sides.facets[c.facet], &self.sides.master[c.master]);
        let (s, m) = (facet.nodes.len(), master.nodes.len());
        let (own, other) = self.gather(c);
        let moved = |x: &[[f64; D]; NODES], nodes: &[usize]| {
            let mut out = x.map(|p| p.map(|v| Dual { v, d: [0.0] }));
            for (o, &n) in out.iter_mut().zip(nodes) {
                for i in 0..D {
                    o[i].d[0] = du[n][i];
                }
            }
            out
        };
        let (x, y) = (moved(&own, &facet.nodes), moved(&other, &master.nodes));
        let mut sums = Sums::<Dual<1>, NODES>::zero();
        let rule = self.sides.rule(c.facet, c.master);
        if !integrate(self.sides.frozen(c.facet), &x[..s], master.kind, &y[..m], rule, &mut sums) {
            return;
        }
        for (a, &p) in facet.weighting.points.iter().enumerate().filter(|(_, p)| self.points[**p].faces()) {
            let local = &self.locals[p];
            let mut dp = [0.0; D];
            for (w, x) in sums.own[a][..s].iter().zip(&own) {
                axpy(&mut dp, w.d[0], x);
                axpy(&mut dp, -w.d[0], &local.d);
            }
            for (w, x) in sums.other[a][..m].iter().zip(&other) {
                axpy(&mut dp, -w.d[0], x);
            }
            let dd = scaled(&dp, self.points[p].area.recip());
            out.gap[p] += dot(&local.n, &dd);
            for j in 0..2 {
                out.increment[p][j] -= dot(&local.frame[j], &dd);
            }
        }
    }
}

impl Point {
    /// Whether it faces the master.
    fn faces(&self) -> bool {
        self.area > FACED * self.whole
    }

    /// Keeps the present weights as those of the last commit.
    fn keep(&mut self) {
        for (then, w) in self.then.iter_mut().zip(&self.weights) {
            *then = w / self.area;
        }
        self.anchored = true;
    }

    /// Subtracts `weight δf` of every node from a column of the block.
    #[inline]
    fn subtract<const D: usize>(&self, block: &mut [f64], size: usize, column: usize, df: &[f64; D]) {
        for (k, w) in self.weights.iter().enumerate().filter(|(_, w)| **w != 0.0) {
            for (i, f) in df.iter().enumerate() {
                block[(k * D + i) * size + column] -= w * f;
            }
        }
    }
}

fn traction_of<'a>(tractions: &Tractions<'a>, p: usize) -> Traction<'a> {
    Traction {
        normal: &tractions.normal[p],
        shear: tractions.shear.map(|s| &s[p]),
        stiffness: tractions.stiffness,
    }
}

/// Positions whose coordinates are the variables from `first` on.
fn seeded<const D: usize, const M: usize>(x: &[[f64; D]; NODES], first: usize) -> [[Dual<M>; D]; NODES] {
    std::array::from_fn(|k| {
        std::array::from_fn(|i| {
            let mut d = [0.0; M];
            // Nodes a triangle does not have are not used.
            if let Some(one) = d.get_mut(first + k * D + i) {
                *one = 1.0;
            }
            Dual { v: x[k][i], d }
        })
    })
}

/// Components of the small-sliding frame's first vector in the base vectors of the first facet beside point `p`.
fn along<const D: usize>(sides: &Sides<D>, p: usize, x: &[[f64; D]]) -> [f64; 2] {
    let first: Beside = sides.beside[p][0];
    let e = sides.bases(first, x);
    let normals = sides.normal_sum(p, x);
    let frame = fixed_frame(&scaled(&normals, -norm(&normals).recip()));
    let metric = [dot(&e[0], &e[0]), dot(&e[0], &e[1]), dot(&e[1], &e[1])];
    solve_tangential(D - 1, &metric, &[dot(&e[0], &frame[0]), dot(&e[1], &frame[0])])
}

impl<const D: usize, const M: usize> Measure<D> for Finite<D, M> {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn search(&mut self, u: &[[f64; D]], projections: &mut u64) -> bool {
        self.configure(u);
        self.pair(projections);
        if self.points.iter().any(|p| !p.anchored) {
            self.anchor();
        }
        true
    }

    fn measure(&mut self, u: &[[f64; D]], out: &mut Geometry<D>) {
        self.configure(u);
        if self.restored {
            self.pair(&mut 0);
        }
        self.weigh();
        if std::mem::take(&mut self.restored) {
            self.points.iter_mut().filter(|p| p.anchored).for_each(Point::keep);
        }
        for p in 0..self.points.len() {
            self.locals[p] = self.local(p);
            let (point, local) = (&self.points[p], &self.locals[p]);
            // An area that is not a number must not pass for a point without partner.
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
        values.fill(0.0);
        for c in &self.cells {
            self.overlap_tangent(c, &tractions, values);
        }
        for p in 0..self.points.len() {
            let traction = traction_of(&tractions, p);
            if traction.normal.closed {
                self.point_tangent(p, &traction, values);
            }
        }
    }

    fn slides(&self, _geometry: &Geometry<D>, du: &[[f64; D]], out: &mut Slides) {
        for (p, point) in self.points.iter().enumerate() {
            out.gap[p] = 0.0;
            out.increment[p] = [0.0; 2];
            if !point.faces() {
                continue;
            }
            let local = &self.locals[p];
            for (k, (&n, w)) in point.nodes.iter().zip(&point.weights).enumerate() {
                out.gap[p] += w / point.area * dot(&local.n, &du[n]);
                for i in (0..D).filter(|_| k < point.slaves) {
                    let mut change = Change::none();
                    self.turn(p, n, i, &mut change);
                    out.gap[p] += du[n][i] * dot(&change.n, &local.d);
                }
            }
        }
        for c in &self.cells {
            self.overlap_slide(c, du, out);
        }
    }

    fn exit(&self, _du: &[[f64; D]]) -> Option<Exit> {
        None
    }

    fn commit(&mut self, _geometry: &Geometry<D>, _reframe: &mut dyn FnMut(usize, &[[f64; D]; 2])) {
        for point in &mut self.points {
            point.fresh = false;
            if point.faces() {
                point.keep();
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

    fn save(&self, out: &mut Vec<f64>) {
        out.extend(self.points.iter().map(|p| f64::from(u8::from(p.anchored))));
    }

    fn saved(&self) -> usize {
        self.points.len()
    }

    fn restore(&mut self, from: &[f64]) {
        for (point, v) in self.points.iter_mut().zip(from) {
            point.anchored = *v > 0.0;
            point.fresh = false;
        }
        self.restored = true;
    }
}
