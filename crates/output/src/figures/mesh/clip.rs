//! Parts of polygons and lines inside a rectangle.

use super::super::figure::Point;

/// A rectangle: lower left and upper right corner.
pub(super) type Box = (Point, Point);

/// Signed distances of a point from the four sides, positive inside.
fn inside((lo, hi): &Box, p: Point) -> [f64; 4] {
    [p.0 - lo.0, hi.0 - p.0, p.1 - lo.1, hi.1 - p.1]
}

/// Point between two others.
fn between(a: Point, b: Point, s: f64) -> Point {
    (a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1))
}

/// Part of a convex ring inside the rectangle, side by side (I. E. Sutherland, G. W. Hodgman, CACM 17 (1974), 32-42); empty if none is.
pub(super) fn ring(within: &Box, ring: &[Point]) -> Vec<Point> {
    let mut left = ring.to_vec();
    for side in 0..4 {
        let next = left.iter().skip(1).chain(left.first());
        let mut kept = Vec::new();
        for (&a, &b) in left.iter().zip(next) {
            let (da, db) = (inside(within, a)[side], inside(within, b)[side]);
            if da >= 0.0 {
                kept.push(a);
            }
            if (da < 0.0) != (db < 0.0) {
                kept.push(between(a, b, da / (da - db)));
            }
        }
        left = kept;
    }
    left
}

/// Part of a line between two points inside the rectangle.
pub(super) fn line(within: &Box, a: Point, b: Point) -> Option<[Point; 2]> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (da, db) in inside(within, a).into_iter().zip(inside(within, b)) {
        if da < 0.0 && db < 0.0 {
            return None;
        }
        if da < 0.0 {
            from = from.max(da / (da - db));
        } else if db < 0.0 {
            to = to.min(da / (da - db));
        }
    }
    (from <= to).then(|| [between(a, b, from), between(a, b, to)])
}

/// True if a point lies inside.
pub(super) fn holds(within: &Box, p: Point) -> bool {
    inside(within, p).iter().all(|d| *d >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Box = ((0.0, 0.0), (1.0, 1.0));

    #[test]
    fn rings_and_lines_are_cut_at_the_rectangle() {
        let found = ring(&UNIT, &[(0.5, 0.5), (2.0, 0.5), (2.0, 0.75), (0.5, 0.75)]);
        assert_eq!(found, [(0.5, 0.5), (1.0, 0.5), (1.0, 0.75), (0.5, 0.75)]);
        assert!(ring(&UNIT, &[(2.0, 2.0), (3.0, 2.0), (3.0, 3.0)]).is_empty());
        assert_eq!(line(&UNIT, (-1.0, 0.5), (3.0, 0.5)), Some([(0.0, 0.5), (1.0, 0.5)]));
        assert_eq!(line(&UNIT, (-1.0, 0.5), (0.5, 3.0)), None);
        assert!(holds(&UNIT, (0.0, 1.0)) && !holds(&UNIT, (0.0, 1.1)));
    }
}
