//! Finite sliding: the pairing follows the motion.
//!
//! A point is *held* by one segment between searches; the closest point x_c on the (continued) segment is found anew at
//! each measurement. The point of the last commit, its *anchor*, moves with the master as a material point x_a, and the
//! tangential increment is `d = x_c - x_a` in the present tangent plane. On one flat segment that is `e_m Δξ_m` with the
//! present base vectors, whatever the rotation; across coplanar segments it is the sum of the path; across a kink of angle
//! θ it is the chord, shorter than the path by at most θ²/8 of it within the one step that crosses.
//!
//! Tangential history is kept as components in the orthonormal frame of the anchor, `a_1 = e_1/|e_1|`, `a_2 = n_a × a_1`,
//! carried to the present tangent plane by the smallest rotation that takes n_a to n:
//! `a' = a - (n·a)/(1 + n_a·n) (n_a + n)`. Components are therefore unchanged by a rigid rotation, and the force turns
//! with the master.
//!
//! Linearisation (δ in the direction of one nodal component), with `A_ml = e_m·e_l - g_n n·e_m,l` the curvature-corrected
//! metric: `A_ml δξ_l = δ(u_s - N u)·e_m + g_n n·N_γ,m δx_γ`, `δg_n = n·δ(u_s - N u)`,
//! `δn = -(n·δe_m) e^m`, `δe_m = N_γ,m δx_γ + e_m,l δξ_l`. The reaction `N_γ f` moves with ξ, hence `N_γ,m δξ_m f`.

use super::column::{Column, Local};
use crate::measure::{Attachment, Exit, Geometry, Measure, Slides, Tractions};
use crate::search::project::{BORDER, Outcome, Projection, depth, foot, gather, margins};
use crate::search::surface::Surface;
use crate::shape::{MOST_NODES, shape};
use crate::spec::{Segment, SlavePoint, SurfaceNode};
use crate::vector::{add, axpy, dot, norm, perpendicular, sub, unit};
use asperity_fem::term::Pattern;

/// A held segment keeps its point until it lies this far outside, in natural coordinates: rounding and small movements
/// at a shared border do not change the pairing back and forth, and the continued segment is off by this times the kink.
const HYSTERESIS: f64 = 1e-3;

/// The same where the border is the rim of the surface: bodies that end together and deform differently must not lose
/// their last node.
const OVERRUN: f64 = 1e-2;

/// A point beyond the rim is paired anew when it lies off the normal through the rim by less than this share of the
/// segment's size, as in small sliding.
const RIM: f64 = 1e-6;

/// A point of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub segment: usize,
    pub xi: [f64; 2],
}

#[derive(Clone, Debug)]
struct Point {
    slave: SlavePoint,
    /// Where the closest point lies; the segment changes in searches only.
    place: Option<Place>,
    /// Where it lay at the last commit.
    anchor: Option<Place>,
    /// Paired since the last commit: the anchor is where the first search of the step found the point.
    fresh: bool,
    /// The last committed step ended on a border of the segment, moving outwards.
    leaving: bool,
    /// Nodes of its block: the slave, those of the held segment, those of the anchor's segment that are not yet there.
    nodes: Vec<usize>,
}

/// The measure.
#[derive(Clone, Debug)]
pub struct Finite<const D: usize> {
    surface: Surface<D>,
    reference: Vec<[f64; D]>,
    dofs: Vec<usize>,
    points: Vec<Point>,
    /// Positions of all nodes at the last measurement.
    x: Vec<[f64; D]>,
    pattern: Pattern,
}

impl<const D: usize> Finite<D> {
    /// Pairs the slave points on `surface` in the reference configuration. Returns the measure and the projections made.
    #[must_use]
    pub fn new(nodes: &[SurfaceNode<D>], slave: &[SlavePoint], surface: Surface<D>) -> (Self, u64) {
        let reference: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
        let point = |s: &SlavePoint| Point {
            slave: *s,
            place: None,
            anchor: None,
            fresh: false,
            leaving: false,
            nodes: Vec::new(),
        };
        let mut measure = Self {
            surface,
            x: reference.clone(),
            reference,
            dofs: nodes.iter().map(|n| n.dof).collect(),
            points: slave.iter().map(point).collect(),
            pattern: Pattern::default(),
        };
        let mut projections = 0;
        measure.search(&vec![[0.0; D]; nodes.len()], &mut projections);
        // The reference configuration counts as committed.
        measure.points.iter_mut().for_each(|p| p.fresh = false);
        (measure, projections)
    }

    fn configure(&mut self, u: &[[f64; D]]) {
        for ((x, r), u) in self.x.iter_mut().zip(&self.reference).zip(u) {
            *x = add(r, u);
        }
    }

    /// The segment that shall hold a point, with natural coordinates, from the present one.
    fn hold(&self, point: &Point, projections: &mut u64) -> Option<Place> {
        let p = &self.x[point.slave.node];
        let held = point.place.and_then(|h| self.foot_on(&h, p));
        if let Some(h) = held
            && !point.leaving
            && self.keeps(&h)
        {
            return held;
        }
        let (segment, found) = self.surface.closest(&self.x, p, projections)?;
        let found = if point.leaving {
            self.entering(held, segment, found, p, projections)
        } else {
            (segment, found)
        };
        let (segment, projection) = found;
        if self.surface.on_rim(segment, projection.outcome) && self.off_normal(segment, &projection, p) {
            return held.filter(|h| self.keeps(h));
        }
        (projection.outcome != Outcome::None).then_some(Place { segment, xi: projection.xi })
    }

    /// A point on a border belongs to the segment it is entering: another one than `held`, as close as the closest.
    fn entering(
        &self,
        held: Option<Place>,
        segment: usize,
        found: Projection<D>,
        p: &[f64; D],
        projections: &mut u64,
    ) -> (usize, Projection<D>) {
        let Some(held) = held.filter(|h| h.segment == segment) else { return (segment, found) };
        let reach = (found.distance_squared.sqrt() + BORDER * self.surface.size(segment)).powi(2);
        let other = self.surface.closest_but(held.segment, &self.x, p, projections);
        other.filter(|(_, o)| o.distance_squared <= reach).unwrap_or((segment, found))
    }

    /// Whether a held segment keeps its point.
    fn keeps(&self, place: &Place) -> bool {
        let kind = self.surface.segments()[place.segment].kind;
        margins(kind, place.xi).iter().enumerate().all(|(k, &m)| {
            let free = m < 0.0 && self.surface.border_is_free(place.segment, k);
            m >= if free { -OVERRUN } else { -HYSTERESIS }
        })
    }

    fn foot_on(&self, place: &Place, p: &[f64; D]) -> Option<Place> {
        let s = &self.surface.segments()[place.segment];
        let mut buffer = [[0.0; D]; MOST_NODES];
        let x = gather(&s.nodes, |n| self.x[n], &mut buffer);
        foot(s.kind, x, p, place.xi).map(|xi| Place { segment: place.segment, xi })
    }

    fn off_normal(&self, segment: usize, projection: &Projection<D>, p: &[f64; D]) -> bool {
        let local = Local::new(&self.surface.segments()[segment], &self.x, projection.xi);
        let mut off = sub(p, &projection.point);
        let along = dot(&off, &local.n);
        axpy(&mut off, -along, &local.n);
        norm(&off) > RIM * self.surface.size(segment)
    }

    /// Rebuilds the blocks; the version changes when they do.
    fn rebuild(&mut self) {
        let mut changed = false;
        for point in &mut self.points {
            let mut nodes = Vec::with_capacity(point.nodes.len());
            if let (Some(place), Some(anchor)) = (point.place, point.anchor) {
                nodes.push(point.slave.node);
                nodes.extend_from_slice(&self.surface.segments()[place.segment].nodes);
                for &n in &self.surface.segments()[anchor.segment].nodes {
                    if !nodes.contains(&n) {
                        nodes.push(n);
                    }
                }
            }
            if nodes != point.nodes {
                point.nodes = nodes;
                changed = true;
            }
        }
        if changed {
            let dofs = &self.dofs;
            let blocks: Vec<Vec<usize>> = self
                .points
                .iter()
                .filter(|p| !p.nodes.is_empty())
                .map(|p| p.nodes.iter().flat_map(|&n| dofs[n]..dofs[n] + D).collect())
                .collect();
            self.pattern = Pattern::of_blocks(self.pattern.version + 1, blocks.iter().map(Vec::as_slice));
        }
    }

    fn segment(&self, place: &Place) -> &Segment {
        &self.surface.segments()[place.segment]
    }

    fn local(&self, place: &Place) -> Local<D> {
        Local::new(self.segment(place), &self.x, place.xi)
    }
}

impl<const D: usize> Measure<D> for Finite<D> {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn search(&mut self, u: &[[f64; D]], projections: &mut u64) -> bool {
        self.configure(u);
        self.surface.refit(&self.x);
        for p in 0..self.points.len() {
            let place = self.hold(&self.points[p], projections);
            let point = &mut self.points[p];
            if place.map(|h| h.segment) != point.place.map(|h| h.segment) {
                point.leaving = false;
            }
            point.place = place;
            // A point that meets the master within this step has slipped nothing before.
            point.fresh |= point.anchor.is_none() && place.is_some();
            point.anchor = point.anchor.or(place);
        }
        self.rebuild();
        true
    }

    fn measure(&mut self, u: &[[f64; D]], out: &mut Geometry<D>) {
        self.configure(u);
        for p in 0..self.points.len() {
            let (Some(place), Some(anchor)) = (self.points[p].place, self.points[p].anchor) else {
                out.paired[p] = false;
                out.gap[p] = f64::INFINITY;
                out.increment[p] = [0.0; 2];
                continue;
            };
            let x = self.x[self.points[p].slave.node];
            out.paired[p] = true;
            let Some(place) = self.foot_on(&place, &x) else {
                out.gap[p] = f64::NAN;
                continue;
            };
            self.points[p].place = Some(place);
            let (here, there) = (self.local(&place), self.local(&anchor));
            let frame = here.carry(&there);
            let d = sub(&here.point, &there.point);
            out.gap[p] = dot(&here.n, &sub(&x, &here.point));
            out.normal[p] = here.n;
            out.frame[p] = frame;
            out.increment[p] = [dot(&frame[0], &d), dot(&frame[1], &d)];
        }
    }

    fn spread(&self, force: &[[f64; D]], residual: &mut [f64]) {
        for (point, f) in self.points.iter().zip(force) {
            let Some(place) = point.place else { continue };
            let mut add = |node: usize, c: f64| {
                let d = self.dofs[node];
                for (r, fi) in residual[d..d + D].iter_mut().zip(f) {
                    *r += c * fi;
                }
            };
            let s = self.segment(&place);
            let shapes = shape(s.kind, place.xi);
            add(point.slave.node, -point.slave.area);
            for (k, &n) in s.nodes.iter().enumerate() {
                add(n, point.slave.area * shapes.value[k]);
            }
        }
    }

    fn tangent(&self, geometry: &Geometry<D>, tractions: Tractions<'_>, values: &mut [f64]) {
        let mut at = 0;
        for (p, point) in self.points.iter().enumerate() {
            let size = point.nodes.len() * D;
            let block = &mut values[at..at + size * size];
            at += block.len();
            let (Some(place), Some(anchor), true) = (point.place, point.anchor, tractions.normal[p].closed)
            else {
                block.fill(0.0);
                continue;
            };
            let (here, there) = (self.local(&place), self.local(&anchor));
            let shear = tractions.shear.map(|s| &s[p]);
            let column =
                Column::new(&here, &there, geometry, p, &tractions.normal[p], shear, tractions.stiffness);
            let held = &self.segment(&place).nodes;
            let from = &self.segment(&anchor).nodes;
            for (k, &node) in point.nodes.iter().enumerate() {
                let gamma = if k > 0 { held.iter().position(|&n| n == node) } else { None };
                let alpha = if k > 0 { from.iter().position(|&n| n == node) } else { None };
                for i in 0..D {
                    let (df, dxi) = column.derivative(k == 0, gamma, alpha, i);
                    write_column(
                        block,
                        size,
                        k * D + i,
                        point.slave.area,
                        &here,
                        held.len(),
                        &column.force,
                        &df,
                        &dxi,
                    );
                }
            }
        }
    }

    fn slides(&self, geometry: &Geometry<D>, du: &[[f64; D]], out: &mut Slides) {
        for (p, point) in self.points.iter().enumerate() {
            let Some(place) = point.place else {
                out.gap[p] = 0.0;
                out.increment[p] = [0.0; 2];
                continue;
            };
            let local = self.local(&place);
            let (gap, dxi) =
                local.rates(geometry.gap[p], &du[point.slave.node], &self.segment(&place).nodes, du);
            let mut slide = [0.0; D];
            axpy(&mut slide, dxi[0], &local.e[0]);
            axpy(&mut slide, dxi[1], &local.e[1]);
            out.gap[p] = gap;
            out.increment[p] = [dot(&geometry.frame[p][0], &slide), dot(&geometry.frame[p][1], &slide)];
        }
    }

    fn exit(&self, du: &[[f64; D]]) -> Option<Exit> {
        let mut best: Option<Exit> = None;
        for (p, point) in self.points.iter().enumerate() {
            let Some(place) = point.place else { continue };
            let local = self.local(&place);
            let s = self.segment(&place);
            let gap = dot(&local.n, &sub(&self.x[point.slave.node], &local.point));
            let (_, dxi) = local.rates(gap, &du[point.slave.node], &s.nodes, du);
            let (now, then) = (margins(s.kind, place.xi), margins(s.kind, add(&place.xi, &dxi)));
            for (a, b) in now.into_iter().zip(then) {
                // A point on the border, or beyond it, is already leaving and does not limit.
                if a > BORDER && b < 0.0 && best.is_none_or(|e| a / (a - b) < e.fraction) {
                    best = Some(Exit { fraction: a / (a - b), point: p });
                }
            }
        }
        best
    }

    fn commit(&mut self, _geometry: &Geometry<D>, reframe: &mut dyn FnMut(usize, &[[f64; D]; 2])) {
        for p in 0..self.points.len() {
            self.points[p].fresh = false;
            let Some(place) = self.points[p].place else {
                self.points[p].anchor = None;
                continue;
            };
            reframe(p, &self.local(&place).frame);
            let kind = self.segment(&place).kind;
            let point = &mut self.points[p];
            let outwards = point
                .anchor
                .is_some_and(|a| a.segment != place.segment || depth(kind, place.xi) < depth(kind, a.xi));
            point.leaving = outwards && depth(kind, place.xi) <= BORDER;
            point.anchor = Some(place);
        }
    }

    fn revert(&mut self) {
        for point in &mut self.points {
            point.anchor = point.anchor.filter(|_| !point.fresh);
            point.fresh = false;
            point.place = point.anchor;
        }
    }

    fn attachments(&self, p: usize, out: &mut Vec<Attachment>) {
        out.clear();
        if let Some(place) = self.points[p].place {
            let s = self.segment(&place);
            let shapes = shape(s.kind, place.xi);
            out.push(Attachment { node: self.points[p].slave.node, weight: 1.0, slave: true });
            let master = s.nodes.iter().zip(shapes.value);
            out.extend(master.map(|(&node, n)| Attachment { node, weight: -n, slave: false }));
        }
    }

    fn areas(&self, out: &mut [f64]) {
        for (a, p) in out.iter_mut().zip(&self.points) {
            *a = p.slave.area;
        }
    }

    fn collocated(&self) -> bool {
        true
    }

    fn follows(&self) -> bool {
        true
    }

    fn save(&self, out: &mut Vec<f64>) {
        for point in &self.points {
            match point.anchor {
                #[expect(clippy::cast_precision_loss, reason = "segment numbers are far below 2^53")]
                Some(a) => out.extend_from_slice(&[a.segment as f64, a.xi[0], a.xi[1]]),
                None => out.extend_from_slice(&[-1.0, 0.0, 0.0]),
            }
            out.push(f64::from(u8::from(point.leaving)));
        }
    }

    fn saved(&self) -> usize {
        4 * self.points.len()
    }

    fn restore(&mut self, from: &[f64]) {
        for (point, v) in self.points.iter_mut().zip(from.chunks_exact(4)) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "written by save")]
            let anchor = (v[0] >= 0.0).then(|| Place { segment: v[0] as usize, xi: [v[1], v[2]] });
            point.anchor = anchor;
            point.place = anchor;
            point.fresh = false;
            point.leaving = v[3] > 0.0;
        }
        self.rebuild();
    }
}

/// Writes one column of a block from the derivatives of the force per area and of ξ.
#[expect(clippy::too_many_arguments, reason = "plain numbers of one kernel")]
fn write_column<const D: usize>(
    block: &mut [f64],
    size: usize,
    column: usize,
    area: f64,
    here: &Local<D>,
    held: usize,
    force: &[f64; D],
    df: &[f64; D],
    dxi: &[f64; 2],
) {
    for i in 0..D {
        block[i * size + column] = -area * df[i];
    }
    for g in 0..held {
        let moved = here.shape.first[0][g] * dxi[0] + here.shape.first[1][g] * dxi[1];
        for i in 0..D {
            block[((1 + g) * D + i) * size + column] =
                area * (here.shape.value[g] * df[i] + moved * force[i]);
        }
    }
    for row in (1 + held) * D..size {
        block[row * size + column] = 0.0;
    }
}

/// Orthonormal frame and normal of base vectors.
pub(super) fn frame_of<const D: usize>(e: &[[f64; D]; 2]) -> ([f64; D], [[f64; D]; 2]) {
    let n = unit(&perpendicular(e));
    let a1 = unit(&e[0]);
    (n, [a1, crate::vector::cross(&n, &a1)])
}
