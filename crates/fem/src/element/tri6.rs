//! Quadratic triangle: corners, then mid-nodes of edges 01, 12, 20. With area coordinates λ, corners have λ(2λ-1) and
//! mid-nodes 4 λ_i λ_j.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] =
    &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.0]];

pub(super) const FACES: &[&[usize]] = &[&[0, 1, 3], &[1, 2, 4], &[2, 0, 5]];

pub(super) fn shape([x, y, _]: [f64; 3]) -> Shape {
    let l = [1.0 - x - y, x, y];
    let dl = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let mut s = Shape::default();
    for i in 0..3 {
        let j = (i + 1) % 3;
        s.n[i] = l[i] * (2.0 * l[i] - 1.0);
        s.n[3 + i] = 4.0 * l[i] * l[j];
        for (m, (di, dj)) in dl[i].iter().zip(&dl[j]).enumerate() {
            s.dn[i][m] = (4.0 * l[i] - 1.0) * di;
            s.dn[3 + i][m] = 4.0 * (di * l[j] + l[i] * dj);
        }
    }
    s
}
