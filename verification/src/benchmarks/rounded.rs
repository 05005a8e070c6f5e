//! Rounding of numbers that are stored.

/// Number rounded to significant digits, so that files do not depend on the last bits of a machine.
pub fn digits(value: f64, n: usize) -> f64 {
    format!("{value:.*e}", n - 1).parse().unwrap_or(value)
}
