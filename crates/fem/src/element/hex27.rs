//! Triquadratic hexahedron on [-1, 1]³: the nodes of [`super::hex20`], then the centres of the faces x-, x+, y-, y+, z-, z+,
//! and the centre. Products of the one-dimensional quadratic Lagrange functions.

use super::Shape;
use super::quad9::lagrange;

pub(super) const NODES: &[[f64; 3]] = &[
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [-1.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, -1.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, 0.0],
];

pub(super) const FACES: &[&[usize]] = &[
    &[0, 3, 2, 1, 11, 10, 9, 8, 24],
    &[4, 5, 6, 7, 12, 13, 14, 15, 25],
    &[0, 1, 5, 4, 8, 17, 12, 16, 22],
    &[1, 2, 6, 5, 9, 18, 13, 17, 21],
    &[2, 3, 7, 6, 10, 19, 14, 18, 23],
    &[3, 0, 4, 7, 11, 16, 15, 19, 20],
];

pub(super) fn shape([x, y, z]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, za]) in NODES.iter().enumerate() {
        let ((fx, dx), (fy, dy), (fz, dz)) = (lagrange(xa, x), lagrange(ya, y), lagrange(za, z));
        s.n[a] = fx * fy * fz;
        s.dn[a] = [dx * fy * fz, fx * dy * fz, fx * fy * dz];
    }
    s
}
