//! Lines of equal value on a surface, as straight pieces across triangles on whose sides the value is linear.

use super::Surface;
use crate::figures::figure::Point;

/// Pieces of the line on which `values` of the points have this level. Triangles with a value that is not finite have none.
pub(super) fn isolines(surface: &Surface, values: &[f64], level: f64) -> Vec<[Point; 2]> {
    surface.triangles().into_iter().filter_map(|corners| piece(&corners, surface, values, level)).collect()
}

fn piece(corners: &[Vec<usize>; 3], surface: &Surface, values: &[f64], level: f64) -> Option<[Point; 2]> {
    let corner = |nodes: &Vec<usize>| {
        let (place, value) = surface.corner(nodes, values);
        (place, value - level)
    };
    let [a, b, c] = corners.each_ref().map(corner);
    let cross = |(p, u): (Point, f64), (q, v): (Point, f64)| {
        let share = u / (u - v);
        ((u < 0.0) != (v < 0.0)).then_some((p.0 + share * (q.0 - p.0), p.1 + share * (q.1 - p.1)))
    };
    if !(a.1.is_finite() && b.1.is_finite() && c.1.is_finite()) {
        return None;
    }
    let mut ends = [(a, b), (b, c), (c, a)].into_iter().filter_map(|(p, q)| cross(p, q));
    Some([ends.next()?, ends.next()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_equal_value_has_that_value() {
        // Values x + 2 y on a square cut into triangles about its centre.
        let places = vec![(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let values: Vec<f64> = places.iter().map(|(x, y)| x + 2.0 * y).collect();
        let surface = Surface {
            places,
            faces: vec![vec![0, 1, 2, 3]],
            labels: ["x".into(), "y".into()],
            geographic: false,
        };
        let found = isolines(&surface, &values, 0.7);
        assert_eq!(found.len(), 2);
        for (x, y) in found.into_iter().flatten() {
            assert!((x + 2.0 * y - 0.7).abs() < 1e-12);
        }
        assert!(isolines(&surface, &values, 4.0).is_empty());
        assert!(isolines(&surface, &[0.0, f64::NAN, 1.0, 2.0], 0.5).is_empty());
    }
}
