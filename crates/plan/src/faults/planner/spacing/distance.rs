//! Distances between segments, and between plane convex polygons in space.

use nalgebra::Vector3;

/// A position \[m\].
pub type Position = Vector3<f64>;

/// Two positions at which two cells are closest \[m\].
pub type Nearest = [Position; 2];

/// Share of a squared length below which it is rounding.
const ROUNDING: f64 = 1e-24;

/// Positions at which two cells are closest; each has two corners or more.
pub fn nearest(a: &[Position], b: &[Position]) -> Nearest {
    let edges = edges_of(a).flat_map(|one| edges_of(b).map(move |other| between_segments(&one, &other)));
    let above = a.iter().filter_map(|x| Some([*x, foot(x, b)?]));
    let below = b.iter().filter_map(|x| Some([foot(x, a)?, *x]));
    let through = pierced(a, b).into_iter().chain(pierced(b, a)).map(|x| [x, x]);
    let all = edges.chain(above).chain(below).chain(through);
    let far = |pair: &Nearest| (pair[0] - pair[1]).norm_squared();
    all.min_by(|p, q| far(p).total_cmp(&far(q))).unwrap_or([a[0], b[0]])
}

/// Edges of a cell: one of a segment, as many as corners of a polygon.
pub(super) fn edges_of(cell: &[Position]) -> impl Iterator<Item = [Position; 2]> {
    let count = if cell.len() == 2 { 1 } else { cell.len() };
    (0..count).map(|k| [cell[k], cell[(k + 1) % cell.len()]])
}

/// Closest positions of two segments (C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.9).
fn between_segments([p, p1]: &[Position; 2], [q, q1]: &[Position; 2]) -> Nearest {
    let (d1, d2, r) = (p1 - p, q1 - q, p - q);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
    let (b, c) = (d1.dot(&d2), d1.dot(&r));
    let denominator = a * e - b * b;
    // Parallel segments have many closest positions, of which one is as good as another.
    let s =
        if denominator > ROUNDING * a * e { ((b * f - c * e) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let t = (b * s + f) / e;
    let (s, t) = if t < 0.0 {
        ((-c / a).clamp(0.0, 1.0), 0.0)
    } else if t > 1.0 {
        (((b - c) / a).clamp(0.0, 1.0), 1.0)
    } else {
        (s, t)
    };
    [p + d1 * s, q + d2 * t]
}

/// Normal of a polygon, not normalised; `None` for a segment.
fn normal(cell: &[Position]) -> Option<Position> {
    match cell {
        [a, b, c] => Some((b - a).cross(&(c - a))),
        [a, b, c, d, ..] => Some((c - a).cross(&(d - b))),
        _ => None,
    }
}

/// Foot of a position on a polygon, if it lies inside.
fn foot(x: &Position, cell: &[Position]) -> Option<Position> {
    let n = normal(cell)?;
    let foot = x - n * ((x - cell[0]).dot(&n) / n.norm_squared());
    let inside = |[a, b]: [Position; 2]| (b - a).cross(&(foot - a)).dot(&n) >= 0.0;
    edges_of(cell).all(inside).then_some(foot)
}

/// A position at which an edge of one cell passes through a polygon.
fn pierced(a: &[Position], b: &[Position]) -> Option<Position> {
    let n = normal(b)?;
    edges_of(a).find_map(|[p, q]| {
        let [from, to] = [p, q].map(|x| (x - b[0]).dot(&n));
        // Strictly on both sides; what touches is found by feet and edges.
        (from * to < 0.0).then(|| foot(&(p + (q - p) * (from / (from - to))), b)).flatten()
    })
}
