//! Assignment of points to segments, and the range of motion within which it is certain.
//!
//! A held point stays with its segment while its foot lies within the segment, enlarged by a margin. For segments with straight
//! edges the search proves how far all nodes may move before that can change. For the foot to cross the border of the enlarged
//! segment, the point must lie on the normal of a border point, at the distance of its gap. Let d be the present distance from
//! the border, and Λ the largest sum of |N_γ| on the enlarged segment. If no node has moved by more than δ, the distance is at
//! least d - (1 + Λ) δ and the gap at most |g_n| + (1 + Λ) δ. Nothing changes while `2 (1 + Λ) δ < d - |g_n|`. This requires
//! that the foot move continuously. It always does on lines and flat triangles; on quadrilaterals it does while the gap is
//! small compared with the radius of curvature, which is required with a margin of 10.

use super::local::Local;
use crate::search::patch::{Form, MOST_POINTS, evaluate};
use crate::search::project::{BORDER, Outcome, Projection, margins};
use crate::search::surface::Surface;
use crate::shape::corners;
use crate::spec::SlavePoint;
use crate::vector::{add, axpy, dot, norm, scaled, sub};

/// Number of points processed together on one thread: some 50 microseconds of work, and a tangent that fits the second-level
/// cache.
pub(super) const CHUNK: usize = 128;

/// Distance outside its segment, in natural coordinates, up to which a point is still held. Rounding and small movements at a
/// shared border then do not switch the pairing back and forth. The error is this distance times the kink.
const HYSTERESIS: f64 = 1e-3;

/// Same distance at the rim of the surface. Bodies that end together and deform differently must not lose their last node.
const OVERRUN: f64 = 1e-2;

/// A point beyond the rim is paired again if it is off the normal through the rim by less than this share of the segment's
/// size, as in small sliding.
const RIM: f64 = 1e-6;

/// Value of 2 (1 + Λ). On a bilinear segment enlarged by [`OVERRUN`] the sum of |N_γ| is at most 1.01², and rounding is far
/// below.
const REACH: f64 = 4.05;

/// Largest gap, as a share of the radius of curvature, and largest motion, as a share of the shortest base vector, for which
/// the bound is used on quadrilaterals.
const GENTLE: f64 = 0.1;

/// A point of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub segment: usize,
    pub xi: [f64; 2],
}

/// A slave point and its position on the master.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub slave: SlavePoint,
    /// Position of the closest point; the segment changes in searches only.
    pub place: Option<Place>,
    /// Closest point at the last commit.
    pub anchor: Option<Place>,
    /// True if paired since the last commit. The anchor is then the point found by the first search of the step.
    pub fresh: bool,
    /// True if the last committed step ended on a border of the segment, moving outwards.
    pub leaving: bool,
    /// Held segment and anchor's segment for which the block was made.
    pub key: Option<(usize, usize)>,
}

impl Point {
    pub(super) fn new(slave: &SlavePoint) -> Self {
        Self { slave: *slave, place: None, anchor: None, fresh: false, leaving: false, key: None }
    }
}

/// Result of tracking a range of points.
#[derive(Clone, Copy)]
struct TrackingResult {
    radius: f64,
    projections: u64,
}

/// Updates the assignment of points to segments with the nodes at `x`. Returns the distance that nodes may move before it can
/// change.
pub(super) fn track<const D: usize>(
    surface: &Surface<D>,
    x: &[[f64; D]],
    points: &mut [Point],
    projections: &mut u64,
) -> f64 {
    let found = track_range(surface, x, points);
    *projections += found.projections;
    found.radius
}

fn track_range<const D: usize>(surface: &Surface<D>, x: &[[f64; D]], points: &mut [Point]) -> TrackingResult {
    if points.len() > CHUNK {
        let middle = points.len().div_ceil(2).next_multiple_of(CHUNK);
        let (left, right) = points.split_at_mut(middle);
        let (a, b) = rayon::join(|| track_range(surface, x, left), || track_range(surface, x, right));
        return TrackingResult { radius: a.radius.min(b.radius), projections: a.projections + b.projections };
    }
    let mut all = TrackingResult { radius: f64::INFINITY, projections: 0 };
    for point in points {
        let tracker = Tracker { surface, x, p: x[point.slave.node] };
        let (place, radius) = tracker.hold(point, &mut all.projections);
        if place.map(|h| h.segment) != point.place.map(|h| h.segment) {
            point.leaving = false;
        }
        point.place = place;
        // A point that meets the master within this step has not slipped before.
        point.fresh |= point.anchor.is_none() && place.is_some();
        point.anchor = point.anchor.or(place);
        all.radius = all.radius.min(if point.leaving { 0.0 } else { radius });
    }
    all
}

/// One slave point against the surface.
struct Tracker<'a, const D: usize> {
    surface: &'a Surface<D>,
    x: &'a [[f64; D]],
    p: [f64; D],
}

impl<const D: usize> Tracker<'_, D> {
    /// Determines the segment that holds a point, with natural coordinates, starting from the present one. Also returns the
    /// distance that all nodes may move before this can change. A point that stays keeps its coordinates unchanged, so that
    /// results do not depend on whether a search was made.
    fn hold(&self, point: &Point, projections: &mut u64) -> (Option<Place>, f64) {
        let held = point.place.and_then(|h| self.foot(&h));
        if let Some(h) = held
            && !point.leaving
            && self.keeps(&h)
        {
            return (point.place, self.certain(&h));
        }
        let Some((segment, found)) = self.surface.closest(self.x, &self.p, projections) else {
            return (None, 0.0);
        };
        let (segment, projection) =
            if point.leaving { self.entering(held, segment, found, projections) } else { (segment, found) };
        if projection.outcome == Outcome::None {
            return (None, 0.0);
        }
        let place = Place { segment, xi: projection.xi };
        // Next to a protruding corner the closest point is the corner, and the foot lies outside.
        let foot = self.foot(&place).filter(|f| self.keeps(f));
        let radius = foot.map_or(0.0, |f| self.certain(&f));
        if foot.is_some() && point.place.is_some_and(|h| h.segment == segment) {
            return (point.place, radius);
        }
        if self.surface.on_rim(segment, projection.outcome) && self.off_normal(segment, &projection) {
            // A point that overhangs the rim slides along it from segment to segment.
            let slides = foot.filter(|_| point.place.is_some());
            return (slides.or(held.filter(|h| self.keeps(h))), 0.0);
        }
        (Some(place), radius)
    }

    /// Foot of the perpendicular on the continuation of the segment of `place`.
    fn foot(&self, place: &Place) -> Option<Place> {
        let xi = self.surface.foot(place.segment, self.x, &self.p, place.xi)?;
        Some(Place { segment: place.segment, xi })
    }

    /// Segment that a point on a border is entering: one other than `held` that is equally close, if there is one.
    fn entering(
        &self,
        held: Option<Place>,
        segment: usize,
        found: Projection<D>,
        projections: &mut u64,
    ) -> (usize, Projection<D>) {
        let Some(held) = held.filter(|h| h.segment == segment) else { return (segment, found) };
        let reach = (found.distance_squared.sqrt() + BORDER * self.surface.size(segment)).powi(2);
        let other = self.surface.closest_but(held.segment, self.x, &self.p, projections);
        other.filter(|(_, o)| o.distance_squared <= reach).unwrap_or((segment, found))
    }

    /// Margin by which border `k` of a segment is enlarged.
    fn margin(&self, segment: usize, k: usize) -> f64 {
        if self.surface.border_is_free(segment, k) { OVERRUN } else { HYSTERESIS }
    }

    /// True if the held segment keeps its point.
    fn keeps(&self, place: &Place) -> bool {
        let kind = self.surface.segments()[place.segment].kind;
        let borders = if D == 2 { 2 } else { corners(kind) };
        margins(kind, place.xi)[..borders]
            .iter()
            .enumerate()
            .all(|(k, &m)| m >= -self.margin(place.segment, k))
    }

    fn off_normal(&self, segment: usize, projection: &Projection<D>) -> bool {
        let local = Local::new(&self.surface.evaluate(segment, self.x, projection.xi));
        let mut off = sub(&self.p, &projection.point);
        let along = dot(&off, &local.n);
        axpy(&mut off, -along, &local.n);
        norm(&off) > RIM * self.surface.size(segment)
    }

    /// Distance that every node may move while the point is certain to stay on its segment; 0 if none is known.
    fn certain(&self, place: &Place) -> f64 {
        let form = self.surface.form(place.segment);
        if !form.straight() {
            return 0.0;
        }
        let local = Local::new(&self.surface.evaluate(place.segment, self.x, place.xi));
        let gap = dot(&local.n, &sub(&self.p, &local.point)).abs();
        let mut cap = f64::INFINITY;
        if corners(form.kind()) == 4 {
            let c = local.metric();
            let least = (c[0] * c[2] - c[1] * c[1]) / (c[0] + c[2]);
            if gap * norm(&local.curvature[1]) > GENTLE * least {
                return 0.0;
            }
            cap = GENTLE * least / (c[0].max(c[2]).sqrt());
        }
        let distance = self.border_distance(form, place.segment);
        ((distance - gap) / REACH).clamp(0.0, cap)
    }

    /// Distance of the point from the border of the enlarged segment, whose edges are straight.
    fn border_distance(&self, form: Form, segment: usize) -> f64 {
        let mut buffer = [[0.0; D]; MOST_POINTS];
        let x = self.surface.points(segment, self.x, &mut buffer);
        let m = |k: usize| self.margin(segment, k);
        let at = |xi: [f64; 2]| evaluate(form, x, xi).point;
        match corners(form.kind()) {
            2 => [at([-1.0 - m(0), 0.0]), at([1.0 + m(1), 0.0])]
                .iter()
                .fold(f64::INFINITY, |d, q| d.min(norm(&sub(&self.p, q)))),
            3 => self.polygon_distance(&[
                at([-m(2), -m(0)]),
                at([1.0 + m(0) + m(1), -m(0)]),
                at([-m(2), 1.0 + m(1) + m(2)]),
            ]),
            _ => self.polygon_distance(&[
                at([-1.0 - m(3), -1.0 - m(0)]),
                at([1.0 + m(1), -1.0 - m(0)]),
                at([1.0 + m(1), 1.0 + m(2)]),
                at([-1.0 - m(3), 1.0 + m(2)]),
            ]),
        }
    }

    fn polygon_distance(&self, corners: &[[f64; D]]) -> f64 {
        let n = corners.len();
        (0..n).fold(f64::INFINITY, |least, k| {
            let (a, b) = (&corners[k], &corners[(k + 1) % n]);
            let (e, d) = (sub(b, a), sub(&self.p, a));
            let s = (dot(&d, &e) / dot(&e, &e)).clamp(0.0, 1.0);
            least.min(norm(&sub(&self.p, &add(a, &scaled(&e, s)))))
        })
    }
}
