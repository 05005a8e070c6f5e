//! Serendipity wedge (prism): corners as [`super::wedge6`], then mid-nodes of edges 01, 12, 20, 34, 45, 53, 03, 14, 25. With
//! area coordinates λ and the end ζ_a = ±1, corners have ½ λ [(2λ-1)(1+ζ_a ζ) - (1-ζ²)], mid-nodes of triangles
//! 2 λ_i λ_j (1+ζ_a ζ), mid-nodes between them λ_i (1-ζ²).
//!
//! As [`super::quad8`], it holds all quadratic polynomials of the positions only where it is an affine image of the reference.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = &[
    [0.0, 0.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.5, 0.0, -1.0],
    [0.5, 0.5, -1.0],
    [0.0, 0.5, -1.0],
    [0.5, 0.0, 1.0],
    [0.5, 0.5, 1.0],
    [0.0, 0.5, 1.0],
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
];

pub(super) const FACES: &[&[usize]] = &[
    &[0, 2, 1, 8, 7, 6],
    &[3, 4, 5, 9, 10, 11],
    &[0, 1, 4, 3, 6, 13, 9, 12],
    &[1, 2, 5, 4, 7, 14, 10, 13],
    &[2, 0, 3, 5, 8, 12, 11, 14],
];

pub(super) fn shape([x, y, z]: [f64; 3]) -> Shape {
    let l = [1.0 - x - y, x, y];
    let dl = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let bubble = 1.0 - z * z;
    let mut s = Shape::default();
    for (layer, end) in [-1.0, 1.0].into_iter().enumerate() {
        let f = 1.0 + end * z;
        for i in 0..3 {
            let j = (i + 1) % 3;
            let (corner, middle) = (3 * layer + i, 6 + 3 * layer + i);
            s.n[corner] = 0.5 * l[i] * ((2.0 * l[i] - 1.0) * f - bubble);
            s.n[middle] = 2.0 * l[i] * l[j] * f;
            for (m, (own, next)) in dl[i].into_iter().zip(dl[j]).enumerate() {
                s.dn[corner][m] = 0.5 * own * ((4.0 * l[i] - 1.0) * f - bubble);
                s.dn[middle][m] = 2.0 * (own * l[j] + l[i] * next) * f;
            }
            s.dn[corner][2] = 0.5 * l[i] * ((2.0 * l[i] - 1.0) * end + 2.0 * z);
            s.dn[middle][2] = 2.0 * l[i] * l[j] * end;
        }
    }
    for i in 0..3 {
        s.n[12 + i] = l[i] * bubble;
        s.dn[12 + i] = [dl[i][0] * bubble, dl[i][1] * bubble, -2.0 * l[i] * z];
    }
    s
}
