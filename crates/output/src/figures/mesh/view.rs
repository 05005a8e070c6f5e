//! Projection of a mesh onto the paper.

use super::super::figure::Point;

/// Directions of the axes on the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum View {
    /// x to the right and y up.
    Plane,
    /// Seen from x, y and z positive, without perspective; y up.
    Oblique,
}

/// Cosine and sine of the angle by which the view turns about y, 35 degrees.
const TURN: (f64, f64) = (0.819, 0.574);
/// Cosine and sine of the angle by which it looks down, 25 degrees.
const DOWN: (f64, f64) = (0.906, 0.423);

impl View {
    /// Position on the paper.
    pub fn project(self, x: &[f64; 3]) -> Point {
        match self {
            Self::Plane => (x[0], x[1]),
            Self::Oblique => {
                (TURN.0 * x[0] - TURN.1 * x[2], DOWN.0 * x[1] - DOWN.1 * (TURN.1 * x[0] + TURN.0 * x[2]))
            }
        }
    }

    /// Height above the paper.
    pub fn height(self, x: &[f64; 3]) -> f64 {
        match self {
            Self::Plane => 0.0,
            Self::Oblique => DOWN.1 * x[1] + DOWN.0 * (TURN.1 * x[0] + TURN.0 * x[2]),
        }
    }
}

/// Twice the area of a ring, positive if it turns to the left.
pub(super) fn turned(ring: &[Point]) -> f64 {
    let next = ring.iter().skip(1).chain(ring.first());
    ring.iter().zip(next).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum()
}

/// Lower left and upper right corner; `None` if they span no area.
pub(super) fn extent(places: impl Iterator<Item = Point>) -> Option<(Point, Point)> {
    let (lo, hi) = extent_of_any(places)?;
    // Points on a line get room around it.
    let room = 0.5 * (hi.0 - lo.0).max(hi.1 - lo.1);
    let wide = |lo: f64, hi: f64| if hi - lo > 0.02 * room { (lo, hi) } else { (lo - room, hi + room) };
    let (x, y) = (wide(lo.0, hi.0), wide(lo.1, hi.1));
    (room > 0.0).then_some(((x.0, y.0), (x.1, y.1)))
}

/// Lower left and upper right corner; `None` without a finite position.
pub(super) fn extent_of_any(places: impl Iterator<Item = Point>) -> Option<(Point, Point)> {
    let places = places.filter(|p| p.0.is_finite() && p.1.is_finite());
    places.fold(None, |found: Option<(Point, Point)>, p| {
        let (lo, hi) = found.unwrap_or((p, p));
        Some(((lo.0.min(p.0), lo.1.min(p.1)), (hi.0.max(p.0), hi.1.max(p.1))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oblique_view_keeps_lengths_in_the_paper_and_shows_the_front() {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let parts = |x: &[f64; 3]| {
            let (a, b) = View::Oblique.project(x);
            [a, b, View::Oblique.height(x)]
        };
        for (i, x) in axes.iter().enumerate() {
            for (j, y) in axes.iter().enumerate() {
                let dot: f64 = parts(x).iter().zip(parts(y)).map(|(a, b)| a * b).sum();
                assert!((dot - f64::from(u8::from(i == j))).abs() < 2e-3, "{i} {j} {dot}");
            }
            assert!(View::Oblique.height(x) > 0.0);
        }
        // A face whose outward normal is x turns to the left.
        let face = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]];
        let ring: Vec<Point> = face.iter().map(|x| View::Oblique.project(x)).collect();
        assert!(turned(&ring) > 0.0);
    }
}
