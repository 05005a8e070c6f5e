//! Trilinear hexahedron on [-1, 1]³.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = &[
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

pub(super) const FACES: &[&[usize]] =
    &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];

pub(super) fn shape([x, y, z]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, za]) in NODES.iter().enumerate() {
        let (fx, fy, fz) = (1.0 + xa * x, 1.0 + ya * y, 1.0 + za * z);
        s.n[a] = 0.125 * fx * fy * fz;
        s.dn[a] = [0.125 * xa * fy * fz, 0.125 * ya * fx * fz, 0.125 * za * fx * fy];
    }
    s
}
