//! Integrals over the overlap of a slave facet with a master facet.
//!
//! Both facets are projected along the slave facet's normal onto its (mean) plane. There they are polygons (in two dimensions
//! intervals), and so is their intersection. At each Gauss point of its triangles the natural coordinates on either facet
//! follow from the position in the plane. The measure is the reference area of the slave, `w J_0/J` (times 2 π r about an
//! axis). Tractions are thus forces per reference area, as they are for bodies and in node-to-point contact.

use super::clip::{Polygon, twice_area};
use super::facet::{Facet, NODES, middle};
use super::plane_face::settled;
use super::rule::Rule;
use super::scalar::Scalar;
use crate::SegmentKind;
use crate::shape::{MOST_NODES, Shape, shape};
use crate::vector::dot;

/// Most Newton iterations for natural coordinates. Facets without re-entrant corners converge in 3 to 6.
const ITERATIONS: usize = 30;

/// Step in natural coordinates below which the iteration has converged: a few units of rounding.
const CONVERGED: f64 = 1e-15;

/// Pieces smaller than this share of the slave facet result from rounding of coinciding edges.
const SLIVER: f64 = 1e-15;

/// Data of a slave facet that do not depend on the configuration.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReferenceFacet<'a, const D: usize> {
    pub facet: &'a Facet,
    /// Reference positions of the nodes of its face.
    pub reference: &'a [[f64; D]],
    pub axisymmetric: bool,
}

/// Integrals over the overlap. Row b belongs to the function λ_b of a corner of the slave facet or, if there are [`MOST_NODES`] rows,
/// to the function of a node of its face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums<T, const N: usize, const R: usize = NODES> {
    /// Integrals ∫ λ_b N_B over nodes of the slave's face.
    pub own: [[T; N]; R],
    /// Integrals ∫ λ_b N_γ over nodes of the master's face.
    pub other: [[T; N]; R],
}

impl<T: Scalar, const N: usize, const R: usize> Sums<T, N, R> {
    pub(super) fn zero() -> Self {
        Self { own: [[T::constant(0.0); N]; R], other: [[T::constant(0.0); N]; R] }
    }
}

/// A pair of facets in the plane of the slave.
struct Pair<'a, T, const D: usize> {
    frozen: ReferenceFacet<'a, D>,
    /// Nodes of the slave's face, and its middle if that is a corner.
    slave: [[T; 2]; MOST_NODES],
    facet: &'a Facet,
    master: [[T; 2]; MOST_NODES],
}

/// Integrates the overlap of a slave facet with a master `facet`. `x` and `y` are the positions of the nodes of their faces, followed
/// by that of the middle of a face of eight nodes. Returns false if there is none. Sums that cannot be computed (a degenerate facet) are NaN.
pub(super) fn integrate<T: Scalar, const D: usize, const N: usize, const R: usize>(
    frozen: ReferenceFacet<'_, D>,
    x: &[[T; D]],
    facet: &Facet,
    y: &[[T; D]],
    rule: &Rule,
    sums: &mut Sums<T, N, R>,
) -> bool {
    let (origin, base) = plane(frozen.facet, x);
    let flat = |p: &[T; D]| -> [T; 2] {
        let d: [T; D] = std::array::from_fn(|i| p[i] - origin[i]);
        std::array::from_fn(|m| inner(&d, &base[m]))
    };
    let nowhere = [[T::constant(0.0); 2]; MOST_NODES];
    let mut pair = Pair { frozen, slave: nowhere, facet, master: nowhere };
    pair.slave.iter_mut().zip(x).for_each(|(s, p)| *s = flat(p));
    pair.master.iter_mut().zip(y).for_each(|(s, p)| *s = flat(p));
    *sums = Sums::zero();
    if D == 2 { pair.interval(&rule.line, sums) } else { pair.polygon(rule, sums) }
}

impl<T: Scalar, const D: usize> Pair<'_, T, D> {
    /// Integrates over the common interval, in two dimensions.
    fn interval<const N: usize, const R: usize>(&self, gauss: &[[f64; 2]], sums: &mut Sums<T, N, R>) -> bool {
        let [(a, b), (d, c)] = [(self.frozen.facet, &self.slave), (self.facet, &self.master)]
            .map(|(facet, x)| (x[facet.corners[0]][0], x[facet.corners[1]][0]));
        // The master runs in the opposite direction.
        let from = if c.value() > a.value() { c } else { a };
        let to = if d.value() < b.value() { d } else { b };
        if to.value() - from.value() <= SLIVER * (b.value() - a.value()) {
            return false;
        }
        for [t, w] in gauss {
            let y = from + (to - from).times(*t);
            self.add([y, T::constant(0.0)], (to - from).times(*w), sums);
        }
        true
    }

    /// Integrates over the common polygon as a fan of triangles, in three dimensions.
    fn polygon<const N: usize, const R: usize>(&self, rule: &Rule, sums: &mut Sums<T, N, R>) -> bool {
        let whole = |part: &Polygon<T>| {
            (2..part.corners)
                .map(|k| twice_area(&part.at[0], &part.at[k - 1], &part.at[k]).value())
                .sum::<f64>()
        };
        let own = outline(self.frozen.facet, &self.slave);
        let mut other = outline(self.facet, &self.master);
        other.reverse();
        if whole(&other) <= 0.0 || apart(&own, &other) {
            return false;
        }
        let least = SLIVER * whole(&own);
        let mut found = false;
        for [a, b, c] in own.clipped(&other).fan(rule.centred) {
            let double = twice_area(&a, &b, &c);
            if double.value() > least {
                found = true;
                self.triangle(&[a, b, c], double, rule, sums);
            }
        }
        found
    }

    /// Adds the Gauss points of a triangle.
    fn triangle<const N: usize, const R: usize>(
        &self,
        [a, b, c]: &[[T; 2]; 3],
        double: T,
        rule: &Rule,
        sums: &mut Sums<T, N, R>,
    ) {
        for ([p, q, r], weight) in &rule.triangle {
            let y = std::array::from_fn(|i| a[i].times(*p) + b[i].times(*q) + c[i].times(*r));
            self.add(y, double.times(*weight), sums);
        }
    }

    /// Adds a Gauss point of the plane with its area.
    fn add<const N: usize, const R: usize>(&self, y: [T; 2], area: T, sums: &mut Sums<T, N, R>) {
        let (slave, master) = (self.frozen.facet, self.facet);
        let (own, other) = (slave.face.nodes.len(), master.face.nodes.len());
        let at = locate::<T, D>(slave, &self.slave[..own], &y);
        let across = locate::<T, D>(master, &self.master[..other], &y);
        let s = shape(slave.face.kind, [at[0].value(), at[1].value()]);
        let m = shape(master.face.kind, [across[0].value(), across[1].value()]);
        let xi = slave.face.facet_coordinates(&at);
        let corners = shape(slave.kind, [xi[0].value(), xi[1].value()]);
        let w = area * self.density(&s, &at);
        let n: [T; N] = std::array::from_fn(|k| value(&s, k, &at));
        let o: [T; N] = std::array::from_fn(|k| value(&m, k, &across));
        let rows = if R == NODES { slave.nodes.len() } else { own };
        for b in 0..rows {
            let psi = w * if R == NODES { value(&corners, b, &xi) } else { n[b] };
            for (sum, nk) in sums.own[b][..own].iter_mut().zip(&n) {
                *sum = *sum + psi * *nk;
            }
            for (sum, ok) in sums.other[b][..other].iter_mut().zip(&o) {
                *sum = *sum + psi * *ok;
            }
        }
    }

    /// Ratio of the reference area of the face to its area in the plane, times 2 π r about an axis.
    fn density(&self, s: &Shape, at: &[T; 2]) -> T {
        let nodes = self.frozen.facet.face.nodes.len();
        let flat = bases(s, at, nodes, |k| self.slave[k]);
        let plane = if D == 2 { flat[0][0] } else { flat[0][0] * flat[1][1] - flat[0][1] * flat[1][0] };
        let reference = &self.frozen.reference;
        let e = bases(s, at, nodes, |k| reference[k].map(T::constant));
        let square = |a: &[T; D]| inner(a, a);
        let squared = if D == 2 {
            square(&e[0])
        } else {
            // |a × b|² = |a|² |b|² - (a·b)²
            let ab = inner(&e[0], &e[1]);
            square(&e[0]) * square(&e[1]) - ab * ab
        };
        let mut density = squared.sqrt() / plane;
        if self.frozen.axisymmetric {
            let mut r = T::constant(0.0);
            for (k, x) in reference.iter().enumerate() {
                r = r + value(s, k, at).times(x[0]);
            }
            density = density * r.times(std::f64::consts::TAU);
        }
        density
    }
}

/// Shape function N_k with derivatives.
#[inline]
fn value<T: Scalar>(s: &Shape, k: usize, xi: &[T; 2]) -> T {
    T::chain(s.value[k], [s.first[0][k], s.first[1][k]], xi)
}

/// Base vectors with derivatives.
#[inline]
fn bases<T: Scalar, const L: usize>(
    s: &Shape,
    xi: &[T; 2],
    nodes: usize,
    x: impl Fn(usize) -> [T; L],
) -> [[T; L]; 2] {
    let mut e = [[T::constant(0.0); L]; 2];
    for k in 0..nodes {
        let p = x(k);
        for (m, em) in e.iter_mut().enumerate() {
            let slope = T::chain(s.first[m][k], [s.second[m][k], s.second[m + 1][k]], xi);
            for (ei, pi) in em.iter_mut().zip(p) {
                *ei = *ei + slope * pi;
            }
        }
    }
    e
}

#[inline]
pub(super) fn inner<T: Scalar, const L: usize>(a: &[T; L], b: &[T; L]) -> T {
    let mut s = a[0] * b[0];
    for i in 1..L {
        s = s + a[i] * b[i];
    }
    s
}

/// Origin and orthonormal basis of the plane on which a facet is projected. The plane passes through the first
/// corner, normal to the sum of the corners' normals (in two dimensions along the chord), so that the projection runs
/// counter-clockwise.
fn plane<T: Scalar, const D: usize>(facet: &Facet, x: &[[T; D]]) -> ([T; D], [[T; D]; 2]) {
    let at = |corner: usize| &x[facet.corners[corner]];
    let minus = |a: &[T; D], b: &[T; D]| -> [T; D] { std::array::from_fn(|i| a[i] - b[i]) };
    let over = |a: [T; D], c: T| -> [T; D] { a.map(|v| v / c) };
    let unit = |a: [T; D]| over(a, inner(&a, &a).sqrt());
    let along = minus(at(1), at(0));
    if D == 2 {
        return (*at(0), [unit(along), [T::constant(0.0); D]]);
    }
    let n = if facet.kind == SegmentKind::Tri3 {
        cross(&along, &minus(at(2), at(0)))
    } else {
        cross(&minus(at(2), at(0)), &minus(at(3), at(1)))
    };
    let n = unit(n);
    let off = inner(&n, &along);
    let first = unit(std::array::from_fn(|i| along[i] - n[i] * off));
    (*at(0), [first, cross(&n, &first)])
}

fn cross<T: Scalar, const D: usize>(a: &[T; D], b: &[T; D]) -> [T; D] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % D, (i + 2) % D);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// Natural coordinates of a point of the plane in the face of a facet, whose nodes are at `x`. The values are found by Newton's
/// method. One further step in the numbers themselves gives the derivatives of the implicit function.
fn locate<T: Scalar, const D: usize>(facet: &Facet, x: &[[T; 2]], y: &[T; 2]) -> [T; 2] {
    let target = [y[0].value(), y[1].value()];
    let kind = facet.face.kind;
    let mut xi = facet.face.at(&middle(facet.kind));
    let (mut inverse, mut last) = ([[f64::NAN; 2]; 2], [f64::NAN; 2]);
    for _ in 0..ITERATIONS {
        let s = shape(kind, xi);
        let mut off = target;
        let mut e = [[0.0; 2]; 2];
        for (k, p) in x.iter().enumerate() {
            for i in 0..2 {
                let v = p[i].value();
                off[i] -= s.value[k] * v;
                e[0][i] += s.first[0][k] * v;
                e[1][i] += s.first[1][k] * v;
            }
        }
        inverse = if D == 2 {
            [[e[0][0].recip(), 0.0], [0.0, 0.0]]
        } else {
            let det = e[0][0] * e[1][1] - e[0][1] * e[1][0];
            [[e[1][1] / det, -e[1][0] / det], [-e[0][1] / det, e[0][0] / det]]
        };
        last = [dot(&inverse[0], &off), dot(&inverse[1], &off)];
        xi = [xi[0] + last[0], xi[1] + last[1]];
        if last[0].abs().max(last[1].abs()) <= CONVERGED * (1.0 + xi[0].abs().max(xi[1].abs())) {
            break;
        }
    }
    if !kind.first_order() {
        xi = settled(last, xi);
    }
    let s = shape(kind, xi);
    let mut off = *y;
    for (k, p) in x.iter().enumerate() {
        for i in 0..2 {
            off[i] = off[i] - p[i].times(s.value[k]);
        }
    }
    std::array::from_fn(|m| T::constant(xi[m]) + off[0].times(inverse[m][0]) + off[1].times(inverse[m][1]))
}

/// Outline of a facet in the plane, of whose face this is the projection.
fn outline<T: Scalar>(facet: &Facet, x: &[[T; 2]]) -> Polygon<T> {
    let mut out = Polygon::empty();
    facet.corners.iter().for_each(|&k| out.push(x[k]));
    out
}

/// True if the bounding boxes of two polygons do not overlap.
fn apart<T: Scalar>(a: &Polygon<T>, b: &Polygon<T>) -> bool {
    let range = |p: &Polygon<T>, i: usize| {
        p.at[..p.corners]
            .iter()
            .map(|x| x[i].value())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
    };
    (0..2).any(|i| {
        let ((al, ah), (bl, bh)) = (range(a, i), range(b, i));
        ah <= bl || bh <= al
    })
}
