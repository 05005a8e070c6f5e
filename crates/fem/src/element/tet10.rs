//! Quadratic tetrahedron: corners, then mid-nodes of edges 01, 12, 20, 03, 13, 23. With volume coordinates λ, corners have
//! λ(2λ-1) and mid-nodes 4 λ_i λ_j.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = &[
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.0, 0.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.0],
    [0.0, 0.0, 0.5],
    [0.5, 0.0, 0.5],
    [0.0, 0.5, 0.5],
];

pub(super) const FACES: &[&[usize]] =
    &[&[0, 2, 1, 6, 5, 4], &[0, 1, 3, 4, 8, 7], &[1, 2, 3, 5, 9, 8], &[0, 3, 2, 7, 9, 6]];

/// Ends of the edges that carry nodes 4 to 9.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

pub(super) fn shape([x, y, z]: [f64; 3]) -> Shape {
    let l = [1.0 - x - y - z, x, y, z];
    let dl = [[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut s = Shape::default();
    for i in 0..4 {
        s.n[i] = l[i] * (2.0 * l[i] - 1.0);
        s.dn[i] = dl[i].map(|d| (4.0 * l[i] - 1.0) * d);
    }
    for (k, [i, j]) in EDGES.into_iter().enumerate() {
        s.n[4 + k] = 4.0 * l[i] * l[j];
        s.dn[4 + k] = std::array::from_fn(|m| 4.0 * (dl[i][m] * l[j] + l[i] * dl[j][m]));
    }
    s
}
