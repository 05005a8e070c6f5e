//! Vectors of coordinates.

/// Euclidean length.
#[must_use]
pub fn length<const D: usize>(v: &[f64; D]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}
