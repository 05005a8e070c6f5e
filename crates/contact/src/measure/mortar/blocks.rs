//! The tangent of mortar contact in finite sliding, block by block.
//!
//! The force of a point on node k is `w_k f` with w its weights. They change with the overlap; f changes with the averaged
//! distance, which depends on the overlap and on the nodes. The changes of the weights with the overlap are first summed over the
//! adjacent cells, column by column of the block. Both parts of the change of force are then written at once.

use super::cell::{Sums, integrate};
use super::centre::movers;
use super::facet::{Facet, NODES};
use super::local::{Change, Traction};
use super::overlap::{self, Derivatives, MOST, Products};
use super::scalar::Dual;
use super::state::{Cell, MortarMeasure, Point};
use crate::measure::Tractions;
use crate::vector::{axpy, sub};

/// Number of variables in a cell of the plane: two coordinates of the nodes of two lines of three nodes.
const CURVED: usize = 12;

impl<const D: usize> MortarMeasure<D> {
    /// Writes the blocks of the pieces `from..to` of the work order.
    pub(super) fn blocks(&self, from: usize, to: usize, tractions: &Tractions<'_>, values: &mut [f64]) {
        let start = |piece: usize| self.order.points(piece).first().map_or(0, |&p| self.points[p].at);
        if to - from > 1 {
            let middle = from + (to - from) / 2;
            let (left, right) = values.split_at_mut(start(middle) - start(from));
            rayon::join(
                || self.blocks(from, middle, tractions, left),
                || self.blocks(middle, to, tractions, right),
            );
            return;
        }
        let closed = |p: usize| tractions.normal[p].closed;
        if !self.order.points(from).iter().any(|&p| closed(p)) {
            values.fill(0.0);
            return;
        }
        let mut buffers = self.buffers.take();
        self.sum_slopes(from, closed, &mut buffers.weights);
        let mut blocks = values;
        for &p in self.order.points(from) {
            let point = &self.points[p];
            let size = point.nodes.len() * D;
            let (block, rest) = blocks.split_at_mut(size * size);
            blocks = rest;
            let traction = traction_of(tractions, p);
            if !traction.normal.closed {
                block.fill(0.0);
                continue;
            }
            let weights = &buffers.weights[point.slopes..][..slopes::<D>(point)];
            self.distance_changes(p, weights, &mut buffers.changes);
            self.turns(p, &mut buffers.turns);
            self.force_changes(p, &traction, &buffers.turns, &mut buffers.changes);
            write(point, &self.locals[p].force(&traction), weights, &buffers.changes, block);
        }
        self.buffers.keep(buffers);
    }

    /// Sums the slopes of the weights of the closed points of a piece over their cells.
    fn sum_slopes(&self, piece: usize, closed: impl Fn(usize) -> bool, out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.order.points(piece).iter().map(|&p| slopes::<D>(&self.points[p])).sum(), 0.0);
        let wanted = |p: usize| self.order.piece(p) == piece && closed(p);
        let (mut linear, mut general) = (Derivatives::<NODES>::zero(), Derivatives::<MOST>::zero());
        for &f in self.order.facets(piece) {
            if !self.sides.facets[f].weighting.points.iter().any(|&p| wanted(p)) {
                continue;
            }
            for c in self.cells_of(f) {
                if self.linear(c) {
                    if self.linear_slopes(c, &mut linear) {
                        self.add_slopes(c, &linear, wanted, out);
                    }
                } else if self.general_slopes(c, &mut general) {
                    self.add_slopes(c, &general, wanted, out);
                }
            }
        }
    }

    /// Computes the derivatives of the integrals of a cell between faces of first order. Returns false if they do not overlap.
    fn linear_slopes(&self, c: &Cell, out: &mut Derivatives<NODES>) -> bool {
        if D == 2 {
            let Some(lines) = self.lines(c) else { return false };
            lines.derivatives(&self.sides.rule(c.facet, c.master).line, out);
            return true;
        }
        self.in_space(c, |facets| overlap::derivatives::<NODES>(facets, out))
    }

    /// Computes the derivatives of the integrals of a cell. Returns false if the facets do not overlap.
    fn general_slopes(&self, c: &Cell, out: &mut Derivatives<MOST>) -> bool {
        if D == 2 {
            return self.slopes_of_lines(c, out);
        }
        self.in_space(c, |facets| overlap::derivatives::<MOST>(facets, out))
    }

    /// Computes the derivatives of the integrals of a cell in the plane. Returns false if the facets do not overlap.
    fn slopes_of_lines(&self, c: &Cell, out: &mut Derivatives<MOST>) -> bool {
        let [slave, master] = self.facets(c);
        let ((own, s), (other, m)) = (self.gather(slave), self.gather(master));
        let mut sums = Sums::<Dual<CURVED>, NODES>::zero();
        let (x, y) = (seeded(&own, 0), seeded(&other, s * D));
        let rule = self.sides.rule(c.facet, c.master);
        if !integrate(self.sides.frozen(c.facet), &x[..s], master, &y[..m], rule, &mut sums) {
            return false;
        }
        let places = (0..s).map(|j| (0, j)).chain((0..m).map(|j| (1, j)));
        for (variable, (side, j)) in places.enumerate() {
            for (l, to) in out.by[side][j][..D].iter_mut().enumerate() {
                let slope = |number: &Dual<CURVED>| number.d[variable * D + l];
                for (b, (own, other)) in sums.own.iter().zip(&sums.other).enumerate() {
                    to.own[b].iter_mut().zip(own).for_each(|(to, number)| *to = slope(number));
                    to.other[b].iter_mut().zip(other).for_each(|(to, number)| *to = slope(number));
                }
            }
        }
        true
    }

    /// Adds the derivatives of the integrals of a cell to the slopes of the weights of those of its points that are wanted.
    fn add_slopes<const F: usize>(
        &self,
        c: &Cell,
        derivatives: &Derivatives<F>,
        wanted: impl Fn(usize) -> bool,
        out: &mut [f64],
    ) {
        let [slave, master] = self.facets(c);
        let (s, m) = (slave.face.nodes.len(), master.face.nodes.len());
        let weighting = &self.sides.facets[c.facet].weighting;
        for (a, &p) in weighting.points.iter().enumerate().filter(|(_, p)| wanted(**p)) {
            let point = &self.points[p];
            let (own, other) = self.places[c.table + a * (s + m)..][..s + m].split_at(s);
            let (columns, count) = columns([slave, master], [own, other]);
            let rows = &mut out[point.slopes..][..slopes::<D>(point)];
            let size = point.nodes.len() * D;
            let columns = &columns[..count];
            weighting.sum(a, |share, b| {
                for (k, &place) in own.iter().enumerate() {
                    let row = &mut rows[place * size..][..size];
                    add_row::<D, F>(row, columns, derivatives, |by| share * by.own[b][k]);
                }
                for (k, &place) in other.iter().enumerate() {
                    let shared = (place < point.slaves).then_some(point.nodes.len());
                    for place in [Some(place), shared].into_iter().flatten() {
                        let row = &mut rows[place * size..][..size];
                        add_row::<D, F>(row, columns, derivatives, |by| -share * by.other[b][k]);
                    }
                }
            });
        }
    }

    /// Computes the changes of a point's averaged distance with its weights, a row for each axis.
    fn distance_changes(&self, p: usize, weights: &[f64], out: &mut Vec<f64>) {
        let (point, local) = (&self.points[p], &self.locals[p]);
        let (size, share) = (point.nodes.len() * D, point.area.recip());
        out.clear();
        out.resize(D * size, 0.0);
        let mut add = |arm: &[f64; D], slopes: &[f64]| {
            for (to, arm) in out.chunks_exact_mut(size).zip(arm) {
                let c = share * arm;
                to.iter_mut().zip(slopes).for_each(|(to, slope)| *to += c * slope);
            }
        };
        // The weights of both sides are equal in sum, so that positions may be relative to any point. Those of the slave change the
        // area, by which the distance is divided.
        let origin = self.x[point.nodes[0]];
        for (k, (&node, slopes)) in point.nodes.iter().zip(weights.chunks_exact(size)).enumerate() {
            let mut arm = sub(&self.x[node], &origin);
            if k < point.slaves {
                axpy(&mut arm, -1.0, &local.d);
            }
            add(&arm, slopes);
        }
        add(&local.d, &weights[point.nodes.len() * size..]);
    }

    /// Computes the changes of a point's force from those of its averaged distance, which they replace, and of its frame.
    fn force_changes(&self, p: usize, traction: &Traction<'_>, turns: &[Change<D>], changes: &mut [f64]) {
        let (point, local) = (&self.points[p], &self.locals[p]);
        let size = point.nodes.len() * D;
        for (k, (w, then)) in point.weights.iter().zip(&point.then).enumerate() {
            let now = w / point.area;
            for i in 0..D {
                let column = k * D + i;
                let mut change = turns.get(column).copied().unwrap_or_else(Change::none);
                change.d = std::array::from_fn(|j| changes[j * size + column]);
                change.d[i] += now;
                change.v[i] += then;
                let df = local.force_change(traction, &change);
                df.iter().enumerate().for_each(|(j, df)| changes[j * size + column] = *df);
            }
        }
    }
}

/// Number of the slopes of a point's weights: a row for each node, and one for what nodes of the slave carry as nodes of the master
/// (the tip of a split surface).
pub(super) fn slopes<const D: usize>(point: &Point) -> usize {
    let n = point.nodes.len();
    (n + 1) * n * D
}

/// Writes the block of a point with force `f` on its nodes: `-δw_k f - w_k δf`.
fn write<const D: usize>(
    point: &Point,
    force: &[f64; D],
    weights: &[f64],
    changes: &[f64],
    block: &mut [f64],
) {
    let size = point.nodes.len() * D;
    let nodes = point.weights.iter().zip(weights.chunks_exact(size));
    for ((w, slopes), rows) in nodes.zip(block.chunks_exact_mut(D * size)) {
        for ((row, f), df) in rows.chunks_exact_mut(size).zip(force).zip(changes.chunks_exact(size)) {
            for ((to, slope), df) in row.iter_mut().zip(slopes).zip(df) {
                *to = -(f * slope + w * df);
            }
        }
    }
}

/// Side and slot of a node or middle in a gradient, place in a point's block of a node that moves it, and the node's share.
type Column = (usize, usize, usize, f64);

/// Most columns of a cell: of two faces with eight nodes and their middle, which moves with all of them.
const MOST_COLUMNS: usize = 2 * (8 + 8);

/// Computes the columns of a cell, from the `places` of the nodes of both faces. Also returns their number.
fn columns(facets: [&Facet; 2], places: [&[usize]; 2]) -> ([Column; MOST_COLUMNS], usize) {
    let (mut out, mut count) = ([(0, 0, 0, 0.0); MOST_COLUMNS], 0);
    for (side, (facet, places)) in facets.into_iter().zip(places).enumerate() {
        for (slot, _) in facet.movers().enumerate() {
            for (node, share) in movers(facet.face.kind, slot) {
                out[count] = (side, slot, places[node], share);
                count += 1;
            }
        }
    }
    (out, count)
}

/// Adds a slope of the derivatives to a row of a block.
#[inline]
fn add_row<const D: usize, const F: usize>(
    row: &mut [f64],
    columns: &[Column],
    derivatives: &Derivatives<F>,
    slope: impl Fn(&Products<F>) -> f64,
) {
    for &(side, slot, column, moved) in columns {
        let by = &derivatives.by[side][slot];
        let to = &mut row[column * D..column * D + D];
        to.iter_mut().zip(by).for_each(|(to, by)| *to += moved * slope(by));
    }
}

pub(super) fn traction_of<'a>(tractions: &Tractions<'a>, p: usize) -> Traction<'a> {
    Traction {
        normal: &tractions.normal[p],
        shear: tractions.shear.map(|s| &s[p]),
        stiffness: tractions.stiffness,
    }
}

/// Positions whose coordinates are the variables numbered from `first`.
fn seeded<const D: usize, const M: usize>(x: &[[f64; D]; MOST], first: usize) -> [[Dual<M>; D]; MOST] {
    std::array::from_fn(|k| {
        std::array::from_fn(|i| {
            let mut d = [0.0; M];
            // Slots beyond a facet's nodes are unused.
            if let Some(one) = d.get_mut(first + k * D + i) {
                *one = 1.0;
            }
            Dual { v: x[k][i], d }
        })
    })
}
