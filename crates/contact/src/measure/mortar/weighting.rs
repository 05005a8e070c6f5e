//! Weighting functions ψ_A that average the gap to slave nodes: a non-negative partition of unity.
//!
//! On first-order faces they are the shape functions. Second-order shape functions are negative in places, and on six-node
//! triangles and eight-node quadrilaterals the integral of a corner's function is zero or negative, so no average can be taken
//! with it. On these faces a share of each mid-node's function is given to the ends of its edge. The share is 1/4 on lines,
//! triangles and nine-node quadrilaterals, which yields the Bernstein polynomials of second degree, and 3/8 on eight-node
//! quadrilaterals.
//!
//! Any partition of unity transmits a uniform pressure exactly, because `Σ_A ψ_A p = p`. A non-negative one also excludes
//! tensile tractions between the nodes.

use crate::SegmentKind;
use crate::shape::{MOST_NODES, Shape};
use crate::spec::{Segment, SlavePoint};

/// Functions ψ_a = Σ_B c_aB N_B on one facet, one row for each of its points.
#[derive(Clone, Debug)]
pub(super) struct Weighting {
    /// Slave point of each row.
    pub points: Vec<usize>,
    rows: Vec<[f64; MOST_NODES]>,
}

impl Weighting {
    /// Makes the functions of a facet. `point_of` gives the slave point of a local node. The function of a node without one
    /// (the tip of a split surface) is divided equally among the others.
    pub(super) fn new(kind: SegmentKind, point_of: impl Fn(usize) -> Option<usize>) -> Self {
        let all: Vec<[f64; MOST_NODES]> = (0..kind.nodes()).map(|k| row(kind, k)).collect();
        let mut out = Self { points: Vec::new(), rows: Vec::new() };
        let mut orphaned = [0.0; MOST_NODES];
        for (k, own) in all.into_iter().enumerate() {
            if let Some(p) = point_of(k) {
                out.points.push(p);
                out.rows.push(own);
            } else {
                add(&mut orphaned, 1.0, &own);
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "at most nine rows")]
        let share = 1.0 / out.rows.len() as f64;
        for r in &mut out.rows {
            add(r, share, &orphaned);
        }
        out
    }

    /// Coefficient c_aB.
    #[inline]
    pub(super) fn coefficient(&self, row: usize, node: usize) -> f64 {
        self.rows[row][node]
    }

    /// Value of ψ_a at a point from the values of the shape functions there, or a derivative of ψ_a from their derivatives.
    #[inline]
    pub(super) fn at(&self, row: usize, nodes: usize, values: &[f64; MOST_NODES]) -> f64 {
        self.rows[row].iter().zip(values).take(nodes).map(|(c, v)| c * v).sum()
    }

    /// Value and slopes of ψ_a.
    #[inline]
    pub(super) fn slopes(&self, row: usize, nodes: usize, s: &Shape) -> (f64, [f64; 2]) {
        (self.at(row, nodes, &s.value), [self.at(row, nodes, &s.first[0]), self.at(row, nodes, &s.first[1])])
    }
}

/// Points whose functions do not vanish at each node of an interface, with their values: `Σ_A ψ_A f_A` at the node is the sum
/// of these values times f_A. Empty for nodes that belong to no facet.
pub(crate) fn node_values(faces: &[Segment], slave: &[SlavePoint], nodes: usize) -> Vec<Vec<(usize, f64)>> {
    let mut point_of = vec![None; nodes];
    for (p, s) in slave.iter().enumerate() {
        point_of[s.node] = Some(p);
    }
    let mut out = vec![Vec::new(); nodes];
    for face in faces.iter().filter(|f| f.nodes.iter().any(|&n| point_of[n].is_some())) {
        let weighting = Weighting::new(face.kind, |k| point_of[face.nodes[k]]);
        for (k, &node) in face.nodes.iter().enumerate() {
            // The functions are continuous, so any facet of the node gives the same values.
            if out[node].is_empty() {
                let rows = weighting.points.iter().zip(&weighting.rows);
                out[node] = rows.map(|(&p, row)| (p, row[k])).filter(|(_, c)| *c != 0.0).collect();
            }
        }
    }
    out
}

fn add(a: &mut [f64; MOST_NODES], c: f64, b: &[f64; MOST_NODES]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x += c * y;
    }
}

/// Coefficients of ψ of local node `k`.
fn row(kind: SegmentKind, k: usize) -> [f64; MOST_NODES] {
    let mut c = [0.0; MOST_NODES];
    match kind {
        SegmentKind::Seg2 | SegmentKind::Tri3 | SegmentKind::Quad4 => c[k] = 1.0,
        SegmentKind::Seg3 => share(&mut c, k, 0.25, 2, &[[0, 1]]),
        SegmentKind::Tri6 => share(&mut c, k, 0.25, 3, &[[0, 1], [1, 2], [2, 0]]),
        // N_k of a corner is the bilinear function minus half of its mid-nodes' functions. A quarter would leave it negative.
        SegmentKind::Quad8 => share(&mut c, k, 0.375, 4, &[[0, 1], [1, 2], [2, 3], [3, 0]]),
        SegmentKind::Quad9 => return nine(k),
    }
    c
}

/// Gives a corner this `part` of its mid-nodes' functions; a mid-node keeps the rest of its own.
fn share(c: &mut [f64; MOST_NODES], k: usize, part: f64, corners: usize, edges: &[[usize; 2]]) {
    if k >= corners {
        c[k] = 1.0 - 2.0 * part;
        return;
    }
    c[k] = 1.0;
    for (m, edge) in edges.iter().enumerate() {
        if edge.contains(&k) {
            c[corners + m] = part;
        }
    }
}

/// Products of the line's coefficients. Nodes are numbered (end, end, middle) in either direction.
fn nine(k: usize) -> [f64; MOST_NODES] {
    const AT: [[usize; 2]; 9] = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [1, 2], [2, 1], [0, 2], [2, 2]];
    let line = |i: usize| match i {
        0 => [1.0, 0.0, 0.25],
        1 => [0.0, 1.0, 0.25],
        _ => [0.0, 0.0, 0.5],
    };
    let (a, b) = (line(AT[k][0]), line(AT[k][1]));
    std::array::from_fn(|m| a[AT[m][0]] * b[AT[m][1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::shape;

    const KINDS: [SegmentKind; 7] = [
        SegmentKind::Seg2,
        SegmentKind::Seg3,
        SegmentKind::Tri3,
        SegmentKind::Tri6,
        SegmentKind::Quad4,
        SegmentKind::Quad8,
        SegmentKind::Quad9,
    ];

    #[test]
    fn weightings_are_partitions_of_unity_and_nowhere_negative() {
        for kind in KINDS {
            let whole = Weighting::new(kind, Some);
            let tipped = Weighting::new(kind, |k| (k != 0).then_some(k));
            for i in 0..=8 {
                for j in 0..=8 {
                    let (a, b) = (f64::from(i) / 8.0, f64::from(j) / 8.0);
                    let triangle = matches!(kind, SegmentKind::Tri3 | SegmentKind::Tri6);
                    let xi = if triangle { [a * (1.0 - b), b] } else { [2.0 * a - 1.0, 2.0 * b - 1.0] };
                    let s = shape(kind, xi);
                    for w in [&whole, &tipped] {
                        let psi: Vec<f64> =
                            (0..w.points.len()).map(|r| w.at(r, kind.nodes(), &s.value)).collect();
                        assert!(psi.iter().all(|p| *p > -1e-15), "{kind}: {psi:?}");
                        assert!((psi.iter().sum::<f64>() - 1.0).abs() < 1e-14, "{kind}: {psi:?}");
                    }
                }
            }
        }
    }
}
