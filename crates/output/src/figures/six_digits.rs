//! Values of figures as they are kept.

/// A value with six digits, more than colours show.
#[must_use]
pub fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
