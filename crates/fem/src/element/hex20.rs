//! Serendipity hexahedron on [-1, 1]³: corners, mid-nodes of edges 01, 12, 23, 30, 45, 56, 67, 74, 04, 15, 26, 37. With
//! s = x x_a and so on, corners have ⅛ (1+s)(1+t)(1+u)(s+t+u-2), the mid-node of an edge along x ¼ (1-x²)(1+t)(1+u).
//!
//! As [`super::quad8`], it holds all quadratic polynomials of the positions only where it is a parallelepiped.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = super::hex27::NODES.split_at(20).0;

pub(super) const FACES: &[&[usize]] = &[
    &[0, 3, 2, 1, 11, 10, 9, 8],
    &[4, 5, 6, 7, 12, 13, 14, 15],
    &[0, 1, 5, 4, 8, 17, 12, 16],
    &[1, 2, 6, 5, 9, 18, 13, 17],
    &[2, 3, 7, 6, 10, 19, 14, 18],
    &[3, 0, 4, 7, 11, 16, 15, 19],
];

pub(super) fn shape(x: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, node) in NODES.iter().enumerate() {
        let f: [f64; 3] = std::array::from_fn(|m| 1.0 + node[m] * x[m]);
        if let Some(along) = (0..3).find(|&m| node[m] == 0.0) {
            let (p, q) = ((along + 1) % 3, (along + 2) % 3);
            let bubble = 1.0 - x[along] * x[along];
            s.n[a] = 0.25 * bubble * f[p] * f[q];
            s.dn[a][along] = -0.5 * x[along] * f[p] * f[q];
            s.dn[a][p] = 0.25 * bubble * node[p] * f[q];
            s.dn[a][q] = 0.25 * bubble * node[q] * f[p];
        } else {
            let bracket = f[0] + f[1] + f[2] - 5.0;
            s.n[a] = 0.125 * f[0] * f[1] * f[2] * bracket;
            for m in 0..3 {
                let others = f[(m + 1) % 3] * f[(m + 2) % 3];
                s.dn[a][m] = 0.125 * node[m] * others * (bracket + f[m]);
            }
        }
    }
    s
}
