//! Quadrature rules on the reference elements.

use crate::element::Point;

/// Product Gauss rule with `n` (1, 2 or 3) points an axis on [-1, 1]^dimension.
#[must_use]
pub fn gauss(n: usize, dimension: usize) -> Vec<Point> {
    let line = gauss_line(n);
    let flat = vec![(0.0, 1.0)];
    let ys = if dimension > 1 { &line } else { &flat };
    let zs = if dimension > 2 { &line } else { &flat };
    let mut points = Vec::new();
    for &(z, wz) in zs {
        for &(y, wy) in ys {
            for &(x, wx) in &line {
                points.push(([x, y, z], wx * wy * wz));
            }
        }
    }
    points
}

/// Gauss points on [-1, 1]: exact for degree 2n - 1.
fn gauss_line(n: usize) -> Vec<(f64, f64)> {
    match n {
        1 => vec![(0.0, 2.0)],
        2 => {
            let x = (1.0_f64 / 3.0).sqrt();
            vec![(-x, 1.0), (x, 1.0)]
        }
        _ => {
            let x = 0.6_f64.sqrt();
            vec![(-x, 5.0 / 9.0), (0.0, 8.0 / 9.0), (x, 5.0 / 9.0)]
        }
    }
}

/// Centroid rule: degree 1.
#[must_use]
pub fn triangle_1() -> Vec<Point> {
    vec![([1.0 / 3.0, 1.0 / 3.0, 0.0], 0.5)]
}

/// Three interior points: degree 2.
#[must_use]
pub fn triangle_3() -> Vec<Point> {
    let (a, b, w) = (1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0);
    vec![([a, a, 0.0], w), ([b, a, 0.0], w), ([a, b, 0.0], w)]
}

/// Centroid rule: degree 1.
#[must_use]
pub fn tetrahedron_1() -> Vec<Point> {
    vec![([0.25, 0.25, 0.25], 1.0 / 6.0)]
}
