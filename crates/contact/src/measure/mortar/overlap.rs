//! Overlap of two first-order facets in space, with the derivatives of its integrals with respect to the positions of all
//! nodes.
//!
//! The integrals are those of `cell`, for the facet kinds supported by finite sliding. There are 26 integrals to differentiate,
//! of products of shape functions in the plane of the slave. A corner of the common polygon is a node of either facet or the
//! intersection of two edges; a Gauss point is a mean of three corners. Each Gauss point thus contributes to few numbers. These
//! are the slopes with respect to the corners of its triangle and, for motion of the facets at a fixed position, with respect
//! to the nodes of both facets. The slopes of corners are then passed on to nodes. A rigid motion in the plane changes no
//! integral, so of the motion of the plane itself only its tilt remains.
//!
//! With y = X(xi) and X bilinear: `δxi = X'^-1 (δy - Σ N_k δx_k)`. Points of the plane are `b_m·(x - o)`. A tilt δn moves them
//! by `-h (b_m·δn)`, with h the height above the plane.

use super::clip::twice_area;
use super::polygon::{Corner, Crossing, Polygon};
use super::rule::Rule;
use crate::SegmentKind;
use crate::vector::{axpy, cross, dot, norm, scaled, sub, unit};

/// Most nodes of a first-order facet.
pub(super) const NODES: usize = 4;

/// Number of slots for the nodes of both facets, the slave's first.
pub(super) const BOTH: usize = 2 * NODES;

/// Number of products of two slave functions b and k, with `b <= k`.
const OWN: usize = NODES * (NODES + 1) / 2;

/// Number of all products.
const ALL: usize = OWN + NODES * NODES;

/// Most Newton iterations for natural coordinates, as in `cell`.
const ITERATIONS: usize = 30;
/// Step in natural coordinates below which the iteration has converged, as in `cell`.
const CONVERGED: f64 = 1e-15;

/// Pieces smaller than this share of the slave facet result from rounding of coinciding edges.
const SLIVER: f64 = 1e-15;

/// A facet in the plane: `X = a + b ξ + c η + d ξ η`.
#[derive(Clone, Copy, Debug)]
struct Bilinear<const L: usize> {
    a: [f64; L],
    b: [f64; L],
    c: [f64; L],
    d: [f64; L],
}

impl<const L: usize> Bilinear<L> {
    fn new(kind: SegmentKind, x: &[[f64; L]]) -> Self {
        if kind == SegmentKind::Tri3 {
            return Self { a: x[0], b: sub(&x[1], &x[0]), c: sub(&x[2], &x[0]), d: [0.0; L] };
        }
        let mix = |s: [f64; 4]| -> [f64; L] {
            std::array::from_fn(|i| {
                0.25 * (s[0] * x[0][i] + s[1] * x[1][i] + s[2] * x[2][i] + s[3] * x[3][i])
            })
        };
        Self {
            a: mix([1.0; 4]),
            b: mix([-1.0, 1.0, 1.0, -1.0]),
            c: mix([-1.0, -1.0, 1.0, 1.0]),
            d: mix([1.0, -1.0, 1.0, -1.0]),
        }
    }
}

impl Bilinear<2> {
    /// Inverse X'^-1 at ξ.
    #[inline]
    fn inverse(&self, xi: &[f64; 2]) -> [[f64; 2]; 2] {
        let e = [self.b[0] + self.d[0] * xi[1], self.b[1] + self.d[1] * xi[1]];
        let f = [self.c[0] + self.d[0] * xi[0], self.c[1] + self.d[1] * xi[0]];
        let share = (e[0] * f[1] - e[1] * f[0]).recip();
        [[f[1] * share, -f[0] * share], [-e[1] * share, e[0] * share]]
    }

    /// Natural coordinates of a position in the plane by Newton's method, with X'^-1 there.
    #[inline]
    fn locate(&self, y: &[f64; 2], start: [f64; 2]) -> ([f64; 2], [[f64; 2]; 2]) {
        let mut xi = start;
        for _ in 0..ITERATIONS {
            let inverse = self.inverse(&xi);
            let off: [f64; 2] = std::array::from_fn(|i| {
                y[i] - self.a[i] - self.b[i] * xi[0] - (self.c[i] + self.d[i] * xi[0]) * xi[1]
            });
            let step = [dot(&inverse[0], &off), dot(&inverse[1], &off)];
            xi = [xi[0] + step[0], xi[1] + step[1]];
            if step[0].abs().max(step[1].abs()) <= CONVERGED * (1.0 + xi[0].abs().max(xi[1].abs())) {
                return (xi, inverse);
            }
        }
        (xi, self.inverse(&xi))
    }
}

/// Shape functions with first derivatives.
#[inline]
fn functions(kind: SegmentKind, xi: &[f64; 2]) -> ([f64; NODES], [[f64; NODES]; 2]) {
    let [x, y] = *xi;
    if kind == SegmentKind::Tri3 {
        return ([1.0 - x - y, x, y, 0.0], [[-1.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 1.0, 0.0]]);
    }
    let (l, r, b, t) = (0.5 * (1.0 - x), 0.5 * (1.0 + x), 0.5 * (1.0 - y), 0.5 * (1.0 + y));
    (
        [l * b, r * b, r * t, l * t],
        [[-0.5 * b, 0.5 * b, 0.5 * t, -0.5 * t], [-0.5 * l, -0.5 * r, 0.5 * r, 0.5 * l]],
    )
}

/// Ratio of the reference area to the area in the plane.
struct Density {
    /// Product e_1 × e_2 in the reference configuration: constant part, slopes in ξ and η.
    reference: [[f64; 3]; 3],
    /// Same product in the plane.
    plane: [f64; 3],
}

impl Density {
    fn new(reference: &Bilinear<3>, plane: &Bilinear<2>) -> Self {
        let flat = |a: &[f64; 2], b: &[f64; 2]| a[0] * b[1] - a[1] * b[0];
        let (r, p) = (reference, plane);
        Self {
            reference: [cross(&r.b, &r.c), cross(&r.b, &r.d), cross(&r.d, &r.c)],
            plane: [flat(&p.b, &p.c), flat(&p.b, &p.d), flat(&p.d, &p.c)],
        }
    }

    /// Density, its slopes, and the Jacobian of the plane.
    #[inline]
    fn at(&self, xi: &[f64; 2]) -> (f64, [f64; 2], f64) {
        let v: [f64; 3] = std::array::from_fn(|i| {
            self.reference[0][i] + self.reference[1][i] * xi[0] + self.reference[2][i] * xi[1]
        });
        let (r, p) = (norm(&v), self.plane[0] + self.plane[1] * xi[0] + self.plane[2] * xi[1]);
        let density = r / p;
        let slope = |m: usize| (dot(&v, &self.reference[m]) / r - density * self.plane[m]) / p;
        (density, [slope(1), slope(2)], p)
    }
}

/// Kind and positions of a facet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<'a> {
    pub kind: SegmentKind,
    /// Present positions of the nodes.
    pub x: &'a [[f64; 3]],
}

impl Side<'_> {
    fn centre(&self) -> [f64; 2] {
        if self.kind == SegmentKind::Tri3 { [1.0 / 3.0; 2] } else { [0.0; 2] }
    }
}

/// A pair of facets in the plane of the slave.
struct Pair<'a> {
    sides: [Side<'a>; 2],
    /// Nodes of both facets in the plane.
    flat: [[f64; 2]; BOTH],
    bilinear: [Bilinear<2>; 2],
    density: Density,
    base: [[f64; 3]; 2],
    normal: [f64; 3],
    /// Length of the vector product that gives the normal.
    length: f64,
    polygon: Polygon,
    /// Twice the area below which a triangle is negligible.
    least: f64,
}

/// Index of the centroid among the corners, as the apex of a fan.
const CENTROID: usize = Polygon::MOST;

/// Slopes of the integrals in the plane with respect to corners of the polygon and to nodes, along both axes.
struct Slopes {
    /// Slopes with respect to corners. The last is the centroid, used if it is the apex of the fan.
    corners: [[[f64; ALL]; 2]; CENTROID + 1],
    nodes: [[[f64; ALL]; 2]; BOTH],
}

/// The facets of a cell and their quadrature rule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facets<'a> {
    pub slave: Side<'a>,
    /// Reference positions of the slave's nodes.
    pub reference: &'a [[f64; 3]],
    pub master: Side<'a>,
    pub rule: &'a Rule,
}

/// Integrals over the overlap for functions b of the slave: ∫ N_b N_k for slave nodes, followed by ∫ N_b N_γ for master nodes.
pub(super) type Integrals = [[f64; BOTH]; NODES];

/// Derivatives of the integrals with respect to node (the slave's first) and axis.
pub(super) type Derivatives = [[[[f64; 3]; BOTH]; BOTH]; NODES];

/// Index of a product among all: of slave nodes b and k, or of slave node b with master node k - [`NODES`].
#[inline]
fn place(b: usize, k: usize) -> usize {
    if k >= NODES {
        return OWN + b * NODES + k - NODES;
    }
    let (low, high) = (b.min(k), b.max(k));
    low * (2 * NODES + 1 - low) / 2 + high - low
}

/// Integrates the overlap of a slave facet with a master facet; `None` if they do not overlap.
pub(super) fn integrals(facets: &Facets<'_>) -> Option<Integrals> {
    let pair = Pair::new(facets)?;
    let mut sums = [0.0; ALL];
    for triangle in pair.triangles(facets.rule) {
        pair.triangle(&triangle, facets.rule, &mut sums);
    }
    Some(std::array::from_fn(|b| std::array::from_fn(|k| sums[place(b, k)])))
}

/// Computes the derivatives of these integrals. Returns false if the facets do not overlap.
pub(super) fn derivatives(facets: &Facets<'_>, out: &mut Derivatives) -> bool {
    let Some(pair) = Pair::new(facets) else { return false };
    let mut slopes = Slopes { corners: [[[0.0; ALL]; 2]; CENTROID + 1], nodes: [[[0.0; ALL]; 2]; BOTH] };
    for triangle in pair.triangles(facets.rule) {
        pair.sloped_triangle(&triangle, facets.rule, &mut slopes);
    }
    if facets.rule.centred {
        pair.hand_on_centroid(&mut slopes.corners);
    }
    pair.hand_on(&mut slopes);
    pair.spread(&slopes, out);
    true
}

/// A triangle of the fan: its corners, their positions, and twice its area.
struct Triangle {
    corners: [usize; 3],
    at: [[f64; 2]; 3],
    double: f64,
}

/// Values at a Gauss point.
struct Point {
    own: [f64; NODES],
    own_slopes: [[f64; NODES]; 2],
    inverse: [[f64; 2]; 2],
    other: [f64; NODES],
    other_slopes: [[f64; NODES]; 2],
    other_inverse: [[f64; 2]; 2],
    xi: [f64; 2],
    density: f64,
    density_slopes: [f64; 2],
    plane: f64,
}

/// Product of two sides of a triangle, or of the diagonals of a quadrilateral.
fn normal_product(kind: SegmentKind, x: &[[f64; 3]]) -> [f64; 3] {
    if kind == SegmentKind::Tri3 {
        cross(&sub(&x[1], &x[0]), &sub(&x[2], &x[0]))
    } else {
        cross(&sub(&x[2], &x[0]), &sub(&x[3], &x[1]))
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
        let x = slave.x;
        let product = normal_product(slave.kind, x);
        let length = norm(&product);
        let normal = scaled(&product, length.recip());
        let base = plane_base(&sub(&x[1], &x[0]), &normal);
        let mut flat = [[0.0; 2]; BOTH];
        let put = |to: &mut [[f64; 2]], from: &[[f64; 3]]| {
            for (f, p) in to.iter_mut().zip(from) {
                *f = coordinates(&sub(p, &x[0]), &base);
            }
        };
        put(&mut flat[..NODES], x);
        put(&mut flat[NODES..], master.x);
        let (s, m) = (x.len(), master.x.len());
        let own = Polygon::from_nodes((0..s).map(|k| (flat[k], k)));
        // The master runs in the opposite direction.
        let other = Polygon::from_nodes((0..m).rev().map(|k| (flat[NODES + k], NODES + k)));
        if other.twice_area() <= 0.0 || own.apart(&other) {
            return None;
        }
        let least = SLIVER * own.twice_area();
        let polygon = own.clipped(&other, &flat);
        let corner = |k: usize| &polygon.at[k].at;
        if !(2..polygon.corners).any(|k| twice_area(corner(0), corner(k - 1), corner(k)) > least) {
            return None;
        }
        let bilinear =
            [Bilinear::new(slave.kind, &flat[..s]), Bilinear::new(master.kind, &flat[NODES..NODES + m])];
        let density = Density::new(&Bilinear::new(slave.kind, reference), &bilinear[0]);
        Some(Self { sides: [slave, master], flat, bilinear, density, base, normal, length, polygon, least })
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

    /// Evaluates the pair at a position in the plane.
    #[inline]
    fn point(&self, y: &[f64; 2]) -> Point {
        let (xi, inverse) = self.bilinear[0].locate(y, self.sides[0].centre());
        let (eta, other_inverse) = self.bilinear[1].locate(y, self.sides[1].centre());
        let (own, own_slopes) = functions(self.sides[0].kind, &xi);
        let (other, other_slopes) = functions(self.sides[1].kind, &eta);
        let (density, density_slopes, plane) = self.density.at(&xi);
        Point {
            own,
            own_slopes,
            inverse,
            other,
            other_slopes,
            other_inverse,
            xi,
            density,
            density_slopes,
            plane,
        }
    }

    fn triangle(&self, t: &Triangle, rule: &Rule, sums: &mut [f64; ALL]) {
        for (share, weight) in &rule.triangle {
            let g = self.point(&mean(&t.at, share));
            let w = t.double * weight * g.density;
            for b in 0..NODES {
                let wb = w * g.own[b];
                (b..NODES).for_each(|k| sums[place(b, k)] += wb * g.own[k]);
                (0..NODES).for_each(|k| sums[place(b, NODES + k)] += wb * g.other[k]);
            }
        }
    }

    /// Adds the slopes of the integrals over a triangle.
    fn sloped_triangle(&self, t: &Triangle, rule: &Rule, slopes: &mut Slopes) {
        let mut sums = [0.0; ALL];
        for (share, weight) in &rule.triangle {
            let g = self.point(&mean(&t.at, share));
            let w = t.double * weight;
            let (values, by_own, by_other) = products(&g, w);
            add_scaled(&mut sums, 1.0, &values);
            for m in 0..2 {
                for (c, s) in t.corners.iter().zip(share) {
                    let to = &mut slopes.corners[*c][m];
                    add_scaled(to, *s, &by_own[m]);
                    add_other(to, *s, &by_other[m]);
                }
            }
            let turned = self.plane_slopes(&g);
            let (own, other) = slopes.nodes.split_at_mut(NODES);
            for (n, (own, other)) in own.iter_mut().zip(other).enumerate() {
                for m in 0..2 {
                    add_scaled(&mut own[m], -g.own[n], &by_own[m]);
                    add_scaled(&mut own[m], -turned[n][m] / g.plane, &values);
                    add_other(&mut other[m], -g.other[n], &by_other[m]);
                }
            }
        }
        // The area of the triangle scales the whole contribution.
        for (i, c) in t.corners.iter().enumerate() {
            let (p, q) = (&t.at[(i + 1) % 3], &t.at[(i + 2) % 3]);
            add_scaled(&mut slopes.corners[*c][0], (p[1] - q[1]) / t.double, &sums);
            add_scaled(&mut slopes.corners[*c][1], (q[0] - p[0]) / t.double, &sums);
        }
    }

    /// Passes the slopes with respect to the centroid on to the corners.
    fn hand_on_centroid(&self, corners: &mut [[[f64; ALL]; 2]; CENTROID + 1]) {
        let (corners, centroid) = corners.split_at_mut(CENTROID);
        for (to, slope) in corners.iter_mut().zip(self.polygon.centroid_slopes()) {
            for (m, to) in to.iter_mut().enumerate() {
                (0..2).for_each(|i| add_scaled(to, slope[i][m], &centroid[0][i]));
            }
        }
    }

    /// Change of the area element at a Gauss point with the slave nodes in the plane.
    #[inline]
    fn plane_slopes(&self, g: &Point) -> [[f64; 2]; NODES] {
        let p = &self.bilinear[0];
        let e: [f64; 2] = std::array::from_fn(|i| p.b[i] + p.d[i] * g.xi[1]);
        let f: [f64; 2] = std::array::from_fn(|i| p.c[i] + p.d[i] * g.xi[0]);
        let [s, t] = &g.own_slopes;
        std::array::from_fn(|k| [s[k] * f[1] - t[k] * e[1], t[k] * e[0] - s[k] * f[0]])
    }

    /// Passes the slopes with respect to corners on to the nodes on which they depend.
    fn hand_on(&self, slopes: &mut Slopes) {
        let Slopes { corners, nodes } = slopes;
        for (corner, by) in self.polygon.at[..self.polygon.corners].iter().zip(corners.iter()) {
            match corner {
                Corner { of: Crossing::None(v), .. } => {
                    (0..2).for_each(|m| add_scaled(&mut nodes[*v][m], 1.0, &by[m]));
                }
                Corner { of: Crossing::Of(lines), .. } => {
                    for (v, c) in corner.slopes(lines, &self.flat) {
                        for (m, to) in nodes[v].iter_mut().enumerate() {
                            add_scaled(to, c[0][m], &by[0]);
                            add_scaled(to, c[1][m], &by[1]);
                        }
                    }
                }
            }
        }
    }

    /// Converts motions in the plane to motions in space.
    fn spread(&self, slopes: &Slopes, out: &mut Derivatives) {
        let origin = self.sides[0].x[0];
        let mut height = [0.0; BOTH];
        for (side, h) in self.sides.iter().zip(height.chunks_exact_mut(NODES)) {
            h.iter_mut().zip(side.x).for_each(|(h, x)| *h = dot(&self.normal, &sub(x, &origin)));
        }
        let tilts = self.tilts();
        for (b, row) in out.iter_mut().enumerate() {
            for (k, weight) in row.iter_mut().enumerate() {
                let f = place(b, k);
                let mut tilted = [0.0; 2];
                for (h, by) in height.iter().zip(&slopes.nodes) {
                    (0..2).for_each(|m| tilted[m] += h * by[m][f]);
                }
                for (n, (to, by)) in weight.iter_mut().zip(&slopes.nodes).enumerate() {
                    *to = scaled(&self.base[0], by[0][f]);
                    axpy(to, by[1][f], &self.base[1]);
                    if let Some(tilt) = tilts.get(n) {
                        axpy(to, -tilted[0], &tilt[0]);
                        axpy(to, -tilted[1], &tilt[1]);
                    }
                }
            }
        }
    }

    /// Derivatives of `b_m·δn` with respect to the positions of the slave nodes.
    fn tilts(&self) -> [[[f64; 3]; 2]; NODES] {
        let x = self.sides[0].x;
        let share = self.length.recip();
        let mut out = [[[0.0; 3]; 2]; NODES];
        let triangle = self.sides[0].kind == SegmentKind::Tri3;
        let (p, q) = if triangle {
            (sub(&x[1], &x[0]), sub(&x[2], &x[0]))
        } else {
            (sub(&x[2], &x[0]), sub(&x[3], &x[1]))
        };
        for (m, b) in self.base.iter().enumerate() {
            // Product b·(δp × q + p × δq).
            let (dp, dq) = (scaled(&cross(&q, b), share), scaled(&cross(b, &p), share));
            if triangle {
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

#[inline]
fn mean(corners: &[[f64; 2]; 3], share: &[f64; 3]) -> [f64; 2] {
    std::array::from_fn(|i| share[0] * corners[0][i] + share[1] * corners[1][i] + share[2] * corners[2][i])
}

/// All products at a Gauss point, times its weight, and their slopes with respect to its position: through the natural
/// coordinates of the slave, and through those of the master.
#[inline]
fn products(g: &Point, w: f64) -> ([f64; ALL], [[f64; ALL]; 2], [[f64; OWN_OTHER]; 2]) {
    let (mut values, mut by_own, mut by_other) = ([0.0; ALL], [[0.0; ALL]; 2], [[0.0; OWN_OTHER]; 2]);
    let wd = w * g.density;
    // Slopes of the functions with respect to the position.
    let along = |slopes: &[[f64; NODES]; 2], inverse: &[[f64; 2]; 2], i: usize, k: usize| {
        slopes[0][k] * inverse[0][i] + slopes[1][k] * inverse[1][i]
    };
    for i in 0..2 {
        let dense = w * (g.density_slopes[0] * g.inverse[0][i] + g.density_slopes[1] * g.inverse[1][i]);
        let own: [f64; NODES] = std::array::from_fn(|k| wd * along(&g.own_slopes, &g.inverse, i, k));
        let other: [f64; NODES] =
            std::array::from_fn(|k| wd * along(&g.other_slopes, &g.other_inverse, i, k));
        for b in 0..NODES {
            let first = dense * g.own[b] + own[b];
            for k in b..NODES {
                by_own[i][place(b, k)] = first * g.own[k] + g.own[b] * own[k];
            }
            for k in 0..NODES {
                by_own[i][OWN + b * NODES + k] = first * g.other[k];
                by_other[i][b * NODES + k] = g.own[b] * other[k];
            }
        }
    }
    for b in 0..NODES {
        (b..NODES).for_each(|k| values[place(b, k)] = wd * g.own[b] * g.own[k]);
        (0..NODES).for_each(|k| values[OWN + b * NODES + k] = wd * g.own[b] * g.other[k]);
    }
    (values, by_own, by_other)
}

/// Number of products with functions of the master.
const OWN_OTHER: usize = NODES * NODES;

#[inline]
fn add_scaled(to: &mut [f64; ALL], c: f64, by: &[f64; ALL]) {
    to.iter_mut().zip(by).for_each(|(t, b)| *t += c * b);
}

#[inline]
fn add_other(to: &mut [f64; ALL], c: f64, by: &[f64; OWN_OTHER]) {
    to[OWN..].iter_mut().zip(by).for_each(|(t, b)| *t += c * b);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mortar::cell::{ReferenceFacet, Sums, integrate};
    use crate::measure::mortar::rule::Rules;
    use crate::measure::mortar::scalar::Dual;
    use crate::measure::mortar::weighting::Weighting;
    use proptest::prelude::*;

    type Number = Dual<24>;

    /// A unit facet at height `above` over the plane, perturbed by `noise`, facing down for the slave.
    fn facet(kind: SegmentKind, above: f64, size: f64, noise: &[f64]) -> Vec<[f64; 3]> {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let corners: &[[f64; 2]] = if kind == SegmentKind::Tri3 { &square[..3] } else { &square };
        let mut x: Vec<[f64; 3]> = corners
            .iter()
            .zip(noise.chunks(3))
            .map(|(c, n)| [size * c[0] + n[0], size * c[1] + n[1], above + n[2]])
            .collect();
        if above > 0.0 {
            x.reverse();
        }
        x
    }

    /// The integrals and derivatives of `cell`, by forward differentiation.
    fn forward(
        slave: Side<'_>,
        reference: &[[f64; 3]],
        master: Side<'_>,
        rule: &Rule,
    ) -> Option<Sums<Number, 4>> {
        let weighting = Weighting::new(slave.kind, Some);
        let frozen =
            ReferenceFacet { kind: slave.kind, weighting: &weighting, reference, axisymmetric: false };
        let seeded = |x: &[[f64; 3]], first: usize| -> Vec<[Number; 3]> {
            let number = |k: usize, i: usize| {
                let mut d = [0.0; 24];
                d[3 * (first + k) + i] = 1.0;
                Dual { v: x[k][i], d }
            };
            (0..x.len()).map(|k| std::array::from_fn(|i| number(k, i))).collect()
        };
        let mut sums = Sums::zero();
        let (x, y) = (seeded(slave.x, 0), seeded(master.x, 4));
        integrate(frozen, &x, master.kind, &y, rule, &mut sums).then_some(sums)
    }

    fn kind() -> impl Strategy<Value = SegmentKind> {
        prop_oneof![Just(SegmentKind::Tri3), Just(SegmentKind::Quad4)]
    }

    fn noise(by: f64) -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(-by..by, 12)
    }

    proptest! {
        #[test]
        fn integrals_do_not_depend_on_the_corner_that_comes_first(
            noises in (noise(0.2), noise(0.5)),
            by in 1..4_usize,
        ) {
            let (own, other) = (facet(SegmentKind::Quad4, 0.2, 1.0, &noises.0), facet(SegmentKind::Quad4, 0.0, 1.2, &noises.1));
            let turned = |x: &[[f64; 3]]| -> Vec<[f64; 3]> { (0..4).map(|k| x[(k + by) % 4]).collect() };
            let rules = Rules::new();
            let of = |own: &[[f64; 3]], other: &[[f64; 3]]| {
                let side = |x| Side { kind: SegmentKind::Quad4, x };
                integrals(&Facets { slave: side(own), reference: own, master: side(other), rule: rules.rule(3) })
            };
            let (first, second) = (of(&own, &other), of(&turned(&own), &turned(&other)));
            prop_assert_eq!(first.is_some(), second.is_some());
            let (Some(first), Some(second)) = (first, second) else { return Ok(()) };
            for b in 0..4 {
                for k in 0..4 {
                    for part in [0, NODES] {
                        let (a, c) = (first[(b + by) % 4][part + (k + by) % 4], second[b][part + k]);
                        prop_assert!((a - c).abs() < 1e-12, "{} {} {}: {} {}", b, k, part, a, c);
                    }
                }
            }
        }

        #[test]
        fn integrals_and_derivatives_are_those_of_numbers_that_carry_derivatives(
            kinds in (kind(), kind()),
            noises in (noise(0.2), noise(0.5), noise(0.1)),
            points in 1..5_usize,
        ) {
            let own = facet(kinds.0, 0.2, 1.0, &noises.0);
            let other = facet(kinds.1, 0.0, 1.2, &noises.1);
            let reference: Vec<[f64; 3]> =
                own.iter().zip(noises.2.chunks(3)).map(|(x, n)| std::array::from_fn(|i| x[i] + n[i])).collect();
            let rules = Rules::new();
            let rule = rules.rule(points);
            let (slave, master) = (Side { kind: kinds.0, x: &own }, Side { kind: kinds.1, x: &other });
            let expected = forward(slave, &reference, master, rule);
            let facets = Facets { slave, reference: &reference, master, rule };
            let found = integrals(&facets);
            let mut slopes = [[[[0.0; 3]; BOTH]; BOTH]; NODES];
            prop_assert_eq!(found.is_some(), expected.is_some());
            prop_assert_eq!(derivatives(&facets, &mut slopes), expected.is_some());
            let (Some(found), Some(expected)) = (found, expected) else { return Ok(()) };
            for b in 0..own.len() {
                let numbers = |k: usize| if k < NODES { expected.own[b][k] } else { expected.other[b][k - NODES] };
                let slots = (0..own.len()).chain(NODES..NODES + other.len());
                let largest = slots.clone().flat_map(|k| numbers(k).d).fold(0.0f64, |m, d| m.max(d.abs()));
                // Natural coordinates of bent facets amplify rounding.
                let bound = 1e-11 * (1.0 + largest);
                for k in slots.clone() {
                    prop_assert!((found[b][k] - numbers(k).v).abs() < bound, "{} {}: {} {}", b, k, found[b][k], numbers(k).v);
                    for j in slots.clone() {
                        for (l, &f) in slopes[b][k][j].iter().enumerate() {
                            let e = numbers(k).d[3 * j + l];
                            prop_assert!((f - e).abs() < bound, "{} {} by {} {}: {} {}", b, k, j, l, f, e);
                        }
                    }
                }
            }
        }
    }
}
