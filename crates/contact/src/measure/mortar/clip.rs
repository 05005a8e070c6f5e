//! Intersection of convex polygons in a plane (Sutherland and Hodgman 1974), with derivatives if the numbers carry them.

use super::scalar::Scalar;
use crate::vector::dot;

/// Largest number of corners. The intersection of two quadrilaterals has at most 8, since each cut adds one; two are spare for
/// rounding.
const MOST_CORNERS: usize = 10;

/// Sine of the angle between two edges below which their intersection is dominated by rounding: it loses half of the digits.
pub(super) const PARALLEL: f64 = 1e-8;

/// A convex polygon, counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon<T> {
    pub corners: usize,
    pub at: [[T; 2]; MOST_CORNERS],
}

impl<T: Scalar> Polygon<T> {
    pub(super) fn empty() -> Self {
        Self { corners: 0, at: [[T::constant(0.0); 2]; MOST_CORNERS] }
    }

    #[inline]
    pub(super) fn push(&mut self, p: [T; 2]) {
        if self.corners < MOST_CORNERS {
            self.at[self.corners] = p;
            self.corners += 1;
        }
    }

    /// Reverses the orientation.
    pub(super) fn reverse(&mut self) {
        self.at[..self.corners].reverse();
    }

    /// Part of the polygon inside the convex polygon `other`.
    pub(super) fn clipped(&self, other: &Self) -> Self {
        let mut out = *self;
        for k in 0..other.corners {
            let (a, b) = (other.at[k], other.at[(k + 1) % other.corners]);
            out = out.left_of(&a, &b);
            if out.corners < 3 {
                return Self::empty();
            }
        }
        out
    }

    /// Triangles of a fan that covers the polygon, about its centroid or else about its first corner.
    pub(super) fn fan(&self, centred: bool) -> impl Iterator<Item = [[T; 2]; 3]> {
        let apex = if centred { self.centroid() } else { self.at[0] };
        let first = if centred { 0 } else { 1 };
        let last = self.corners.saturating_sub(first);
        (first..last.max(first)).map(move |k| [apex, self.at[k], self.at[(k + 1) % self.corners]])
    }

    /// Centroid of the polygon's area.
    fn centroid(&self) -> [T; 2] {
        let o = self.at[0];
        let mut whole = T::constant(0.0);
        let mut sum = [T::constant(0.0); 2];
        for k in 2..self.corners {
            let (a, b) = (self.at[k - 1], self.at[k]);
            let double = twice_area(&o, &a, &b);
            whole = whole + double;
            (0..2).for_each(|i| sum[i] = sum[i] + double * (a[i] - o[i] + b[i] - o[i]));
        }
        let share = T::constant(1.0) / whole.times(3.0);
        std::array::from_fn(|i| o[i] + sum[i] * share)
    }

    /// Part of the polygon left of the line from `a` to `b`.
    fn left_of(&self, a: &[T; 2], b: &[T; 2]) -> Self {
        let mut out = Self::empty();
        let side = |p: &[T; 2]| twice_area(a, b, p);
        let mut from = self.at[self.corners - 1];
        let mut s = side(&from);
        for to in &self.at[..self.corners] {
            let t = side(to);
            if (s.value() < 0.0) != (t.value() < 0.0) {
                let c = s / (s - t);
                let share = if parallel(a, b, &from, to) { T::constant(c.value()) } else { c };
                out.push(std::array::from_fn(|i| from[i] + share * (to[i] - from[i])));
            }
            if t.value() >= 0.0 {
                out.push(*to);
            }
            (from, s) = (*to, t);
        }
        out
    }
}

/// True if the edges from `from` to `to` and from `a` to `b` have nearly one direction. Where they cross is then a material point of
/// the first.
fn parallel<T: Scalar>(a: &[T; 2], b: &[T; 2], from: &[T; 2], to: &[T; 2]) -> bool {
    let along = |p: &[T; 2], q: &[T; 2]| [q[0].value() - p[0].value(), q[1].value() - p[1].value()];
    let (d, e) = (along(from, to), along(a, b));
    let (product, square) = (d[0] * e[1] - d[1] * e[0], dot(&d, &d) * dot(&e, &e));
    product * product <= PARALLEL * PARALLEL * square
}

/// Twice the area of the triangle a, b, c, positive counter-clockwise.
#[inline]
pub(super) fn twice_area<T: Scalar>(a: &[T; 2], b: &[T; 2], c: &[T; 2]) -> T {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[[f64; 2]]) -> Polygon<f64> {
        let mut p = Polygon::empty();
        points.iter().for_each(|x| p.push(*x));
        p
    }

    fn area(p: &Polygon<f64>) -> f64 {
        (2..p.corners).map(|k| 0.5 * twice_area(&p.at[0], &p.at[k - 1], &p.at[k])).sum()
    }

    #[test]
    fn a_square_and_its_turn_by_45_degrees_meet_in_an_octagon() {
        let square = polygon(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]);
        let r = 2f64.sqrt();
        let turned = polygon(&[[0.0, -r], [r, 0.0], [0.0, r], [-r, 0.0]]);
        let both = square.clipped(&turned);
        assert_eq!(both.corners, 8);
        assert!((area(&both) - 8.0 * (r - 1.0)).abs() < 1e-14);
        assert!((area(&turned.clipped(&square)) - area(&both)).abs() < 1e-14);
    }

    #[test]
    fn polygons_apart_or_sharing_an_edge_have_no_overlap() {
        let square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let beside = polygon(&[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]]);
        let apart = polygon(&[[3.0, 0.0], [4.0, 0.0], [4.0, 1.0]]);
        assert!(area(&square.clipped(&beside)).abs() < 1e-15);
        assert_eq!(square.clipped(&apart).corners, 0);
    }
}
