//! Vectors of coordinates.

/// Euclidean length.
#[must_use]
pub fn length<const D: usize>(v: &[f64; D]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The tangent of a surface in the plane with this normal, `(-n_y, n_x)`.
#[inline]
#[must_use]
pub fn tangent<const D: usize>(normal: &[f64; D]) -> [f64; D] {
    let mut tangent = [0.0; D];
    tangent[0] = -normal[1];
    tangent[1] = normal[0];
    tangent
}
