//! Biquadratic quadrilateral on [-1, 1]²: corners, mid-nodes of edges 01, 12, 23, 30, centre. Products of the
//! one-dimensional quadratic Lagrange functions.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = &[
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0],
];

pub(super) const FACES: &[&[usize]] = &[&[0, 1, 4], &[1, 2, 5], &[2, 3, 6], &[3, 0, 7]];

/// Lagrange function that is 1 at `node` in {-1, 0, 1}, and its derivative.
pub(super) fn lagrange(node: f64, x: f64) -> (f64, f64) {
    if node == 0.0 { (1.0 - x * x, -2.0 * x) } else { (0.5 * x * (x + node), x + 0.5 * node) }
}

pub(super) fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, _]) in NODES.iter().enumerate() {
        let ((fx, dx), (fy, dy)) = (lagrange(xa, x), lagrange(ya, y));
        s.n[a] = fx * fy;
        s.dn[a] = [dx * fy, fx * dy, 0.0];
    }
    s
}
