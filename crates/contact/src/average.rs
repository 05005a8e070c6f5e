//! Tractions averaged to slave points.
//!
//! The tractions f_A conjugate to the averaged gaps of a mortar interface are coefficients of the field `p = Σ_A ψ_A f_A`. If
//! the field is a square root at the edge of contact, its coefficients oscillate there, as in any projection onto continuous
//! functions. The value transmitted around a point is `p_A = ∫ψ_A p / ∫ψ_A`. On first-order facets it is the force on the slave
//! node over its area, which is the traction of a method with dual multipliers. With the products of functions,
//! `p_A = Σ_B (∫ψ_A ψ_B / ∫ψ_A) f_B`. For the square root at the edge of a Hertz contact the averages lie on the curve within
//! (h/d)²/48 at the distance d from the edge.

use crate::measure::Measure;
use crate::vector::axpy;

/// Computes the averages of the normal and tangential tractions of all points; `shares` is a buffer.
pub(crate) fn averages<const D: usize>(
    measure: &dyn Measure<D>,
    (normal, shear): (&[f64], &[[f64; D]]),
    (mean_normal, mean_shear): (&mut [f64], &mut [[f64; D]]),
    shares: &mut Vec<(usize, f64)>,
) {
    mean_normal.copy_from_slice(normal);
    mean_shear.copy_from_slice(shear);
    for p in 0..normal.len() {
        measure.averages(p, shares);
        if shares.is_empty() {
            continue;
        }
        let (mut f, mut t) = (0.0, [0.0; D]);
        for &(q, share) in &*shares {
            f += share * normal[q];
            axpy(&mut t, share, &shear[q]);
        }
        mean_normal[p] = f;
        mean_shear[p] = t;
    }
}
