//! Closest-point projection of a point onto one segment, with a typed outcome.
//!
//! The foot of the perpendicular solves `(p - x(ξ))·e_m = 0`. It is found by Newton's method, which is exact after one step on
//! a straight edge or a flat triangle. If the foot lies outside the segment, the closest point is on the border, and the point
//! is projected onto the border edge by edge.

use super::patch::{Form, Patch, evaluate};
use crate::SegmentKind;
use crate::shape::{MOST_NODES, Shape, corners};
use crate::vector::{axpy, dot, solve_tangential, sub};

/// Distance in natural coordinates within which a point counts as on a border. The rounding of a projection is 1e-16 times the
/// aspect ratio of the segment, and a point on a border must be recognised from both sides.
pub const BORDER: f64 = 1e-9;

/// Most Newton iterations for a foot. Flat segments need 1 to 4; an iteration that has not converged by then is far outside.
const ITERATIONS: usize = 30;

/// Size of a full Newton step in natural coordinates after which the iteration has converged. The remaining error is about its
/// square, which is below rounding.
const CONVERGED: f64 = 1e-9;

/// Bound on natural coordinates. Points beyond it are certainly outside; iterates are kept within it.
const FAR: f64 = 4.0;

/// Part of a segment on which the closest point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// In the interior of the segment.
    Inside,
    /// On the edge with this local number (three dimensions).
    OnEdge(usize),
    /// On the corner with this local number.
    OnVertex(usize),
    /// No projection was found (degenerate segment or non-finite point).
    None,
}

/// Closest point of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection<const D: usize> {
    /// Natural coordinates.
    pub xi: [f64; 2],
    /// Closest point \[m\].
    pub point: [f64; D],
    /// Squared distance \[m²\].
    pub distance_squared: f64,
    /// Part of the segment on which it lies.
    pub outcome: Outcome,
}

/// Natural coordinates of a corner.
#[must_use]
pub fn corner(kind: SegmentKind, k: usize) -> [f64; 2] {
    match kind {
        SegmentKind::Seg2 | SegmentKind::Seg3 => [[-1.0, 0.0], [1.0, 0.0]][k],
        SegmentKind::Tri3 | SegmentKind::Tri6 => [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]][k],
        SegmentKind::Quad4 | SegmentKind::Quad8 | SegmentKind::Quad9 => {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]][k]
        }
    }
}

/// Signed distances in natural coordinates from the borders, positive inside: ends of a line, edges of a face (edge k
/// joins corners k and k + 1). Entries beyond the number of borders are infinite.
#[must_use]
pub fn margins(kind: SegmentKind, xi: [f64; 2]) -> [f64; 4] {
    let [x, y] = xi;
    match kind {
        SegmentKind::Seg2 | SegmentKind::Seg3 => [x + 1.0, 1.0 - x, f64::INFINITY, f64::INFINITY],
        SegmentKind::Tri3 | SegmentKind::Tri6 => [y, 1.0 - x - y, x, f64::INFINITY],
        SegmentKind::Quad4 | SegmentKind::Quad8 | SegmentKind::Quad9 => [y + 1.0, 1.0 - x, 1.0 - y, x + 1.0],
    }
}

/// Smallest margin; positive inside.
#[must_use]
pub fn depth(kind: SegmentKind, xi: [f64; 2]) -> f64 {
    margins(kind, xi).into_iter().fold(f64::INFINITY, f64::min)
}

/// Position and tangent vectors for shape functions `s`.
#[inline]
pub fn interpolate<const D: usize>(s: &Shape, x: &[[f64; D]]) -> ([f64; D], [[f64; D]; 2]) {
    let mut p = [0.0; D];
    let mut e = [[0.0; D]; 2];
    for (k, xk) in x.iter().enumerate() {
        axpy(&mut p, s.value[k], xk);
        axpy(&mut e[0], s.first[0][k], xk);
        axpy(&mut e[1], s.first[1][k], xk);
    }
    (p, e)
}

/// Foot of the perpendicular from `p` on the unbounded continuation of the segment, from the initial guess `xi`; `None` if
/// Newton's method does not converge.
pub fn foot<const D: usize>(form: Form, x: &[[f64; D]], p: &[f64; D], mut xi: [f64; 2]) -> Option<[f64; 2]> {
    if form == Form::Nodes(SegmentKind::Seg2) {
        // Measured from the middle of the segment, so that both ends are treated alike and ξ is exact for a point far along it.
        let e = sub(&x[1], &x[0]);
        let middle: [f64; D] = std::array::from_fn(|i| 0.5 * (x[0][i] + x[1][i]));
        let s = 2.0 * dot(&sub(p, &middle), &e) / dot(&e, &e);
        return s.is_finite().then_some([s, 0.0]);
    }
    let linear = form == Form::Nodes(SegmentKind::Tri3);
    let m = D - 1;
    for _ in 0..ITERATIONS {
        let patch = evaluate(form, x, xi);
        let d = sub(p, &patch.point);
        let residual = [dot(&d, &patch.e[0]), dot(&d, &patch.e[1])];
        let (matrix, full) = newton_matrix(&patch, &d);
        let step = solve_tangential(m, &matrix, &residual);
        if !(step[0].is_finite() && step[1].is_finite()) {
            return None;
        }
        for k in 0..m {
            xi[k] += step[k];
            if !linear {
                xi[k] = xi[k].clamp(-FAR, FAR);
            }
        }
        let size = step[0].abs().max(step[1].abs());
        if linear || (full && size <= CONVERGED) {
            return Some(xi);
        }
    }
    // Gauss-Newton converges linearly. An iterate that still moves visibly is not a foot.
    let patch = evaluate(form, x, xi);
    let d = sub(p, &patch.point);
    let off = (0..m).map(|k| dot(&d, &patch.e[k]).abs() / dot(&patch.e[k], &patch.e[k])).fold(0.0, f64::max);
    (off <= BORDER).then_some(xi)
}

/// Matrix `C - d·e_m,l` if it is positive definite (true), otherwise the metric C alone (Gauss-Newton, false).
#[inline]
fn newton_matrix<const D: usize>(patch: &Patch<D>, d: &[f64; D]) -> ([f64; 3], bool) {
    let e = &patch.e;
    let metric = [dot(&e[0], &e[0]), dot(&e[0], &e[1]), dot(&e[1], &e[1])];
    let a: [f64; 3] = std::array::from_fn(|k| metric[k] - dot(d, &patch.curvature[k]));
    let definite = if D == 2 { a[0] > 0.0 } else { a[0] > 0.0 && a[0] * a[2] - a[1] * a[1] > 0.0 };
    (if definite { a } else { metric }, definite)
}

/// Closest point of the segment with nodes `x` to `p`.
pub fn project<const D: usize>(kind: SegmentKind, x: &[[f64; D]], p: &[f64; D]) -> Projection<D> {
    project_on(Form::Nodes(kind), x, p)
}

/// Closest point of a segment of either form with points `x`.
pub fn project_on<const D: usize>(form: Form, x: &[[f64; D]], p: &[f64; D]) -> Projection<D> {
    let start = if corners(form.kind()) == 3 { [1.0 / 3.0; 2] } else { [0.0; 2] };
    let inside = foot(form, x, p, start)
        .filter(|&xi| depth(form.kind(), xi) > BORDER)
        .map(|xi| at(form, x, p, xi, Outcome::Inside));
    if let Some(found) = inside
        && form.straight()
    {
        return found;
    }
    // On a curved segment a foot need not be the closest point, so the border is also considered.
    let border = if D == 2 { nearest_end(form, x, p) } else { nearest_edge(form, x, p) };
    match inside {
        Some(found) if found.distance_squared <= border.distance_squared => found,
        _ => border,
    }
}

fn at<const D: usize>(
    form: Form,
    x: &[[f64; D]],
    p: &[f64; D],
    xi: [f64; 2],
    outcome: Outcome,
) -> Projection<D> {
    let point = evaluate(form, x, xi).point;
    let d = sub(p, &point);
    let distance_squared = dot(&d, &d);
    let outcome = if distance_squared.is_finite() { outcome } else { Outcome::None };
    Projection { xi, point, distance_squared, outcome }
}

fn nearest_end<const D: usize>(form: Form, x: &[[f64; D]], p: &[f64; D]) -> Projection<D> {
    let a = at(form, x, p, corner(form.kind(), 0), Outcome::OnVertex(0));
    let b = at(form, x, p, corner(form.kind(), 1), Outcome::OnVertex(1));
    if b.distance_squared < a.distance_squared { b } else { a }
}

fn nearest_edge<const D: usize>(form: Form, x: &[[f64; D]], p: &[f64; D]) -> Projection<D> {
    let mut best: Option<Projection<D>> = None;
    for k in 0..corners(form.kind()) {
        let found = on_edge(form, x, p, k);
        if best.is_none_or(|b| found.distance_squared < b.distance_squared) {
            best = Some(found);
        }
    }
    best.unwrap_or_else(|| at(form, x, p, [0.0; 2], Outcome::None))
}

/// Closest point of edge `k`, which joins corners `k` and `k + 1`.
fn on_edge<const D: usize>(form: Form, x: &[[f64; D]], p: &[f64; D], k: usize) -> Projection<D> {
    let kind = form.kind();
    let (i, j) = (k, (k + 1) % corners(kind));
    let (a, b) = (corner(kind, i), corner(kind, j));
    let s = if form.straight() {
        let e = sub(&x[j], &x[i]);
        2.0 * dot(&sub(p, &x[i]), &e) / dot(&e, &e) - 1.0
    } else {
        edge_parameter(form, x, p, a, b)
    };
    let outcome = if s <= -1.0 + BORDER {
        Outcome::OnVertex(i)
    } else if s >= 1.0 - BORDER {
        Outcome::OnVertex(j)
    } else {
        Outcome::OnEdge(k)
    };
    let xi = match outcome {
        Outcome::OnVertex(v) => corner(kind, v),
        _ => between(a, b, s),
    };
    at(form, x, p, xi, outcome)
}

/// Point with parameter `s` in [-1, 1] on the line from `a` to `b`.
fn between(a: [f64; 2], b: [f64; 2], s: f64) -> [f64; 2] {
    std::array::from_fn(|c| 0.5 * ((1.0 - s) * a[c] + (1.0 + s) * b[c]))
}

/// Closest parameter in [-1, 1] of the curved edge over the line from `a` to `b`, by Newton's method from the best of a few
/// samples.
fn edge_parameter<const D: usize>(form: Form, x: &[[f64; D]], p: &[f64; D], a: [f64; 2], b: [f64; 2]) -> f64 {
    let along = [0.5 * (b[0] - a[0]), 0.5 * (b[1] - a[1])];
    let distance = |s: f64| {
        let d = sub(p, &evaluate(form, x, between(a, b, s)).point);
        dot(&d, &d)
    };
    let mut s = [-1.0, -0.5, 0.0, 0.5, 1.0]
        .into_iter()
        .fold(0.0, |a, b| if distance(b) < distance(a) { b } else { a });
    for _ in 0..ITERATIONS {
        let patch = evaluate(form, x, between(a, b, s));
        let d = sub(p, &patch.point);
        let (mut e, mut c) = ([0.0; D], [0.0; D]);
        for (m, a) in along.iter().enumerate() {
            axpy(&mut e, *a, &patch.e[m]);
            axpy(&mut c, a * a, &patch.curvature[2 * m]);
        }
        axpy(&mut c, 2.0 * along[0] * along[1], &patch.curvature[1]);
        let metric = dot(&e, &e);
        let full = metric - dot(&d, &c);
        let next = (s + dot(&d, &e) / if full > 0.0 { full } else { metric }).clamp(-1.0, 1.0);
        let moved = (next - s).abs();
        s = next;
        if full > 0.0 && moved <= CONVERGED {
            break;
        }
    }
    s
}

/// Gathers the node positions of a segment into a fixed buffer.
#[inline]
pub fn gather<'a, const D: usize>(
    nodes: &[usize],
    position: impl Fn(usize) -> [f64; D],
    buffer: &'a mut [[f64; D]; MOST_NODES],
) -> &'a [[f64; D]] {
    for (b, &n) in buffer.iter_mut().zip(nodes) {
        *b = position(n);
    }
    &buffer[..nodes.len()]
}
