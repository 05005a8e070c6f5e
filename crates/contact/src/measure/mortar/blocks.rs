//! The tangent of mortar contact in finite sliding, block by block.
//!
//! The force of a point on node k is `w_k f` with w its weights. They change with the overlap; f changes with the averaged
//! distance, which depends on the overlap and on the nodes. The change of the distance with the overlap is first summed over
//! the adjacent cells, column by column of the block. The change of the force is then distributed to the nodes once.

use super::cell::{Sums, integrate};
use super::centre::movers;
use super::facet::{Facet, NODES};
use super::local::{Change, Traction};
use super::overlap::{self, Derivatives, Gradient, MOST};
use super::scalar::Dual;
use super::state::{Cell, MortarMeasure, Point};
use crate::measure::Tractions;
use crate::vector::{axpy, scaled};
use std::sync::PoisonError;

/// Number of variables in a cell of the plane: two coordinates of the nodes of two lines of first order.
const STRAIGHT: usize = 8;

/// Most variables in a cell of the plane, with lines of three nodes.
const CURVED: usize = 12;

/// Blocks of one piece of the work order.
struct Blocks<'a, const D: usize> {
    piece: usize,
    /// Start of the first block among all values.
    start: usize,
    values: &'a mut [f64],
    /// Changes of each point's averaged distance with the overlap, by column.
    slides: &'a mut [[f64; D]],
}

impl<const D: usize> Blocks<'_, D> {
    /// Block of a point of the piece, and the changes of its averaged distance.
    #[inline]
    fn point_block(&mut self, point: &Point) -> (&mut [f64], &mut [[f64; D]]) {
        let (at, size) = (point.at - self.start, point.nodes.len() * D);
        (&mut self.values[at..at + size * size], &mut self.slides[point.column..point.column + size])
    }
}

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
        values.fill(0.0);
        let mut slides = self.scratch[from].0.lock().unwrap_or_else(PoisonError::into_inner);
        slides.fill([0.0; D]);
        let closed = |p: usize| tractions.normal[p].closed;
        let mut blocks = Blocks { piece: from, start: start(from), values, slides: &mut slides };
        let mut slopes = Derivatives::zero();
        for &f in self.order.facets(from) {
            let points = &self.sides.facets[f].weighting.points;
            if points.iter().any(|&p| self.order.piece(p) == from && closed(p)) {
                for c in self.cells_of(f) {
                    let overlaps = if D == 2 {
                        let linear = self.facets(c).iter().all(|facet| facet.face.kind.first_order());
                        if linear {
                            self.slopes_of_lines::<STRAIGHT>(c, &mut slopes)
                        } else {
                            self.slopes_of_lines::<CURVED>(c, &mut slopes)
                        }
                    } else {
                        self.slopes_of_faces(c, &mut slopes)
                    };
                    if overlaps {
                        self.overlap_tangent(c, &slopes, tractions, &mut blocks);
                    }
                }
            }
        }
        for &p in self.order.points(from) {
            if closed(p) {
                self.point_tangent(p, &traction_of(tractions, p), &mut blocks);
            }
        }
    }

    /// Computes the derivatives of the integrals of a cell in the plane. Returns false if the facets do not overlap.
    fn slopes_of_lines<const M: usize>(&self, c: &Cell, out: &mut Derivatives) -> bool {
        let [slave, master] = self.facets(c);
        let ((own, s), (other, m)) = (self.gather(slave), self.gather(master));
        let mut sums = Sums::<Dual<M>, NODES>::zero();
        let (x, y) = (seeded::<D, M>(&own, 0), seeded::<D, M>(&other, s * D));
        let rule = self.sides.rule(c.facet, c.master);
        if !integrate(self.sides.frozen(c.facet), &x[..s], master, &y[..m], rule, &mut sums) {
            return false;
        }
        let put = |number: &Dual<M>, to: &mut Gradient| {
            for (d, j) in number.d.chunks_exact(D).zip((0..s).chain(MOST..MOST + m)) {
                to[j][..D].copy_from_slice(d);
            }
        };
        for (numbers, rows) in [(&sums.own, &mut out.own), (&sums.other, &mut out.other)] {
            for (numbers, row) in numbers.iter().zip(rows) {
                numbers.iter().zip(row).for_each(|(number, to)| put(number, to));
            }
        }
        true
    }

    /// Computes the derivatives of the integrals of a cell in space. Returns false if the facets do not overlap.
    fn slopes_of_faces(&self, c: &Cell, out: &mut Derivatives) -> bool {
        self.in_space(c, |facets| overlap::derivatives(facets, out))
    }

    /// Adds the contribution of a cell's changing overlap to the blocks of those of its points that belong to the piece.
    fn overlap_tangent(
        &self,
        c: &Cell,
        slopes: &Derivatives,
        tractions: &Tractions<'_>,
        blocks: &mut Blocks<'_, D>,
    ) {
        let [slave, master] = self.facets(c);
        let n = slave.face.nodes.len() + master.face.nodes.len();
        let weighting = &self.sides.facets[c.facet].weighting;
        for (a, &p) in weighting.points.iter().enumerate() {
            let traction = traction_of(tractions, p);
            if !traction.normal.closed || self.order.piece(p) != blocks.piece {
                continue;
            }
            let local = &self.locals[p];
            let (mine, others) = self.places[c.table + a * n..][..n].split_at(slave.face.nodes.len());
            let (columns, count) = columns([slave, master], [mine, others]);
            let force = local.force(&traction);
            let mut changes =
                WeightChanges { point: &self.points[p], force, columns: &columns[..count], blocks };
            weighting.sum(a, |share, b| {
                for ((&node, &place), slope) in slave.face.nodes.iter().zip(mine).zip(&slopes.own[b]) {
                    // Distance from the mean, since the slave's weights change the area too.
                    let mut arm = self.x[node];
                    axpy(&mut arm, -1.0, &local.d);
                    changes.add(place, share, &arm, slope);
                }
                for ((&node, &place), slope) in master.face.nodes.iter().zip(others).zip(&slopes.other[b]) {
                    changes.add(place, -share, &self.x[node], slope);
                }
            });
        }
    }

    /// Adds to a point's block the motion of its nodes at fixed weights and the change of its averaged distance.
    fn point_tangent(&self, p: usize, traction: &Traction<'_>, blocks: &mut Blocks<'_, D>) {
        let (point, local) = (&self.points[p], &self.locals[p]);
        let (block, slides) = blocks.point_block(point);
        let size = slides.len();
        for (k, &node) in point.nodes.iter().enumerate() {
            let now = point.weights[k] / point.area;
            for i in 0..D {
                let mut change = Change::none();
                if k < point.slaves {
                    self.turn(p, node, i, &mut change);
                }
                let column = k * D + i;
                change.d = slides[column];
                change.v = scaled(&slides[column], -1.0);
                change.d[i] += now;
                change.v[i] += point.then[k] - now;
                slides[column] = local.force_change(traction, &change);
            }
        }
        // Subtract weight times δf for every node, row by row.
        for (k, &w) in point.weights.iter().enumerate().filter(|(_, w)| **w != 0.0) {
            for (i, row) in block[k * D * size..(k + 1) * D * size].chunks_exact_mut(size).enumerate() {
                row.iter_mut().zip(slides.iter()).for_each(|(r, df)| *r -= w * df[i]);
            }
        }
    }
}

/// Slot of a node or middle in a gradient, place in a point's block of a node that moves it, and the node's share.
type Column = (usize, usize, f64);

/// Most columns of a cell: of two faces with eight nodes and their middle, which moves with all of them.
const MOST_COLUMNS: usize = 2 * (8 + 8);

/// Computes the columns of a cell, from the `places` of the nodes of both faces. Also returns their number.
fn columns(facets: [&Facet; 2], places: [&[usize]; 2]) -> ([Column; MOST_COLUMNS], usize) {
    let (mut out, mut count) = ([(0, 0, 0.0); MOST_COLUMNS], 0);
    for (side, (facet, places)) in facets.into_iter().zip(places).enumerate() {
        for (slot, _) in facet.movers().enumerate() {
            for (node, share) in movers(facet.face.kind, slot) {
                out[count] = (side * MOST + slot, places[node], share);
                count += 1;
            }
        }
    }
    (out, count)
}

/// Block of a point to which the changes of its weights are added.
struct WeightChanges<'a, 'b, const D: usize> {
    point: &'a Point,
    force: [f64; D],
    columns: &'a [Column],
    blocks: &'a mut Blocks<'b, D>,
}

impl<const D: usize> WeightChanges<'_, '_, D> {
    /// Adds the change of the weight of the node at `place` of the block, which is `sign` times this slope (of either sign, and less where a function is shared); `arm` is its lever in the
    /// averaged distance.
    #[inline]
    fn add(&mut self, place: usize, sign: f64, arm: &[f64; D], slope: &Gradient) {
        let (block, slides) = self.blocks.point_block(self.point);
        let (size, share) = (slides.len(), self.point.area.recip());
        let rows = &mut block[place * D * size..(place * D + D) * size];
        for &(slot, column, moved) in self.columns {
            let dw: [f64; D] = std::array::from_fn(|l| sign * moved * slope[slot][l]);
            for (row, f) in rows.chunks_exact_mut(size).zip(&self.force) {
                axpy_at(row, column * D, -f, &dw);
            }
            for (slide, dw) in slides[column * D..column * D + D].iter_mut().zip(&dw) {
                axpy(slide, share * dw, arm);
            }
        }
    }
}

/// `row[at + l] += c v_l`.
#[inline]
fn axpy_at<const D: usize>(row: &mut [f64], at: usize, c: f64, v: &[f64; D]) {
    row[at..at + D].iter_mut().zip(v).for_each(|(r, v)| *r += c * v);
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
