//! Intersection of convex polygons whose corners record the nodes on which they depend. `clip` does the same for numbers that
//! carry derivatives.

use super::clip::{PARALLEL, twice_area};
use crate::vector::{dot, sub};

/// Pair of nodes: an edge of a facet and the line through it.
type Line = [usize; 2];

/// Dependence of a corner on nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Crossing {
    /// The corner is a node.
    None(usize),
    /// The corner is the intersection of two lines.
    Of([Line; 2]),
}

/// A corner, with the line of the edge that leaves it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: [f64; 2],
    pub of: Crossing,
    line: Line,
}

/// A convex polygon, counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    pub corners: usize,
    pub at: [Corner; Polygon::MOST],
}

impl Polygon {
    /// Largest number of corners. The intersection of two quadrilaterals has at most 8, since each cut adds one; two are spare
    /// for rounding.
    pub(super) const MOST: usize = 10;

    fn empty() -> Self {
        let nowhere = Corner { at: [0.0; 2], of: Crossing::None(0), line: [0; 2] };
        Self { corners: 0, at: [nowhere; Self::MOST] }
    }

    /// Makes a polygon from positions and nodes, in order.
    pub(super) fn from_nodes(nodes: impl Iterator<Item = ([f64; 2], usize)>) -> Self {
        let mut out = Self::empty();
        nodes.for_each(|(at, v)| out.push(Corner { at, of: Crossing::None(v), line: [v; 2] }));
        for k in 0..out.corners {
            if let Crossing::None(next) = out.at[(k + 1) % out.corners].of {
                out.at[k].line[1] = next;
            }
        }
        out
    }

    fn push(&mut self, corner: Corner) {
        if self.corners < Self::MOST {
            self.at[self.corners] = corner;
            self.corners += 1;
        }
    }

    /// Twice the area of the polygon.
    pub(super) fn twice_area(&self) -> f64 {
        (2..self.corners).map(|k| twice_area(&self.at[0].at, &self.at[k - 1].at, &self.at[k].at)).sum()
    }

    /// Centroid of the polygon's area.
    pub(super) fn centroid(&self) -> [f64; 2] {
        let o = self.at[0].at;
        let (mut whole, mut sum) = (0.0, [0.0; 2]);
        for k in 2..self.corners {
            let (a, b) = (&self.at[k - 1].at, &self.at[k].at);
            let double = twice_area(&o, a, b);
            whole += double;
            (0..2).for_each(|i| sum[i] += double * (a[i] - o[i] + b[i] - o[i]));
        }
        std::array::from_fn(|i| o[i] + sum[i] / (3.0 * whole))
    }

    /// Slopes of the centroid with respect to each corner in turn, `δ(centroid)_i = Σ c[i][m] δ(corner)_m`. The centroid is
    /// `Σ (p_k + p_k+1) (p_k × p_k+1) / (3 Σ p_k × p_k+1)` about any origin, here about the centroid itself.
    pub(super) fn centroid_slopes(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let (n, centroid) = (self.corners, self.centroid());
        let of = move |k: usize| sub(&self.at[k % n].at, &centroid);
        let flat = |a: &[f64; 2], b: &[f64; 2]| a[0] * b[1] - a[1] * b[0];
        let share = (3.0 * self.twice_area()).recip();
        (0..n).map(move |k| {
            let (before, here, after) = (of(k + n - 1), of(k), of(k + 1));
            let products = flat(&before, &here) + flat(&here, &after);
            // Slopes of both products with respect to this corner.
            let (left, right) = ([-before[1], before[0]], [after[1], -after[0]]);
            std::array::from_fn(|i| {
                std::array::from_fn(|m| {
                    let along = (before[i] + here[i]) * left[m] + (here[i] + after[i]) * right[m];
                    share * (along + if i == m { products } else { 0.0 })
                })
            })
        })
    }

    /// True if the bounding boxes of two polygons do not overlap.
    pub(super) fn apart(&self, other: &Self) -> bool {
        let range = |p: &Self, i: usize| {
            let values = p.at[..p.corners].iter().map(|c| c.at[i]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
        };
        (0..2).any(|i| {
            let ((al, ah), (bl, bh)) = (range(self, i), range(other, i));
            ah <= bl || bh <= al
        })
    }

    /// Part of the polygon inside another convex polygon (Sutherland and Hodgman 1974).
    pub(super) fn clipped(&self, other: &Self, nodes: &[[f64; 2]]) -> Self {
        let mut out = *self;
        for k in 0..other.corners {
            out = out.left_of(other.at[k].line, nodes);
            if out.corners < 3 {
                return Self::empty();
            }
        }
        out
    }

    fn left_of(&self, line: Line, nodes: &[[f64; 2]]) -> Self {
        let mut out = Self::empty();
        let side = |c: &Corner| twice_area(&nodes[line[0]], &nodes[line[1]], &c.at);
        let mut from = &self.at[self.corners - 1];
        let mut s = side(from);
        for to in &self.at[..self.corners] {
            let t = side(to);
            if (s < 0.0) != (t < 0.0) {
                let c = s / (s - t);
                let at = std::array::from_fn(|i| from.at[i] + c * (to.at[i] - from.at[i]));
                let leaving = if s < 0.0 { from.line } else { line };
                out.push(Corner { at, of: Crossing::Of([from.line, line]), line: leaving });
            }
            if t >= 0.0 {
                out.push(*to);
            }
            (from, s) = (to, t);
        }
        out
    }
}

impl Corner {
    /// Nodes on which the intersection of two lines depends, with `δ(corner)_i = Σ c[i][m] δ(node)_m`. The intersection stays
    /// on both lines; normal to each it moves with the interpolated motion of the line's nodes. If the lines nearly coincide,
    /// it is a material point of the first.
    pub(super) fn slopes(&self, lines: &[Line; 2], nodes: &[[f64; 2]]) -> [(usize, [[f64; 2]; 2]); 4] {
        let ends = lines.map(|l| l.map(|v| nodes[v]));
        let along = ends.map(|[a, b]| sub(&b, &a));
        let share: [f64; 2] =
            std::array::from_fn(|l| dot(&sub(&self.at, &ends[l][0]), &along[l]) / dot(&along[l], &along[l]));
        let [d, e] = along;
        let product = d[0] * e[1] - d[1] * e[0];
        let square = dot(&d, &d) * dot(&e, &e);
        if product * product <= PARALLEL * PARALLEL * square {
            let unit = |c: f64| [[c, 0.0], [0.0, c]];
            let [v, w] = lines[0];
            return [(v, unit(1.0 - share[0])), (w, unit(share[0])), (v, unit(0.0)), (w, unit(0.0))];
        }
        // Arguments: direction of the motion, and direction of the moving line, whose normal enters. Divided by the cross
        // product.
        let block = |t: [f64; 2], of: [f64; 2], c: f64| -> [[f64; 2]; 2] {
            let normal = [-of[1], of[0]];
            std::array::from_fn(|i| std::array::from_fn(|m| c * t[i] * normal[m] / product))
        };
        let [[p, q], [r, s]] = *lines;
        [
            (p, block(e, d, 1.0 - share[0])),
            (q, block(e, d, share[0])),
            (r, block(d, e, share[1] - 1.0)),
            (s, block(d, e, -share[1])),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODES: [[f64; 2]; 8] = [
        [-1.0, -1.0],
        [1.1, -0.9],
        [1.0, 1.0],
        [-0.9, 1.2],
        [0.0, -1.4],
        [1.5, 0.1],
        [0.1, 1.3],
        [-1.3, 0.0],
    ];

    fn common(nodes: &[[f64; 2]; 8]) -> Polygon {
        let part = |range: std::ops::Range<usize>| Polygon::from_nodes(range.map(|v| (nodes[v], v)));
        part(0..4).clipped(&part(4..8), nodes)
    }

    #[test]
    fn two_quadrilaterals_across_each_other_meet_in_an_octagon_of_crossings() {
        let found = common(&NODES);
        assert_eq!(found.corners, 8);
        assert!(found.at[..8].iter().all(|c| matches!(c.of, Crossing::Of([a, b]) if a[0] < 4 && b[0] >= 4)));
    }

    #[test]
    fn a_polygon_inside_keeps_its_nodes_and_one_apart_is_empty() {
        let mut nodes = NODES;
        nodes[..4].iter_mut().flatten().for_each(|v| *v *= 0.1);
        let found = common(&nodes);
        assert_eq!(found.corners, 4);
        assert!((0..4).all(|k| found.at[k].of == Crossing::None(k)));
        nodes[..4].iter_mut().for_each(|p| p[0] += 9.0);
        assert_eq!(common(&nodes).corners, 0);
    }

    #[test]
    fn corners_move_as_their_slopes_say() {
        let (before, h) = (common(&NODES), 1e-6);
        for v in 0..8 {
            for m in 0..2 {
                let moved = |by: f64| {
                    let mut nodes = NODES;
                    nodes[v][m] += by;
                    common(&nodes)
                };
                let (plus, minus) = (moved(h), moved(-h));
                for k in 0..before.corners {
                    let Crossing::Of(lines) = before.at[k].of else { panic!("a node") };
                    let mut expected = [0.0; 2];
                    for (w, c) in before.at[k].slopes(&lines, &NODES) {
                        (0..2).for_each(|i| expected[i] += if w == v { c[i][m] } else { 0.0 });
                    }
                    for (i, e) in expected.iter().enumerate() {
                        let found = (plus.at[k].at[i] - minus.at[k].at[i]) / (2.0 * h);
                        assert!((found - e).abs() < 1e-8, "{k} {v} {m}: {found} {e}");
                    }
                }
            }
        }
    }
}
