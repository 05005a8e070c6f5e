//! Linear triangle on 0 ≤ ξ, η, ξ + η ≤ 1.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

pub(super) const FACES: &[&[usize]] = &[&[0, 1], &[1, 2], &[2, 0]];

pub(super) fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    s.n[..3].copy_from_slice(&[1.0 - x - y, x, y]);
    s.dn[..3].copy_from_slice(&[[-1.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    s
}
