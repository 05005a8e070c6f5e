//! Overlap of two facets in space, with the derivatives of its integrals with respect to the positions of all nodes.
//!
//! The integrals are those of `cell`: products of the functions of the slave facet's corners with those of both faces, in the plane
//! of the slave. A corner of the common polygon is a node of either facet or the intersection of two edges; a Gauss point is a mean
//! of three corners. Each Gauss point thus contributes to few numbers. These are the slopes with respect to the corners of its
//! triangle and, for motion of the facets at a fixed position, with respect to the nodes of both facets. The slopes of corners are
//! then passed on to nodes. Changes of the area element are linear in the natural coordinates of a face of first order, so that
//! moments of the integrals give them. A rigid motion in the plane changes no
//! integral, so of the motion of the plane itself only its tilt remains.
//!
//! Natural coordinates and functions are those of `plane_face`. Points of the plane are `b_m·(x - o)`. A tilt δn moves them by
//! `-h (b_m·δn)`, with h the height above the plane.

use super::clip::twice_area;
use super::facet::{Facet, NODES};
use super::plane_face::{Density, Functions, PlaneFace, area_slopes};
use super::polygon::{Crossing, Polygon};
use super::rule::Rule;
use crate::SegmentKind;
use crate::shape::MOST_NODES;
use crate::vector::{axpy, cross, dot, norm, scaled, sub, unit};
use pulp::{Arch, Simd, WithSimd};

/// Most nodes of a face, its middle included.
pub(super) const MOST: usize = MOST_NODES;

/// Number of slots for the nodes of both faces, the slave's first.
pub(super) const BOTH: usize = 2 * MOST;

/// Products of functions b of the slave facet's corners with the `F` functions of the slave's face and with those of the master's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Products<const F: usize> {
    pub own: [[f64; F]; NODES],
    pub other: [[f64; F]; NODES],
}

/// Gauss points that are evaluated together, so that their slopes are added to each sum at once.
const GROUP: usize = 3;

// The loops are plain, so that they are compiled into their callers and thus for their instructions.
impl<const F: usize> Products<F> {
    const ZERO: Self = Self { own: [[0.0; F]; NODES], other: [[0.0; F]; NODES] };

    #[inline(always)]
    fn add(&mut self, c: f64, by: &Self) {
        for (to, by) in [(&mut self.own, &by.own), (&mut self.other, &by.other)] {
            for (t, b) in to.as_flattened_mut().iter_mut().zip(by.as_flattened()) {
                *t += c * b;
            }
        }
    }

    /// Adds c times the products of each point of a group.
    #[inline(always)]
    fn add_group(&mut self, c: [f64; GROUP], by: [&Self; GROUP]) {
        let [p, q, r] = by;
        add_group(&mut self.own, c, [&p.own, &q.own, &r.own]);
        add_group(&mut self.other, c, [&p.other, &q.other, &r.other]);
    }
}

#[inline(always)]
fn add_group<const F: usize>(
    to: &mut [[f64; F]; NODES],
    c: [f64; GROUP],
    [p, q, r]: [&[[f64; F]; NODES]; GROUP],
) {
    for (b, to) in to.iter_mut().enumerate() {
        for (k, to) in to.iter_mut().enumerate() {
            *to += c[0] * p[b][k] + c[1] * q[b][k] + c[2] * r[b][k];
        }
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
struct Slopes<const F: usize> {
    /// Slopes with respect to corners of the polygon. The last is the centroid, used if it is the apex of the fan.
    corners: [[Products<F>; 2]; CENTROID + 1],
    own: [[Products<F>; 2]; F],
    other: [[Products<F>; 2]; F],
    /// Integrals over the area in the plane, of themselves and times both natural coordinates, if faces are of first order.
    moments: [Products<F>; 3],
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

/// Integrals over the overlap for functions b of the slave's corners: ∫ λ_b N_k for nodes of the slave's face, and ∫ λ_b N_γ for
/// those of the master's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integrals {
    pub own: [[f64; MOST]; NODES],
    pub other: [[f64; MOST]; NODES],
}

impl Integrals {
    pub(super) fn zero() -> Self {
        Self { own: [[0.0; MOST]; NODES], other: [[0.0; MOST]; NODES] }
    }
}

/// Derivatives of the integrals between faces of at most `F` nodes.
#[derive(Clone, Debug)]
pub(super) struct Derivatives<const F: usize> {
    /// Derivatives with respect to the nodes of the slave's face (its middle included) and to those of the master's, along each axis.
    pub by: [[[Products<F>; 3]; F]; 2],
}

impl<const F: usize> Derivatives<F> {
    /// Derivatives of integrals that are constant.
    pub(super) fn zero() -> Self {
        Self { by: [[[Products::ZERO; 3]; F]; 2] }
    }
}

/// Integrates the overlap of a slave facet with a master facet of faces of at most `F` nodes; `None` if they do not overlap.
pub(super) fn integrals<const F: usize>(facets: &Facets<'_>) -> Option<Integrals> {
    let pair = Pair::new(facets)?;
    Some(Arch::new().dispatch(Values::<F> { pair: &pair, rule: facets.rule }))
}

/// Computes the derivatives of these integrals with respect to the nodes of both faces; others are not written. Returns false if
/// the facets do not overlap.
pub(super) fn derivatives<const F: usize>(facets: &Facets<'_>, out: &mut Derivatives<F>) -> bool {
    let Some(pair) = Pair::new(facets) else { return false };
    Arch::new().dispatch(Differentiation::<F> { pair: &pair, rule: facets.rule, out });
    true
}

/// Evaluation of the integrals, compiled for each set of instructions. Without fused operations all give the same bits.
struct Values<'a, const F: usize> {
    pair: &'a Pair<'a>,
    rule: &'a Rule,
}

impl<const F: usize> WithSimd for Values<'_, F> {
    type Output = Integrals;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Integrals {
        self.pair.integrals::<F>(self.rule)
    }
}

/// Differentiation of the integrals, as [`Values`].
struct Differentiation<'a, const F: usize> {
    pair: &'a Pair<'a>,
    rule: &'a Rule,
    out: &'a mut Derivatives<F>,
}

impl<const F: usize> WithSimd for Differentiation<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.pair.derivatives::<F>(self.rule, self.out);
    }
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
    /// Natural coordinates and base vectors of the slave's face in the plane.
    xi: [f64; 2],
    base: [[f64; 2]; 2],
    inverse: [[f64; 2]; 2],
    other_inverse: [[f64; 2]; 2],
    density: f64,
    density_slopes: [f64; 2],
    plane: f64,
}

/// Points of a triangle that are evaluated together.
struct Group<const F: usize> {
    /// Barycentric coordinates.
    shares: [[f64; 3]; GROUP],
    points: [Point<F>; GROUP],
    products: [PointProducts<F>; GROUP],
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
    #[inline(always)]
    fn faces(&self, linear: bool) -> Faces<'_> {
        let [s, m] = self.sides.map(|side| side.facet.face.nodes.len());
        let own = PlaneFace::new(self.sides[0].facet, &self.flat[..s], linear);
        let other = PlaneFace::new(self.sides[1].facet, &self.flat[MOST..MOST + m], linear);
        let density = Density::new(&own, self.reference);
        Faces { own, other, density }
    }

    #[inline(always)]
    fn integrals<const F: usize>(&self, rule: &Rule) -> Integrals {
        let mut sums = Products::<F>::ZERO;
        let faces = self.faces(F == NODES);
        for triangle in self.triangles(rule) {
            faces.triangle(&triangle, rule, &mut sums);
        }
        let mut out = Integrals::zero();
        for b in 0..NODES {
            out.own[b][..F].copy_from_slice(&sums.own[b]);
            out.other[b][..F].copy_from_slice(&sums.other[b]);
        }
        out
    }

    #[inline(always)]
    fn derivatives<const F: usize>(&self, rule: &Rule, out: &mut Derivatives<F>) {
        let zero = [Products::<F>::ZERO; 2];
        let mut slopes = Slopes {
            corners: [zero; CENTROID + 1],
            own: [zero; F],
            other: [zero; F],
            moments: [Products::ZERO; 3],
        };
        let faces = self.faces(F == NODES);
        let nodes = self.sides.map(|side| side.facet.face.nodes.len());
        for triangle in self.triangles(rule) {
            faces.sloped_triangle(&triangle, rule, nodes, &mut slopes);
        }
        if F == NODES {
            faces.add_area_slopes(&mut slopes);
        }
        if rule.centred {
            self.hand_on_centroid(&mut slopes.corners);
        }
        self.hand_on(&mut slopes);
        self.spread(&slopes, out);
    }

    /// Triangles of the overlap that are not negligible, in a fan about the centroid or else about the first corner.
    #[inline(always)]
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
    #[inline(always)]
    fn hand_on_centroid<const F: usize>(&self, corners: &mut [[Products<F>; 2]; CENTROID + 1]) {
        let (corners, centroid) = corners.split_at_mut(CENTROID);
        for (to, slope) in corners.iter_mut().zip(self.polygon.centroid_slopes()) {
            for (m, to) in to.iter_mut().enumerate() {
                for i in 0..2 {
                    to.add(slope[i][m], &centroid[0][i]);
                }
            }
        }
    }

    /// Passes the slopes with respect to corners on to the nodes on which they depend.
    #[inline(always)]
    fn hand_on<const F: usize>(&self, slopes: &mut Slopes<F>) {
        let Slopes { corners, own, other, .. } = slopes;
        for (corner, by) in self.polygon.at[..self.polygon.corners].iter().zip(corners.iter()) {
            match &corner.of {
                Crossing::None(v) => {
                    let node = if *v < MOST { &mut own[*v] } else { &mut other[v - MOST] };
                    node[0].add(1.0, &by[0]);
                    node[1].add(1.0, &by[1]);
                }
                Crossing::Of(lines) => {
                    for (v, c) in corner.slopes(lines, &self.flat) {
                        let node = if v < MOST { &mut own[v] } else { &mut other[v - MOST] };
                        for m in 0..2 {
                            node[m].add(c[0][m], &by[0]);
                            node[m].add(c[1][m], &by[1]);
                        }
                    }
                }
            }
        }
    }

    /// Converts motions in the plane to motions in space.
    #[inline(always)]
    fn spread<const F: usize>(&self, slopes: &Slopes<F>, out: &mut Derivatives<F>) {
        let origin = self.sides[0].corner(0);
        let mut tilted = [Products::<F>::ZERO; 2];
        for ((to, nodes), side) in out.by.iter_mut().zip([&slopes.own, &slopes.other]).zip(&self.sides) {
            for ((to, by), x) in to.iter_mut().zip(nodes).zip(side.x) {
                let height = dot(&self.normal, &sub(x, origin));
                for (m, by) in by.iter().enumerate() {
                    tilted[m].add(height, by);
                }
                for (l, to) in to.iter_mut().enumerate() {
                    *to = Products::ZERO;
                    to.add(self.base[0][l], &by[0]);
                    to.add(self.base[1][l], &by[1]);
                }
            }
        }
        for (&corner, tilts) in self.sides[0].facet.corners.iter().zip(&self.tilts()) {
            for (tilted, tilt) in tilted.iter().zip(tilts) {
                for (to, tilt) in out.by[0][corner].iter_mut().zip(tilt) {
                    to.add(-tilt, tilted);
                }
            }
        }
    }

    /// Derivatives of `b_m·δn` with respect to the positions of the slave's corners.
    #[inline(always)]
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
    #[inline(always)]
    fn point<const F: usize>(&self, y: &[f64; 2]) -> Point<F> {
        let (own, other) = (self.own.locate::<F>(y), self.other.locate::<F>(y));
        let corners = self.own.corners(&own);
        let (density, density_slopes, plane) = self.density.at(&self.own, &own);
        Point {
            corners,
            own: own.functions,
            other: other.functions,
            xi: own.xi,
            base: own.base,
            inverse: own.inverse,
            other_inverse: other.inverse,
            density,
            density_slopes,
            plane,
        }
    }

    /// Adds the slopes of the integrals with the area element, which are linear in natural coordinates.
    #[inline(always)]
    fn add_area_slopes<const F: usize>(&self, slopes: &mut Slopes<F>) {
        let Some([here, right, up]) = self.own.area_slopes() else { return };
        for (n, to) in slopes.own.iter_mut().enumerate().take(NODES) {
            for (m, to) in to.iter_mut().enumerate() {
                let by = [here[n][m], right[n][m] - here[n][m], up[n][m] - here[n][m]];
                for (moment, c) in slopes.moments.iter().zip(by) {
                    to.add(-c, moment);
                }
            }
        }
    }

    #[inline(always)]
    fn triangle<const F: usize>(&self, t: &Triangle, rule: &Rule, sums: &mut Products<F>) {
        for (share, weight) in &rule.triangle {
            let g = self.point::<F>(&mean(&t.at, share));
            let w = t.double * weight * g.density;
            for b in 0..NODES {
                let wb = w * g.corners.0[b];
                for k in 0..F {
                    sums.own[b][k] += wb * g.own.0[k];
                    sums.other[b][k] += wb * g.other.0[k];
                }
            }
        }
    }

    /// Evaluates a group of points, filled with points without weight.
    #[inline(always)]
    fn group<const F: usize>(&self, t: &Triangle, points: &[([f64; 3], f64)]) -> Group<F> {
        let at = |i: usize| points.get(i).copied().unwrap_or((points[0].0, 0.0));
        let [(p, of_p), (q, of_q), (r, of_r)] = [at(0), at(1), at(2)];
        let points: [Point<F>; GROUP] =
            [self.point(&mean(&t.at, &p)), self.point(&mean(&t.at, &q)), self.point(&mean(&t.at, &r))];
        let products = [
            products(&points[0], t.double * of_p),
            products(&points[1], t.double * of_q),
            products(&points[2], t.double * of_r),
        ];
        Group { shares: [p, q, r], points, products }
    }

    /// Adds the slopes of the integrals over a triangle, for faces of these numbers of nodes.
    #[inline(always)]
    fn sloped_triangle<const F: usize>(
        &self,
        t: &Triangle,
        rule: &Rule,
        nodes: [usize; 2],
        slopes: &mut Slopes<F>,
    ) {
        let mut sums = Products::ZERO;
        for points in rule.triangle.chunks(GROUP) {
            let group = self.group::<F>(t, points);
            sums.add_group([1.0; GROUP], group.values());
            group.add_slopes(t, nodes, slopes);
            if F == NODES {
                group.add_moments(&mut slopes.moments);
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

impl<const F: usize> Group<F> {
    #[inline(always)]
    fn values(&self) -> [&Products<F>; GROUP] {
        let [p, q, r] = &self.products;
        [&p.values, &q.values, &r.values]
    }

    /// Adds the slopes with respect to the corners of the triangle and to the nodes of both faces.
    #[inline(always)]
    fn add_slopes(&self, t: &Triangle, [own, other]: [usize; 2], slopes: &mut Slopes<F>) {
        let [p, q, r] = &self.points;
        let [at_p, at_q, at_r] = &self.products;
        for m in 0..2 {
            let by_own = [&at_p.by_own[m], &at_q.by_own[m], &at_r.by_own[m]];
            let by_other = [&at_p.by_other[m], &at_q.by_other[m], &at_r.by_other[m]];
            for (i, c) in t.corners.iter().enumerate() {
                let to = &mut slopes.corners[*c][m];
                let shares = [self.shares[0][i], self.shares[1][i], self.shares[2][i]];
                to.add_group(shares, by_own);
                add_group(&mut to.other, shares, by_other);
            }
            for (n, to) in slopes.own.iter_mut().enumerate().take(own) {
                to[m].add_group([-p.own.0[n], -q.own.0[n], -r.own.0[n]], by_own);
                if F > NODES {
                    let turned = |g: &Point<F>| -area_slopes(&g.own.1, &g.base, n)[m] / g.plane;
                    to[m].add_group([turned(p), turned(q), turned(r)], self.values());
                }
            }
            for (n, to) in slopes.other.iter_mut().enumerate().take(other) {
                add_group(&mut to[m].other, [-p.other.0[n], -q.other.0[n], -r.other.0[n]], by_other);
            }
        }
    }

    /// Adds the integrals over the area in the plane, of themselves and times both natural coordinates.
    #[inline(always)]
    fn add_moments(&self, moments: &mut [Products<F>; 3]) {
        let [p, q, r] = &self.points;
        let shares = [p.plane.recip(), q.plane.recip(), r.plane.recip()];
        moments[0].add_group(shares, self.values());
        for (m, to) in moments[1..].iter_mut().enumerate() {
            to.add_group([shares[0] * p.xi[m], shares[1] * q.xi[m], shares[2] * r.xi[m]], self.values());
        }
    }
}

#[inline(always)]
fn mean(corners: &[[f64; 2]; 3], share: &[f64; 3]) -> [f64; 2] {
    std::array::from_fn(|i| share[0] * corners[0][i] + share[1] * corners[1][i] + share[2] * corners[2][i])
}

/// Products at a Gauss point, times its weight.
struct PointProducts<const F: usize> {
    values: Products<F>,
    /// Slopes with respect to the position of the point, through the natural coordinates of the slave.
    by_own: [Products<F>; 2],
    /// Slopes of the products with functions of the master, through its natural coordinates.
    by_other: [[[f64; F]; NODES]; 2],
}

/// Products of all pairs of functions at a Gauss point.
#[inline(always)]
fn products<const F: usize>(g: &Point<F>, w: f64) -> PointProducts<F> {
    let mut out = PointProducts {
        values: Products::ZERO,
        by_own: [Products::ZERO; 2],
        by_other: [[[0.0; F]; NODES]; 2],
    };
    let wd = w * g.density;
    let (weights, own, other) = (&g.corners.0, &g.own.0, &g.other.0);
    for i in 0..2 {
        let dense = w * (g.density_slopes[0] * g.inverse[0][i] + g.density_slopes[1] * g.inverse[1][i]);
        let weights_by: [f64; NODES] = along(&g.corners.1, &g.inverse, i, wd);
        let own_by: [f64; F] = along(&g.own.1, &g.inverse, i, wd);
        let other_by: [f64; F] = along(&g.other.1, &g.other_inverse, i, wd);
        for b in 0..NODES {
            let first = dense * weights[b] + weights_by[b];
            for k in 0..F {
                out.by_own[i].own[b][k] = first * own[k] + weights[b] * own_by[k];
                out.by_own[i].other[b][k] = first * other[k];
                out.by_other[i][b][k] = weights[b] * other_by[k];
            }
        }
    }
    for (weight, (to_own, to_other)) in
        weights.iter().zip(out.values.own.iter_mut().zip(&mut out.values.other))
    {
        let w = wd * weight;
        for ((to, to_other), (own, other)) in to_own.iter_mut().zip(to_other).zip(own.iter().zip(other)) {
            (*to, *to_other) = (w * own, w * other);
        }
    }
    out
}

/// Slopes of functions along axis `i` of the plane, times `c`.
#[inline(always)]
fn along<const F: usize>(slopes: &[[f64; F]; 2], inverse: &[[f64; 2]; 2], i: usize, c: f64) -> [f64; F] {
    std::array::from_fn(|k| c * (slopes[0][k] * inverse[0][i] + slopes[1][k] * inverse[1][i]))
}

#[cfg(test)]
mod tests;
