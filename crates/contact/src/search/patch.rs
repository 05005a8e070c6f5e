//! Geometry of a master segment at one point: position, tangents, second derivatives.
//!
//! A segment is either the polynomial through its own nodes or, on smoothed surfaces, a cubic Bézier patch whose control points
//! are linear in nodal positions (see [`super::smooth`]). Both are evaluated here from their points.

use crate::SegmentKind;
use crate::shape::{MOST_NODES, corners, shape};
use crate::vector::axpy;

/// Most points of a form, those of a bicubic patch.
pub const MOST_POINTS: usize = 16;

/// Geometric description of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Polynomial through its own nodes.
    Nodes(SegmentKind),
    /// Bézier control points over the natural coordinates of the kind: 4 on seg2 (from end to end), 10 on tri3 (by rows of
    /// constant ξ_2), 16 on quad4 (ξ_1 fastest).
    Cubic(SegmentKind),
}

impl Form {
    /// Kind of the segment, which decides natural coordinates, corners and borders.
    #[must_use]
    pub fn kind(self) -> SegmentKind {
        match self {
            Self::Nodes(kind) | Self::Cubic(kind) => kind,
        }
    }

    /// Number of points.
    #[must_use]
    pub fn points(self) -> usize {
        match self {
            Self::Nodes(kind) => kind.nodes(),
            Self::Cubic(kind) => [4, 10, 16][corners(kind) - 2],
        }
    }

    /// True if its edges are straight.
    #[must_use]
    pub fn straight(self) -> bool {
        matches!(self, Self::Nodes(kind) if kind.first_order())
    }
}

/// A point of a segment with its derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Patch<const D: usize> {
    /// Position \[m\].
    pub point: [f64; D],
    /// Base vectors e_m; the second is zero in two dimensions.
    pub e: [[f64; D]; 2],
    /// Second derivatives e_1,1, e_1,2, e_2,2.
    pub curvature: [[f64; D]; 3],
}

/// Values and derivatives of the functions that weight the points of a form. Entries beyond its points are zero.
#[derive(Clone, Copy, Debug)]
pub struct Basis {
    /// Values.
    pub value: [f64; MOST_POINTS],
    /// First derivatives.
    pub first: [[f64; MOST_POINTS]; 2],
    /// Second derivatives 11, 12, 22.
    pub second: [[f64; MOST_POINTS]; 3],
}

impl Basis {
    fn zero() -> Self {
        Self { value: [0.0; MOST_POINTS], first: [[0.0; MOST_POINTS]; 2], second: [[0.0; MOST_POINTS]; 3] }
    }

    /// Functions of `form` at natural coordinates `xi`.
    #[must_use]
    pub fn new(form: Form, xi: [f64; 2]) -> Self {
        let mut b = Self::zero();
        match form {
            Form::Nodes(kind) => {
                let s = shape(kind, xi);
                b.value[..MOST_NODES].copy_from_slice(&s.value);
                for (to, from) in b.first.iter_mut().zip(&s.first) {
                    to[..MOST_NODES].copy_from_slice(from);
                }
                for (to, from) in b.second.iter_mut().zip(&s.second) {
                    to[..MOST_NODES].copy_from_slice(from);
                }
            }
            Form::Cubic(kind) => match corners(kind) {
                2 => b.line(&bernstein(xi[0])),
                3 => b.triangle(xi),
                _ => b.product(&bernstein(xi[0]), &bernstein(xi[1])),
            },
        }
        b
    }

    fn line(&mut self, p: &[[f64; 4]; 3]) {
        self.value[..4].copy_from_slice(&p[0]);
        self.first[0][..4].copy_from_slice(&p[1]);
        self.second[0][..4].copy_from_slice(&p[2]);
    }

    fn product(&mut self, p: &[[f64; 4]; 3], q: &[[f64; 4]; 3]) {
        for k in 0..16 {
            let (i, j) = (k % 4, k / 4);
            self.value[k] = p[0][i] * q[0][j];
            self.first[0][k] = p[1][i] * q[0][j];
            self.first[1][k] = p[0][i] * q[1][j];
            self.second[0][k] = p[2][i] * q[0][j];
            self.second[1][k] = p[1][i] * q[1][j];
            self.second[2][k] = p[0][i] * q[2][j];
        }
    }

    /// Cubic Bernstein polynomials 3!/(i!j!k!) u^i v^j w^k with u = 1 - ξ_1 - ξ_2 and v, w the natural coordinates.
    fn triangle(&mut self, [v, w]: [f64; 2]) {
        let u = 1.0 - v - w;
        for (at, [i, j, k]) in TRIANGLE.iter().copied().enumerate() {
            let c = 6.0 / (FACTORIAL[i] * FACTORIAL[j] * FACTORIAL[k]);
            let d = |a: usize, b: usize, g: usize| c * power(u, i, a) * power(v, j, b) * power(w, k, g);
            self.value[at] = d(0, 0, 0);
            self.first[0][at] = d(0, 1, 0) - d(1, 0, 0);
            self.first[1][at] = d(0, 0, 1) - d(1, 0, 0);
            self.second[0][at] = d(0, 2, 0) - 2.0 * d(1, 1, 0) + d(2, 0, 0);
            self.second[1][at] = d(0, 1, 1) - d(1, 1, 0) - d(1, 0, 1) + d(2, 0, 0);
            self.second[2][at] = d(0, 0, 2) - 2.0 * d(1, 0, 1) + d(2, 0, 0);
        }
    }
}

/// Factorials 0! to 3!.
const FACTORIAL: [f64; 4] = [1.0, 1.0, 2.0, 6.0];

/// Exponents of the control points of a cubic triangle, by rows from corner 1 towards corner 3.
pub(super) const TRIANGLE: [[usize; 3]; 10] = [
    [3, 0, 0],
    [2, 1, 0],
    [1, 2, 0],
    [0, 3, 0],
    [2, 0, 1],
    [1, 1, 1],
    [0, 2, 1],
    [1, 0, 2],
    [0, 1, 2],
    [0, 0, 3],
];

/// Derivative of order `d` of x^n.
fn power(x: f64, n: usize, d: usize) -> f64 {
    let mut c = 1.0;
    for k in 0..d {
        if k >= n {
            return 0.0;
        }
        c *= [3.0, 2.0, 1.0][k + 3 - n];
    }
    (d..n).fold(c, |p, _| p * x)
}

/// Cubic Bernstein polynomials over [-1, 1] with their derivatives.
fn bernstein(x: f64) -> [[f64; 4]; 3] {
    let (s, t) = (0.5 * (1.0 - x), 0.5 * (1.0 + x));
    [
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
        [-1.5 * s * s, 1.5 * s * (s - 2.0 * t), 1.5 * t * (2.0 * s - t), 1.5 * t * t],
        [1.5 * s, 1.5 * (t - 2.0 * s), 1.5 * (s - 2.0 * t), 1.5 * t],
    ]
}

/// Evaluates a form with points `x` at `xi`. The formulas of two-node lines, flat triangles and bilinear quadrilaterals are
/// written out, since most surfaces consist of these.
#[inline]
#[must_use]
pub fn evaluate<const D: usize>(form: Form, x: &[[f64; D]], xi: [f64; 2]) -> Patch<D> {
    let mut p = Patch { point: [0.0; D], e: [[0.0; D]; 2], curvature: [[0.0; D]; 3] };
    match (form, x) {
        (Form::Nodes(SegmentKind::Seg2), [a, b]) => {
            for i in 0..D {
                p.point[i] = 0.5 * ((1.0 - xi[0]) * a[i] + (1.0 + xi[0]) * b[i]);
                p.e[0][i] = 0.5 * (b[i] - a[i]);
            }
        }
        (Form::Nodes(SegmentKind::Tri3), [a, b, c]) => {
            let u = 1.0 - xi[0] - xi[1];
            for i in 0..D {
                p.point[i] = u * a[i] + xi[0] * b[i] + xi[1] * c[i];
                p.e[0][i] = b[i] - a[i];
                p.e[1][i] = c[i] - a[i];
            }
        }
        (Form::Nodes(SegmentKind::Quad4), [a, b, c, d]) => {
            let (s, t) =
                ([0.5 * (1.0 - xi[0]), 0.5 * (1.0 + xi[0])], [0.5 * (1.0 - xi[1]), 0.5 * (1.0 + xi[1])]);
            for i in 0..D {
                p.point[i] = t[0] * (s[0] * a[i] + s[1] * b[i]) + t[1] * (s[1] * c[i] + s[0] * d[i]);
                p.e[0][i] = 0.5 * (t[0] * (b[i] - a[i]) + t[1] * (c[i] - d[i]));
                p.e[1][i] = 0.5 * (s[0] * (d[i] - a[i]) + s[1] * (c[i] - b[i]));
                p.curvature[1][i] = 0.25 * (a[i] - b[i] + c[i] - d[i]);
            }
        }
        _ => {
            let b = Basis::new(form, xi);
            for (k, xk) in x.iter().enumerate() {
                axpy(&mut p.point, b.value[k], xk);
                for m in 0..2 {
                    axpy(&mut p.e[m], b.first[m][k], xk);
                }
                for m in 0..3 {
                    axpy(&mut p.curvature[m], b.second[m][k], xk);
                }
            }
        }
    }
    p
}
