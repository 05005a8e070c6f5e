//! The tangent of mortar contact in finite sliding, block by block.
//!
//! The force of a point on node k is `w_k f` with w its weights. They change with the overlap; f changes with the averaged
//! distance, which depends on the overlap and on the nodes. The change of the distance with the overlap is first summed over
//! the adjacent cells, column by column of the block. The change of the force is then distributed to the nodes once.

use super::cell::{Sums, integrate};
use super::local::{Change, Traction};
use super::overlap::{self, BOTH, Derivatives, NODES};
use super::scalar::Dual;
use super::state::{Cell, MortarMeasure, Point};
use crate::measure::Tractions;
use crate::vector::{axpy, scaled};
use std::sync::PoisonError;

/// Number of variables in a cell of the plane: two coordinates of the two nodes of two facets.
const LINES: usize = 8;

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
        let mut slopes = [[[[0.0; 3]; BOTH]; BOTH]; NODES];
        for &f in self.order.facets(from) {
            let points = &self.sides.facets[f].weighting.points;
            if points.iter().any(|&p| self.order.piece(p) == from && closed(p)) {
                for c in self.cells_of(f) {
                    let overlaps = if D == 2 {
                        self.slopes_of_lines(c, &mut slopes)
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

    /// Computes the derivatives of the weights of a cell in the plane, by row; those of the master without their sign. Returns
    /// false if the facets do not overlap.
    fn slopes_of_lines(&self, c: &Cell, out: &mut Derivatives) -> bool {
        let (facet, master) = (&self.sides.facets[c.facet], &self.sides.master[c.master]);
        let (s, m) = (facet.nodes.len(), master.nodes.len());
        let (own, other) = self.gather(c);
        let mut sums = Sums::<Dual<LINES>, NODES>::zero();
        let (x, y) = (seeded::<D, LINES>(&own, 0), seeded::<D, LINES>(&other, s * D));
        let rule = self.sides.rule(c.facet, c.master);
        if !integrate(self.sides.frozen(c.facet), &x[..s], master.kind, &y[..m], rule, &mut sums) {
            return false;
        }
        for (row, (own, other)) in out.iter_mut().zip(sums.own.iter().zip(&sums.other)) {
            let numbers = own[..s].iter().chain(&other[..m]);
            for (number, k) in numbers.zip((0..s).chain(NODES..NODES + m)) {
                for (d, j) in number.d.chunks_exact(D).zip((0..s).chain(NODES..NODES + m)) {
                    row[k][j][..D].copy_from_slice(d);
                }
            }
        }
        true
    }

    /// Computes the derivatives of the weights of a cell in space, in the layout of [`MortarMeasure::slopes_of_lines`].
    fn slopes_of_faces(&self, c: &Cell, out: &mut Derivatives) -> bool {
        let overlaps = self.in_space(c, |facets| {
            let mut raw = [[[[0.0; 3]; BOTH]; BOTH]; NODES];
            overlap::derivatives(facets, &mut raw).then_some(raw)
        });
        let Some(raw) = overlaps else { return false };
        let weighting = &self.sides.facets[c.facet].weighting;
        for (a, row) in out.iter_mut().enumerate().take(weighting.points.len()) {
            row.as_flattened_mut().fill([0.0; 3]);
            for (b, from) in raw.iter().enumerate() {
                let share = weighting.coefficient(a, b);
                if share != 0.0 {
                    let (to, from) =
                        (row.as_flattened_mut().as_flattened_mut(), from.as_flattened().as_flattened());
                    to.iter_mut().zip(from).for_each(|(t, v)| *t += share * v);
                }
            }
        }
        true
    }

    /// Adds the contribution of a cell's changing overlap to the blocks of those of its points that belong to the piece.
    fn overlap_tangent(
        &self,
        c: &Cell,
        slopes: &Derivatives,
        tractions: &Tractions<'_>,
        blocks: &mut Blocks<'_, D>,
    ) {
        let (facet, master) = (&self.sides.facets[c.facet], &self.sides.master[c.master]);
        let (s, m) = (facet.nodes.len(), master.nodes.len());
        let (own, other) = self.gather(c);
        for (a, &p) in facet.weighting.points.iter().enumerate() {
            let traction = traction_of(tractions, p);
            if !traction.normal.closed || self.order.piece(p) != blocks.piece {
                continue;
            }
            let local = &self.locals[p];
            let arm = |slot: usize| {
                if slot >= NODES {
                    return other[slot - NODES];
                }
                // Distance from the mean, since the slave's weights change the area too.
                let mut arm = own[slot];
                axpy(&mut arm, -1.0, &local.d);
                arm
            };
            let places = &self.places[c.table + a * (s + m)..][..s + m];
            // Slots of the slave's nodes, followed by those of the master.
            let nodes = (0..s).chain(NODES..NODES + m).zip(places.iter().copied());
            add_weight_changes(&self.points[p], &slopes[a], &local.force(&traction), nodes, arm, blocks);
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

/// Adds the changes of a point's weights to its block. `nodes` are the slots of a cell's nodes with their places in the block; `arm`
/// is the lever of the weight of a slot in the averaged distance.
#[inline]
fn add_weight_changes<const D: usize>(
    point: &Point,
    slopes: &[[[f64; 3]; BOTH]; BOTH],
    force: &[f64; D],
    nodes: impl Iterator<Item = (usize, usize)> + Clone,
    arm: impl Fn(usize) -> [f64; D],
    blocks: &mut Blocks<'_, D>,
) {
    let (block, slides) = blocks.point_block(point);
    let size = slides.len();
    let share = point.area.recip();
    for (k, place) in nodes.clone() {
        let sign = if k < NODES { 1.0 } else { -1.0 };
        let arm = arm(k);
        let rows = &mut block[place * D * size..(place * D + D) * size];
        for (j, column) in nodes.clone() {
            let dw: [f64; D] = std::array::from_fn(|l| sign * slopes[k][j][l]);
            for (row, f) in rows.chunks_exact_mut(size).zip(force) {
                axpy_at(row, column * D, -f, &dw);
            }
            for (slide, dw) in slides[column * D..column * D + D].iter_mut().zip(&dw) {
                axpy(slide, share * dw, &arm);
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
fn seeded<const D: usize, const M: usize>(x: &[[f64; D]; NODES], first: usize) -> [[Dual<M>; D]; NODES] {
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
