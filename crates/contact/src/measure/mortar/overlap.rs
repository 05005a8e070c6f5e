//! Overlap of two facets in space, with the derivatives of its integrals with respect to the positions of all nodes.
//!
//! The integrals are those of `cell`: products of the functions of the slave facet's corners with those of both faces, in the plane
//! of the slave. Between faces of first order there are 26, since faces and facets are the same. A corner of the common polygon is a node of either facet or the
//! intersection of two edges; a Gauss point is a mean of three corners. Each Gauss point thus contributes to few numbers. These
//! are the slopes with respect to the corners of its triangle and, for motion of the facets at a fixed position, with respect
//! to the nodes of both facets. The slopes of corners are then passed on to nodes. A rigid motion in the plane changes no
//! integral, so of the motion of the plane itself only its tilt remains.
//!
//! Natural coordinates and functions are those of `plane_face`. Points of the plane are `b_m·(x - o)`. A tilt δn moves them by
//! `-h (b_m·δn)`, with h the height above the plane.

use super::clip::twice_area;
use super::facet::{Facet, NODES};
use super::plane_face::{Density, Functions, PlaneFace};
use super::polygon::{Corner, Crossing, Polygon};
use super::rule::Rule;
use crate::SegmentKind;
use crate::shape::MOST_NODES;
use crate::vector::{axpy, cross, dot, norm, scaled, sub, unit};

/// Most nodes of a face, its middle included.
pub(super) const MOST: usize = MOST_NODES;

/// Number of slots for the nodes of both faces, the slave's first.
pub(super) const BOTH: usize = 2 * MOST;

/// Products of functions b of the slave facet's corners: with the functions of the slave's face, `own` in all, and with the `F`
/// functions of the master's face. If faces are of first order (`F` = [`NODES`]), products of two functions b and k of the slave are
/// stored once.
#[derive(Clone, Copy, Debug)]
struct Products<const O: usize, const F: usize> {
    own: [f64; O],
    other: [[f64; F]; NODES],
}

/// Number of products of two of four functions.
const LINEAR: usize = NODES * (NODES + 1) / 2;

/// Number of products of four functions with those of a face.
const GENERAL: usize = NODES * MOST;

impl<const O: usize, const F: usize> Products<O, F> {
    const ZERO: Self = Self { own: [0.0; O], other: [[0.0; F]; NODES] };

    /// Index of the product of slave functions b and k.
    #[inline]
    fn place(b: usize, k: usize) -> usize {
        if F > NODES {
            return b * F + k;
        }
        let (low, high) = (b.min(k), b.max(k));
        low * (2 * NODES + 1 - low) / 2 + high - low
    }

    /// First slave function k whose product with b is stored with b.
    #[inline]
    fn first(b: usize) -> usize {
        if F > NODES { 0 } else { b }
    }

    #[inline]
    fn add(&mut self, c: f64, by: &Self) {
        self.own.iter_mut().zip(&by.own).for_each(|(t, b)| *t += c * b);
        self.add_other(c, &by.other);
    }

    #[inline]
    fn add_other(&mut self, c: f64, by: &[[f64; F]; NODES]) {
        let (to, by) = (self.other.as_flattened_mut(), by.as_flattened());
        to.iter_mut().zip(by).for_each(|(t, b)| *t += c * b);
    }
}

/// Pieces smaller than this share of the slave facet result from rounding of coinciding edges.
const SLIVER: f64 = 1e-15;

/// A facet and its position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<'a> {
    pub facet: &'a Facet,
    /// Present positions of the nodes of its face, and of the middle of the face if that is a corner.
    pub x: &'a [[f64; 3]],
}

impl Side<'_> {
    /// Position of a corner.
    #[inline]
    fn corner(&self, corner: usize) -> &[f64; 3] {
        &self.x[self.facet.corners[corner]]
    }
}

/// A pair of facets in the plane of the slave.
struct Pair<'a> {
    sides: [Side<'a>; 2],
    reference: &'a [[f64; 3]],
    /// Nodes of both faces in the plane.
    flat: [[f64; 2]; BOTH],
    base: [[f64; 3]; 2],
    normal: [f64; 3],
    /// Length of the vector product that gives the normal.
    length: f64,
    polygon: Polygon,
    /// Twice the area below which a triangle is negligible.
    least: f64,
}

/// Both faces in the plane, and the ratio of areas.
struct Faces<'a> {
    own: PlaneFace<'a>,
    other: PlaneFace<'a>,
    density: Density<'a>,
}

/// Index of the centroid among the corners, as the apex of a fan.
const CENTROID: usize = Polygon::MOST;

/// Slopes of the integrals in the plane with respect to corners of the polygon and to nodes of the faces, along both axes.
struct Slopes<const O: usize, const F: usize> {
    /// Slopes with respect to corners of the polygon. The last is the centroid, used if it is the apex of the fan.
    corners: [[Products<O, F>; 2]; CENTROID + 1],
    own: [[Products<O, F>; 2]; F],
    other: [[Products<O, F>; 2]; F],
}

/// The facets of a cell and their quadrature rule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facets<'a> {
    pub slave: Side<'a>,
    /// Reference positions of the nodes of the slave's face.
    pub reference: &'a [[f64; 3]],
    pub master: Side<'a>,
    pub rule: &'a Rule,
}

impl Facets<'_> {
    /// True if both faces are of first order, and thus their own facets.
    fn linear(&self) -> bool {
        [self.slave, self.master].iter().all(|side| side.facet.face.kind.first_order())
    }
}

/// Integrals over the overlap for functions b of the slave's corners: ∫ λ_b N_k for nodes of the slave's face, and ∫ λ_b N_γ for
/// those of the master's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integrals {
    pub own: [[f64; MOST]; NODES],
    pub other: [[f64; MOST]; NODES],
}

/// Derivatives of one integral with respect to node (the slave's first, its middle included) and axis.
pub(super) type Gradient = [[f64; 3]; BOTH];

/// Derivatives of the integrals.
#[derive(Clone, Debug)]
pub(super) struct Derivatives {
    pub own: [[Gradient; MOST]; NODES],
    pub other: [[Gradient; MOST]; NODES],
}

impl Derivatives {
    /// Derivatives of integrals that are constant.
    pub(super) fn zero() -> Self {
        let zero = [[[[0.0; 3]; BOTH]; MOST]; NODES];
        Self { own: zero, other: zero }
    }
}

/// Integrates the overlap of a slave facet with a master facet; `None` if they do not overlap.
pub(super) fn integrals(facets: &Facets<'_>) -> Option<Integrals> {
    let pair = Pair::new(facets)?;
    Some(if facets.linear() {
        pair.integrals::<LINEAR, NODES>(facets.rule)
    } else {
        pair.integrals::<GENERAL, MOST>(facets.rule)
    })
}

/// Computes the derivatives of these integrals for the functions of both faces; others are not written. Returns false if the facets do
/// not overlap.
pub(super) fn derivatives(facets: &Facets<'_>, out: &mut Derivatives) -> bool {
    let Some(pair) = Pair::new(facets) else { return false };
    if facets.linear() {
        pair.derivatives::<LINEAR, NODES>(facets.rule, out);
    } else {
        pair.derivatives::<GENERAL, MOST>(facets.rule, out);
    }
    true
}

/// A triangle of the fan: its corners, their positions, and twice its area.
struct Triangle {
    corners: [usize; 3],
    at: [[f64; 2]; 3],
    double: f64,
}

/// Values at a Gauss point.
struct Point<const F: usize> {
    /// Functions of the slave's corners.
    corners: Functions<NODES>,
    /// Functions of both faces.
    own: Functions<F>,
    other: Functions<F>,
    /// Base vectors of the slave's face in the plane.
    base: [[f64; 2]; 2],
    inverse: [[f64; 2]; 2],
    other_inverse: [[f64; 2]; 2],
    density: f64,
    density_slopes: [f64; 2],
    plane: f64,
}

/// Product of two sides of a triangle, or of the diagonals of a quadrilateral.
fn normal_product(side: &Side<'_>) -> [f64; 3] {
    let [p, q] = spans(side);
    cross(&p, &q)
}

/// Two sides of a triangle, or the diagonals of a quadrilateral.
fn spans(side: &Side<'_>) -> [[f64; 3]; 2] {
    let x = |corner| side.corner(corner);
    if side.facet.kind == SegmentKind::Tri3 {
        [sub(x(1), x(0)), sub(x(2), x(0))]
    } else {
        [sub(x(2), x(0)), sub(x(3), x(1))]
    }
}

/// Base of the plane with this normal, the first vector along a side.
fn plane_base(side: &[f64; 3], normal: &[f64; 3]) -> [[f64; 3]; 2] {
    let mut first = *side;
    axpy(&mut first, -dot(normal, side), normal);
    let first = unit(&first);
    [first, cross(normal, &first)]
}

/// Coordinates of a vector in a base.
fn coordinates(d: &[f64; 3], base: &[[f64; 3]; 2]) -> [f64; 2] {
    [dot(d, &base[0]), dot(d, &base[1])]
}

impl<'a> Pair<'a> {
    /// Projects a pair of facets; `None` if they do not overlap.
    fn new(facets: &Facets<'a>) -> Option<Self> {
        let Facets { slave, reference, master, .. } = *facets;
        let product = normal_product(&slave);
        let length = norm(&product);
        let normal = scaled(&product, length.recip());
        let origin = slave.corner(0);
        let base = plane_base(&sub(slave.corner(1), origin), &normal);
        let mut flat = [[0.0; 2]; BOTH];
        let put = |to: &mut [[f64; 2]], from: &[[f64; 3]]| {
            for (f, p) in to.iter_mut().zip(from) {
                *f = coordinates(&sub(p, origin), &base);
            }
        };
        put(&mut flat[..MOST], slave.x);
        put(&mut flat[MOST..], master.x);
        let own = Polygon::from_nodes(slave.facet.corners.iter().map(|&k| (flat[k], k)));
        // The master runs in the opposite direction.
        let other =
            Polygon::from_nodes(master.facet.corners.iter().rev().map(|&k| (flat[MOST + k], MOST + k)));
        if other.twice_area() <= 0.0 || own.apart(&other) {
            return None;
        }
        let least = SLIVER * own.twice_area();
        let polygon = own.clipped(&other, &flat);
        let corner = |k: usize| &polygon.at[k].at;
        if !(2..polygon.corners).any(|k| twice_area(corner(0), corner(k - 1), corner(k)) > least) {
            return None;
        }
        let sides = [slave, master];
        Some(Self { sides, reference, flat, base, normal, length, polygon, least })
    }

    /// Faces in the plane; `linear` if both are of first order.
    fn faces(&self, linear: bool) -> Faces<'_> {
        let [s, m] = self.sides.map(|side| side.facet.face.nodes.len());
        let own = PlaneFace::new(self.sides[0].facet, &self.flat[..s], linear);
        let other = PlaneFace::new(self.sides[1].facet, &self.flat[MOST..MOST + m], linear);
        let density = Density::new(&own, self.reference);
        Faces { own, other, density }
    }

    fn integrals<const O: usize, const F: usize>(&self, rule: &Rule) -> Integrals {
        let mut sums = Products::<O, F>::ZERO;
        let faces = self.faces(F == NODES);
        for triangle in self.triangles(rule) {
            faces.triangle(&triangle, rule, &mut sums);
        }
        let mut out = Integrals { own: [[0.0; MOST]; NODES], other: [[0.0; MOST]; NODES] };
        for b in 0..NODES {
            (0..F).for_each(|k| out.own[b][k] = sums.own[Products::<O, F>::place(b, k)]);
            out.other[b][..F].copy_from_slice(&sums.other[b]);
        }
        out
    }

    fn derivatives<const O: usize, const F: usize>(&self, rule: &Rule, out: &mut Derivatives) {
        let zero = [Products::<O, F>::ZERO; 2];
        let mut slopes = Slopes { corners: [zero; CENTROID + 1], own: [zero; F], other: [zero; F] };
        let faces = self.faces(F == NODES);
        let nodes = self.sides.map(|side| side.facet.face.nodes.len());
        for triangle in self.triangles(rule) {
            faces.sloped_triangle(&triangle, rule, nodes, &mut slopes);
        }
        if rule.centred {
            self.hand_on_centroid(&mut slopes.corners);
        }
        self.hand_on(&mut slopes);
        self.spread(&slopes, out);
    }

    /// Triangles of the overlap that are not negligible, in a fan about the centroid or else about the first corner.
    fn triangles(&self, rule: &Rule) -> impl Iterator<Item = Triangle> {
        let corners = self.polygon.corners;
        let centroid = if rule.centred { self.polygon.centroid() } else { [0.0; 2] };
        let place = move |c: usize| if c == CENTROID { centroid } else { self.polygon.at[c].at };
        let range = if rule.centred { 0..corners } else { 1..corners - 1 };
        let apex = if rule.centred { CENTROID } else { 0 };
        let triangle = move |k: usize| {
            let corners = [apex, k, (k + 1) % corners];
            let at = corners.map(place);
            Triangle { corners, at, double: twice_area(&at[0], &at[1], &at[2]) }
        };
        range.map(triangle).filter(|t| t.double > self.least)
    }

    /// Passes the slopes with respect to the centroid on to the corners.
    fn hand_on_centroid<const O: usize, const F: usize>(
        &self,
        corners: &mut [[Products<O, F>; 2]; CENTROID + 1],
    ) {
        let (corners, centroid) = corners.split_at_mut(CENTROID);
        for (to, slope) in corners.iter_mut().zip(self.polygon.centroid_slopes()) {
            for (m, to) in to.iter_mut().enumerate() {
                (0..2).for_each(|i| to.add(slope[i][m], &centroid[0][i]));
            }
        }
    }

    /// Passes the slopes with respect to corners on to the nodes on which they depend.
    fn hand_on<const O: usize, const F: usize>(&self, slopes: &mut Slopes<O, F>) {
        let Slopes { corners, own, other } = slopes;
        for (corner, by) in self.polygon.at[..self.polygon.corners].iter().zip(corners.iter()) {
            let mut add = |v: usize, m: usize, c: f64, by: &Products<O, F>| {
                let node = if v < MOST { &mut own[v] } else { &mut other[v - MOST] };
                node[m].add(c, by);
            };
            match corner {
                Corner { of: Crossing::None(v), .. } => (0..2).for_each(|m| add(*v, m, 1.0, &by[m])),
                Corner { of: Crossing::Of(lines), .. } => {
                    for (v, c) in corner.slopes(lines, &self.flat) {
                        for (c, by) in c.iter().zip(by) {
                            (0..2).for_each(|m| add(v, m, c[m], by));
                        }
                    }
                }
            }
        }
    }

    /// Converts motions in the plane to motions in space.
    fn spread<const O: usize, const F: usize>(&self, slopes: &Slopes<O, F>, out: &mut Derivatives) {
        let origin = self.sides[0].corner(0);
        let mut height = [0.0; BOTH];
        for (side, h) in self.sides.iter().zip(height.chunks_exact_mut(MOST)) {
            h.iter_mut().zip(side.x).for_each(|(h, x)| *h = dot(&self.normal, &sub(x, origin)));
        }
        let slots = [0..self.sides[0].x.len(), MOST..MOST + self.sides[1].x.len()];
        let slots = || slots.iter().cloned().flatten();
        let tilts = self.tilts();
        let gradient = |of: &dyn Fn(&Products<O, F>) -> f64, to: &mut Gradient| {
            let mut tilted = [0.0; 2];
            for n in slots() {
                let node = if n < MOST { &slopes.own[n] } else { &slopes.other[n - MOST] };
                let by = [of(&node[0]), of(&node[1])];
                (0..2).for_each(|m| tilted[m] += height[n] * by[m]);
                to[n] = scaled(&self.base[0], by[0]);
                axpy(&mut to[n], by[1], &self.base[1]);
            }
            for (&corner, tilt) in self.sides[0].facet.corners.iter().zip(&tilts) {
                axpy(&mut to[corner], -tilted[0], &tilt[0]);
                axpy(&mut to[corner], -tilted[1], &tilt[1]);
            }
        };
        let [own, other] = self.sides.map(|side| side.facet.face.nodes.len());
        for b in 0..self.sides[0].facet.nodes.len() {
            for k in 0..own {
                let place = Products::<O, F>::place(b, k);
                gradient(&|p| p.own[place], &mut out.own[b][k]);
            }
            for k in 0..other {
                gradient(&|p| p.other[b][k], &mut out.other[b][k]);
            }
        }
    }

    /// Derivatives of `b_m·δn` with respect to the positions of the slave's corners.
    fn tilts(&self) -> [[[f64; 3]; 2]; NODES] {
        let share = self.length.recip();
        let mut out = [[[0.0; 3]; 2]; NODES];
        let [p, q] = spans(&self.sides[0]);
        for (m, b) in self.base.iter().enumerate() {
            // Product b·(δp × q + p × δq).
            let (dp, dq) = (scaled(&cross(&q, b), share), scaled(&cross(b, &p), share));
            if self.sides[0].facet.kind == SegmentKind::Tri3 {
                (out[1][m], out[2][m]) = (dp, dq);
                out[0][m] = std::array::from_fn(|i| -dp[i] - dq[i]);
            } else {
                (out[2][m], out[0][m]) = (dp, scaled(&dp, -1.0));
                (out[3][m], out[1][m]) = (dq, scaled(&dq, -1.0));
            }
        }
        out
    }
}

impl Faces<'_> {
    /// Evaluates the faces at a position in the plane.
    #[inline]
    fn point<const F: usize>(&self, y: &[f64; 2]) -> Point<F> {
        let (own, other) = (self.own.locate::<F>(y), self.other.locate::<F>(y));
        let corners = self.own.corners(&own);
        let (density, density_slopes, plane) = self.density.at(&self.own, &own);
        Point {
            corners,
            own: own.functions,
            other: other.functions,
            base: own.base,
            inverse: own.inverse,
            other_inverse: other.inverse,
            density,
            density_slopes,
            plane,
        }
    }

    fn triangle<const O: usize, const F: usize>(&self, t: &Triangle, rule: &Rule, sums: &mut Products<O, F>) {
        for (share, weight) in &rule.triangle {
            let g = self.point::<F>(&mean(&t.at, share));
            let w = t.double * weight * g.density;
            for b in 0..NODES {
                let wb = w * g.corners.0[b];
                for k in Products::<O, F>::first(b)..F {
                    sums.own[Products::<O, F>::place(b, k)] += wb * g.own.0[k];
                }
                (0..F).for_each(|k| sums.other[b][k] += wb * g.other.0[k]);
            }
        }
    }

    /// Adds the slopes of the integrals over a triangle, for faces of these numbers of nodes.
    fn sloped_triangle<const O: usize, const F: usize>(
        &self,
        t: &Triangle,
        rule: &Rule,
        [own, other]: [usize; 2],
        slopes: &mut Slopes<O, F>,
    ) {
        let mut sums = Products::ZERO;
        for (share, weight) in &rule.triangle {
            let g = self.point::<F>(&mean(&t.at, share));
            let w = t.double * weight;
            let (values, by_own, by_other) = products(&g, w);
            sums.add(1.0, &values);
            for m in 0..2 {
                for (c, s) in t.corners.iter().zip(share) {
                    let to = &mut slopes.corners[*c][m];
                    to.add(*s, &by_own[m]);
                    to.add_other(*s, &by_other[m]);
                }
            }
            for (n, to) in slopes.own.iter_mut().enumerate().take(own) {
                let turned = g.area_slopes(n);
                for ((to, by), turned) in to.iter_mut().zip(&by_own).zip(&turned) {
                    to.add(-g.own.0[n], by);
                    to.add(-turned / g.plane, &values);
                }
            }
            for (n, to) in slopes.other.iter_mut().enumerate().take(other) {
                (0..2).for_each(|m| to[m].add_other(-g.other.0[n], &by_other[m]));
            }
        }
        // The area of the triangle scales the whole contribution.
        for (i, c) in t.corners.iter().enumerate() {
            let (p, q) = (&t.at[(i + 1) % 3], &t.at[(i + 2) % 3]);
            slopes.corners[*c][0].add((p[1] - q[1]) / t.double, &sums);
            slopes.corners[*c][1].add((q[0] - p[0]) / t.double, &sums);
        }
    }
}

impl<const F: usize> Point<F> {
    /// Change of the area element with slave node `n` in the plane.
    #[inline]
    fn area_slopes(&self, n: usize) -> [f64; 2] {
        let ([s, t], [e, f]) = (&self.own.1, &self.base);
        [s[n] * f[1] - t[n] * e[1], t[n] * e[0] - s[n] * f[0]]
    }
}

#[inline]
fn mean(corners: &[[f64; 2]; 3], share: &[f64; 3]) -> [f64; 2] {
    std::array::from_fn(|i| share[0] * corners[0][i] + share[1] * corners[1][i] + share[2] * corners[2][i])
}

/// Products at a Gauss point, times its weight, and their slopes with respect to its position: through the natural coordinates of
/// the slave, and through those of the master.
type PointProducts<const O: usize, const F: usize> =
    (Products<O, F>, [Products<O, F>; 2], [[[f64; F]; NODES]; 2]);

/// Products of all pairs of functions at a Gauss point.
#[inline]
fn products<const O: usize, const F: usize>(g: &Point<F>, w: f64) -> PointProducts<O, F> {
    let mut values = Products::<O, F>::ZERO;
    let mut by_own = [values; 2];
    let mut by_other = [[[0.0; F]; NODES]; 2];
    let wd = w * g.density;
    let (weights, own, other) = (&g.corners.0, &g.own.0, &g.other.0);
    for i in 0..2 {
        let dense = w * (g.density_slopes[0] * g.inverse[0][i] + g.density_slopes[1] * g.inverse[1][i]);
        let weights_by: [f64; NODES] = along(&g.corners.1, &g.inverse, i, wd);
        let own_by: [f64; F] = along(&g.own.1, &g.inverse, i, wd);
        let other_by: [f64; F] = along(&g.other.1, &g.other_inverse, i, wd);
        for b in 0..NODES {
            let first = dense * weights[b] + weights_by[b];
            for k in Products::<O, F>::first(b)..F {
                by_own[i].own[Products::<O, F>::place(b, k)] = first * own[k] + weights[b] * own_by[k];
            }
            for k in 0..F {
                by_own[i].other[b][k] = first * other[k];
                by_other[i][b][k] = weights[b] * other_by[k];
            }
        }
    }
    for (b, weight) in weights.iter().enumerate() {
        for (k, own) in own.iter().enumerate().skip(Products::<O, F>::first(b)) {
            values.own[Products::<O, F>::place(b, k)] = wd * weight * own;
        }
        values.other[b].iter_mut().zip(other).for_each(|(to, other)| *to = wd * weight * other);
    }
    (values, by_own, by_other)
}

/// Slopes of functions along axis `i` of the plane, times `c`.
#[inline]
fn along<const F: usize>(slopes: &[[f64; F]; 2], inverse: &[[f64; 2]; 2], i: usize, c: f64) -> [f64; F] {
    std::array::from_fn(|k| c * (slopes[0][k] * inverse[0][i] + slopes[1][k] * inverse[1][i]))
}

#[cfg(test)]
mod tests;
