//! Inverted, folded or flat elements.

use crate::element::{ElementKind, Shape};

/// Determinant at a corner, relative to the largest in the element, that counts as zero. A corner of a collapsed element, or of
/// one whose mid-nodes lie at quarter points, has zero determinant by design.
const FLAT: f64 = 1e-9;

/// Points of an element kind at which elements are checked.
pub(crate) struct Sense {
    /// Shape functions at the corners.
    corners: Vec<Shape>,
    /// Shape functions at the quadrature points.
    inner: Vec<Shape>,
}

/// Points for elements of `kind`, whose corners are the first `corners` nodes.
pub(crate) fn sense(kind: ElementKind, corners: usize) -> Sense {
    Sense {
        corners: kind.node_coordinates()[..corners].iter().map(|&xi| kind.shape(xi)).collect(),
        inner: kind.quadrature().iter().map(|&(xi, _)| kind.shape(xi)).collect(),
    }
}

/// Smallest determinant over the largest magnitude in the element \[-\]: positive for a valid element. A corner is considered
/// only if it is negative beyond rounding.
pub(crate) fn least<const D: usize>(sense: &Sense, x: &[[f64; D]]) -> f64 {
    let corners: Vec<f64> = sense.corners.iter().map(|s| determinant(s, x)).collect();
    let inner: Vec<f64> = sense.inner.iter().map(|s| determinant(s, x)).collect();
    let greatest = corners.iter().chain(&inner).fold(0.0_f64, |m, d| m.max(d.abs()));
    if greatest == 0.0 || !greatest.is_finite() {
        return 0.0;
    }
    let at_corners = corners.iter().map(|d| d / greatest).filter(|d| *d < -FLAT);
    inner.iter().map(|d| d / greatest).chain(at_corners).fold(f64::INFINITY, f64::min)
}

/// det(∂x_i/∂ξ_m) \[m^D\], ∂x_i/∂ξ_m = Σ_a x_ai ∂N_a/∂ξ_m.
fn determinant<const D: usize>(shape: &Shape, x: &[[f64; D]]) -> f64 {
    let mut j = [[0.0; 3]; 3];
    for (xa, dn) in x.iter().zip(&shape.dn) {
        for (row, xi) in j.iter_mut().zip(xa) {
            for (entry, d) in row.iter_mut().zip(dn) {
                *entry += xi * d;
            }
        }
    }
    if D == 2 {
        return j[0][0] * j[1][1] - j[0][1] * j[1][0];
    }
    let minor = |a: usize, b: usize| j[1][a] * j[2][b] - j[1][b] * j[2][a];
    j[0][0] * minor(1, 2) - j[0][1] * minor(0, 2) + j[0][2] * minor(0, 1)
}
