//! Serendipity quadrilateral on [-1, 1]²: corners, mid-nodes of edges 01, 12, 23, 30. With s = x x_a, t = y y_a corners have
//! ¼ (1+s)(1+t)(s+t-1), mid-nodes ½ (1-x²)(1+t) or ½ (1-y²)(1+s).
//!
//! The space holds all quadratic polynomials of the natural coordinates, and of the positions only where the element is a
//! parallelogram (Arnold, Boffi, Falk 2002): on general quadrilaterals the order falls to that of quad4.

use super::Shape;

pub(super) const NODES: &[[f64; 3]] = super::quad9::NODES.split_at(8).0;

pub(super) const FACES: &[&[usize]] = super::quad9::FACES;

pub(super) fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, _]) in NODES.iter().enumerate() {
        let (fx, fy) = (1.0 + xa * x, 1.0 + ya * y);
        (s.n[a], s.dn[a]) = if xa == 0.0 {
            (0.5 * (1.0 - x * x) * fy, [-x * fy, 0.5 * ya * (1.0 - x * x), 0.0])
        } else if ya == 0.0 {
            (0.5 * (1.0 - y * y) * fx, [0.5 * xa * (1.0 - y * y), -y * fx, 0.0])
        } else {
            let bracket = xa * x + ya * y - 1.0;
            (
                0.25 * fx * fy * bracket,
                [0.25 * xa * fy * (bracket + fx), 0.25 * ya * fx * (bracket + fy), 0.0],
            )
        };
    }
    s
}
