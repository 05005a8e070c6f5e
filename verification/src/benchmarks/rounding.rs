//! Rounding of stored numbers.

/// Rounds a number to `n` significant digits, so that files do not depend on machine-specific last bits.
pub fn digits(value: f64, n: usize) -> f64 {
    format!("{value:.*e}", n - 1).parse().unwrap_or(value)
}
