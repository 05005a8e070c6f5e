//! Linear tetrahedron on 0 ≤ ξ, η, ζ, ξ + η + ζ ≤ 1.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(super) const FACES: &[&[usize]] = &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]];

pub(super) fn shape([x, y, z]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    s.n[..4].copy_from_slice(&[1.0 - x - y - z, x, y, z]);
    s.dn[..4].copy_from_slice(&[[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    s
}
