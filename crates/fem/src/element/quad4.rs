//! Bilinear quadrilateral on [-1, 1]².

use super::Shape;

pub(super) const NODES: &[[f64; 3]] =
    &[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];

pub(super) const FACES: &[&[usize]] = &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]];

pub(super) fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, _]) in NODES.iter().enumerate() {
        s.n[a] = 0.25 * (1.0 + xa * x) * (1.0 + ya * y);
        s.dn[a] = [0.25 * xa * (1.0 + ya * y), 0.25 * ya * (1.0 + xa * x), 0.0];
    }
    s
}
