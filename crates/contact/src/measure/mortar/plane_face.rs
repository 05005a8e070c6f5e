//! A face in the plane of a slave facet: natural coordinates of positions, functions there, and the ratio of areas.
//!
//! With y = X(xi): `δxi = X'^-1 (δy - Σ N_k δx_k)`. Faces of first order are bilinear, which saves most of the work.

use super::facet::{Facet, NODES, middle};
use crate::SegmentKind;
use crate::shape::{MOST_NODES, Shape, shape};
use crate::vector::{add, axpy, cross, dot, norm, sub};

/// Most Newton iterations for natural coordinates, as in `cell`.
const ITERATIONS: usize = 30;
/// Step in natural coordinates below which the iteration has converged, as in `cell`.
const CONVERGED: f64 = 1e-15;

/// Largest last step in natural coordinates. Steps of Newton's method square, so that a larger one is none towards a solution, and
/// rounding is far below it.
const SETTLED: f64 = 1e-9;

/// Functions and their slopes in the natural coordinates of a face.
pub(super) type Functions<const F: usize> = ([f64; F], [[f64; F]; 2]);

/// A face of first order: `X = a + b ξ + c η + d ξ η`.
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

    /// Base vectors at ξ.
    #[inline]
    fn base(&self, xi: &[f64; 2]) -> [[f64; L]; 2] {
        [
            std::array::from_fn(|i| self.b[i] + self.d[i] * xi[1]),
            std::array::from_fn(|i| self.c[i] + self.d[i] * xi[0]),
        ]
    }
}

/// Inverse of the matrix whose columns are the base vectors.
#[inline]
fn inverse([e, f]: &[[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let share = (e[0] * f[1] - e[1] * f[0]).recip();
    [[f[1] * share, -f[0] * share], [-e[1] * share, e[0] * share]]
}

/// Change of the area element with node `n` of a face in the plane, from the slopes of its functions and its base vectors.
#[inline(always)]
pub(super) fn area_slopes<const F: usize>(
    [s, t]: &[[f64; F]; 2],
    [e, f]: &[[f64; 2]; 2],
    n: usize,
) -> [f64; 2] {
    [s[n] * f[1] - t[n] * e[1], t[n] * e[0] - s[n] * f[0]]
}

/// A face in the plane.
pub(super) struct PlaneFace<'a> {
    facet: &'a Facet,
    x: &'a [[f64; 2]],
    /// Its map if it is treated as one of first order, and the inverse of the derivative in the middle of the facet.
    bilinear: Option<(Bilinear<2>, [[f64; 2]; 2])>,
}

/// A position in the plane, seen from a face.
pub(super) struct Position<const F: usize> {
    /// Natural coordinates.
    pub xi: [f64; 2],
    /// Functions of the face.
    pub functions: Functions<F>,
    /// Base vectors in the plane, and the inverse X'^-1.
    pub base: [[f64; 2]; 2],
    pub inverse: [[f64; 2]; 2],
    /// Shape of a face that is not bilinear.
    shape: Option<Shape>,
}

impl<'a> PlaneFace<'a> {
    /// Makes the face of a facet with its nodes at `x`; `linear` if it is of first order and to be treated so.
    pub(super) fn new(facet: &'a Facet, x: &'a [[f64; 2]], linear: bool) -> Self {
        let bilinear = linear.then(|| {
            let map = Bilinear::new(facet.kind, x);
            (map, inverse(&map.base(&middle(facet.kind))))
        });
        Self { facet, x, bilinear }
    }

    /// Changes of the area element with each node at the natural coordinates (0, 0), (1, 0) and (0, 1), between which it is linear;
    /// `None` if the face is not treated as one of first order.
    #[inline(always)]
    pub(super) fn area_slopes(&self) -> Option<[[[f64; 2]; NODES]; 3]> {
        let (map, _) = self.bilinear.as_ref()?;
        Some([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|xi| {
            let (slopes, base) = (linear_functions(self.facet.kind, &xi).1, map.base(&xi));
            std::array::from_fn(|n| area_slopes(&slopes, &base, n))
        }))
    }

    /// Finds the natural coordinates of a position by Newton's method.
    #[inline(always)]
    pub(super) fn locate<const F: usize>(&self, y: &[f64; 2]) -> Position<F> {
        let Some((map, mut inverted)) = self.bilinear else { return self.locate_curved(y) };
        let mut xi = middle(self.facet.kind);
        for _ in 0..ITERATIONS {
            let off: [f64; 2] = std::array::from_fn(|i| {
                y[i] - map.a[i] - map.b[i] * xi[0] - (map.c[i] + map.d[i] * xi[0]) * xi[1]
            });
            let step = [dot(&inverted[0], &off), dot(&inverted[1], &off)];
            xi = [xi[0] + step[0], xi[1] + step[1]];
            // A step leaves the product of its components, so that the next is known.
            let left = map.d.map(|d| d * step[0] * step[1]);
            let done = converged(&[dot(&inverted[0], &left), dot(&inverted[1], &left)], &xi);
            inverted = inverse(&map.base(&xi));
            if done {
                break;
            }
        }
        let functions = bilinear_functions(self.facet.kind, &xi);
        Position { xi, functions, base: map.base(&xi), inverse: inverted, shape: None }
    }

    #[inline(never)]
    fn locate_curved<const F: usize>(&self, y: &[f64; 2]) -> Position<F> {
        let face = &self.facet.face;
        let mut xi = face.at(&middle(self.facet.kind));
        let mut last = [f64::NAN; 2];
        for _ in 0..ITERATIONS {
            let s = shape(face.kind, xi);
            let mut off = *y;
            self.x.iter().zip(&s.value).for_each(|(x, n)| axpy(&mut off, -n, x));
            let inverse = inverse(&self.base(&s));
            last = [dot(&inverse[0], &off), dot(&inverse[1], &off)];
            xi = [xi[0] + last[0], xi[1] + last[1]];
            if converged(&last, &xi) {
                break;
            }
        }
        let xi = settled(last, xi);
        let s = shape(face.kind, xi);
        let base = self.base(&s);
        let cut = |v: &[f64; MOST_NODES]| std::array::from_fn(|k| v[k]);
        let functions = (cut(&s.value), [cut(&s.first[0]), cut(&s.first[1])]);
        Position { xi, functions, base, inverse: inverse(&base), shape: Some(s) }
    }

    fn base(&self, s: &Shape) -> [[f64; 2]; 2] {
        let mut e = [[0.0; 2]; 2];
        for (k, x) in self.x.iter().enumerate() {
            e.iter_mut().zip(&s.first).for_each(|(e, s)| axpy(e, s[k], x));
        }
        e
    }

    /// Functions of the corners of the facet at a position.
    #[inline(always)]
    pub(super) fn corners<const F: usize>(&self, at: &Position<F>) -> Functions<NODES> {
        if at.shape.is_none() {
            let cut = |v: &[f64; F]| std::array::from_fn(|k| v[k]);
            let (values, [first, second]) = &at.functions;
            return (cut(values), [cut(first), cut(second)]);
        }
        let face = &self.facet.face;
        let (values, slopes) = linear_functions(self.facet.kind, &face.facet_coordinates(&at.xi));
        let turned: [[f64; 2]; NODES] = std::array::from_fn(|k| face.slopes([slopes[0][k], slopes[1][k]]));
        (values, std::array::from_fn(|m| std::array::from_fn(|k| turned[k][m])))
    }
}

/// Natural coordinates after the last step, not a number if the iteration has not found any: the projection of the face folds there.
pub(super) fn settled(last: [f64; 2], xi: [f64; 2]) -> [f64; 2] {
    let small = last.iter().all(|step| step.abs() < SETTLED);
    if small { xi } else { [f64::NAN; 2] }
}

#[inline]
fn converged(step: &[f64; 2], xi: &[f64; 2]) -> bool {
    step[0].abs().max(step[1].abs()) <= CONVERGED * (1.0 + xi[0].abs().max(xi[1].abs()))
}

/// Shape functions of a face of first order.
#[inline]
fn linear_functions(kind: SegmentKind, xi: &[f64; 2]) -> Functions<NODES> {
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

#[inline]
fn bilinear_functions<const F: usize>(kind: SegmentKind, xi: &[f64; 2]) -> Functions<F> {
    let (values, [first, second]) = linear_functions(kind, xi);
    let padded = |v: [f64; NODES]| std::array::from_fn(|k| if k < NODES { v[k] } else { 0.0 });
    (padded(values), [padded(first), padded(second)])
}

/// Ratio of the reference area of a face to its area in the plane.
pub(super) struct Density<'a> {
    /// Reference positions of the nodes.
    x: &'a [[f64; 3]],
    /// Products e_1 × e_2 in the reference configuration and in the plane: constant part, slopes in ξ and η.
    bilinear: Option<([[f64; 3]; 3], [f64; 3])>,
}

#[inline]
fn flat(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl<'a> Density<'a> {
    pub(super) fn new(face: &PlaneFace<'_>, reference: &'a [[f64; 3]]) -> Self {
        let bilinear = face.bilinear.as_ref().map(|(p, _)| {
            let r = Bilinear::new(face.facet.kind, reference);
            (
                [cross(&r.b, &r.c), cross(&r.b, &r.d), cross(&r.d, &r.c)],
                [flat(&p.b, &p.c), flat(&p.b, &p.d), flat(&p.d, &p.c)],
            )
        });
        Self { x: reference, bilinear }
    }

    /// Density and its slopes at a position of the face, and the Jacobian of the plane.
    #[inline(always)]
    pub(super) fn at<const F: usize>(&self, face: &PlaneFace<'_>, at: &Position<F>) -> (f64, [f64; 2], f64) {
        let (v, by, p, plane) = match (&self.bilinear, &at.shape) {
            (Some((v, p)), _) => {
                let xi = &at.xi;
                let product = std::array::from_fn(|i| v[0][i] + v[1][i] * xi[0] + v[2][i] * xi[1]);
                (product, [v[1], v[2]], p[0] + p[1] * xi[0] + p[2] * xi[1], [p[1], p[2]])
            }
            (None, Some(s)) => {
                let (e, second) = bases(s, self.x);
                let by = |m: usize| add(&cross(&second[m], &e[1]), &cross(&e[0], &second[m + 1]));
                let (f, bent) = bases(s, face.x);
                let plane = |m: usize| flat(&bent[m], &f[1]) + flat(&f[0], &bent[m + 1]);
                (cross(&e[0], &e[1]), [by(0), by(1)], flat(&f[0], &f[1]), [plane(0), plane(1)])
            }
            // A face that is not bilinear is located by its shape.
            (None, None) => ([f64::NAN; 3], [[f64::NAN; 3]; 2], f64::NAN, [f64::NAN; 2]),
        };
        let r = norm(&v);
        let density = r / p;
        let slope = |m: usize| (dot(&v, &by[m]) / r - density * plane[m]) / p;
        (density, [slope(0), slope(1)], p)
    }
}

/// Base vectors of a face with nodes at `x`, and their slopes (11, 12, 22).
fn bases<const L: usize>(s: &Shape, x: &[[f64; L]]) -> ([[f64; L]; 2], [[f64; L]; 3]) {
    let (mut e, mut second) = ([[0.0; L]; 2], [[0.0; L]; 3]);
    for (k, x) in x.iter().enumerate() {
        e.iter_mut().zip(&s.first).for_each(|(e, s)| axpy(e, s[k], x));
        second.iter_mut().zip(&s.second).for_each(|(e, s)| axpy(e, s[k], x));
    }
    (e, second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mortar::facet::{facets, node_at};
    use crate::spec::Segment;

    #[test]
    fn positions_that_a_folded_face_does_not_reach_have_no_coordinates() {
        let face = Segment { kind: SegmentKind::Quad9, nodes: (0..9).collect() };
        // x = 1 - ξ², which is 1 at most.
        let folded: Vec<[f64; 2]> =
            (0..9).map(|k| node_at(face.kind, k)).map(|[xi, eta]| [1.0 - xi * xi, eta]).collect();
        let facet = facets(&face, None, &folded).remove(0);
        let plane = PlaneFace::new(&facet, &folded, false);
        let at = |x: f64| plane.locate::<9>(&[x, -0.5]).functions.0[0];
        assert!(at(2.0).is_nan() && at(0.5).is_finite());
    }
}
