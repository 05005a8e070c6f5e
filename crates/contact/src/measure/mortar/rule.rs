//! Quadrature on the pieces of an overlap.

use super::facet::Facet;
use crate::SegmentKind;
use asperity_fem::quadrature::{triangle_1, triangle_3, triangle_6};

/// Most Gauss points in one direction. Faces so distorted that the product of shape functions needs more are integrated to
/// lower accuracy, as elements are.
const MOST: usize = 12;

/// Accuracy for which the number of points on irregular quadrilaterals is chosen, at the level of rounding.
const ACCURACY: f64 = 1e-16;

/// A facet whose Jacobian varies by less than this share is a parallelogram up to the rounding of coordinates.
const REGULAR: f64 = 1e-10;

/// Quadrature on the pieces of an overlap.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    /// Abscissae and weights on [0, 1].
    pub line: Vec<[f64; 2]>,
    /// Barycentric coordinates and weights on triangles; the weights sum to 1/2.
    pub triangle: Vec<([f64; 3], f64)>,
    /// True if a polygon is divided into a fan about its centroid. With the symmetric rule of degree 4 its integrals then
    /// depend neither on the choice of the first corner nor on corners added by rounding. Rules of lower degree are used on
    /// triangles and are exact there; rules of higher degree have enough points for any fan.
    pub centred: bool,
}

impl Rule {
    /// Makes a rule of Gauss-Legendre points on [0, 1]. On triangles it is a symmetric rule of degree 2n - 2 if one is
    /// available, otherwise the collapsed rule of the square, of the same degree.
    fn new(n: usize) -> Self {
        let line = legendre(n);
        let shares = |([x, y, _], weight): ([f64; 3], f64)| ([1.0 - x - y, x, y], weight);
        let triangle = match n {
            1 => triangle_1().into_iter().map(shares).collect(),
            2 => triangle_3().into_iter().map(shares).collect(),
            3 => triangle_6().into_iter().map(shares).collect(),
            _ => collapsed(&line),
        };
        Self { line, triangle, centred: n == 3 }
    }
}

/// Rule of the square collapsed onto a triangle.
fn collapsed(line: &[[f64; 2]]) -> Vec<([f64; 3], f64)> {
    let point = |[s, ws]: [f64; 2], [t, wt]: [f64; 2]| {
        let v = t * (1.0 - s);
        ([1.0 - s - v, s, v], ws * wt * (1.0 - s))
    };
    line.iter().flat_map(|&s| line.iter().map(move |&t| point(s, t))).collect()
}

/// Rules of 1 to [`MOST`] points in one direction.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    rules: Vec<Rule>,
}

impl Rules {
    pub(super) fn new() -> Self {
        Self { rules: (1..=MOST).map(Rule::new).collect() }
    }

    /// Rule of `n` points.
    #[inline]
    pub(super) fn rule(&self, n: usize) -> &Rule {
        &self.rules[n - 1]
    }
}

/// Zeros of the Legendre polynomial by Newton's method, with their weights 2/((1 - x²) P'²), on [0, 1].
fn legendre(n: usize) -> Vec<[f64; 2]> {
    #[expect(clippy::cast_precision_loss, reason = "n is at most MOST")]
    let count = n as f64;
    (0..n)
        .map(|i| {
            #[expect(clippy::cast_precision_loss, reason = "i is below MOST")]
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (count + 0.5)).cos();
            let mut slope = 1.0;
            // The initial guess is good to two digits. Quadratic convergence reaches rounding after four steps.
            for _ in 0..8 {
                let (mut p, mut before) = (1.0, 0.0);
                for k in 0..n {
                    #[expect(clippy::cast_precision_loss, reason = "k is below MOST")]
                    let k = k as f64;
                    (p, before) = (((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0), p);
                }
                slope = count * (x * p - before) / (x * x - 1.0);
                x -= p / slope;
            }
            [0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}

/// Functions with which those of faces are multiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rows {
    /// Those of the corners of a facet.
    Corners,
    /// Those of its face.
    Face,
}

/// Number of Gauss points in one direction for the products of functions of a facet's corners, or of its face (times the radius), with
/// those of its face and of that of the `other` facet. It is exact if these are polynomials in the plane and the face is flat.
pub(super) fn points(facet: &Facet, rows: Rows, other: &Facet) -> usize {
    let degree = |k: SegmentKind| match k {
        SegmentKind::Seg2 | SegmentKind::Tri3 => 1,
        SegmentKind::Seg3 | SegmentKind::Tri6 | SegmentKind::Quad4 => 2,
        SegmentKind::Quad8 => 3,
        SegmentKind::Quad9 => 4,
    };
    let distortion = facet.distortion.max(other.distortion);
    let of_rows = if rows == Rows::Corners { facet.kind } else { facet.face.kind };
    let of_products = degree(of_rows) + degree(other.face.kind).max(degree(facet.face.kind));
    // 2n - 1 on lines, where the radius of a body of revolution adds one degree; 2n - 2 on triangles.
    let n = (of_products + 3) / 2;
    if distortion < REGULAR {
        return n;
    }
    // The inverse of the bilinear map is analytic up to the zeros of the Jacobian, at 1/distortion in natural coordinates.
    // Gauss quadrature converges with the square of the parameter of that ellipse.
    let far = distortion.min(1.0).recip();
    let ellipse = (far + (far * far - 1.0).max(0.0).sqrt()).max(1.0 + REGULAR);
    let more = -ACCURACY.ln() / (2.0 * ellipse.ln());
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive and bounded by MOST"
    )]
    let more = more.min(MOST as f64).ceil() as usize;
    (n + more).min(MOST)
}
