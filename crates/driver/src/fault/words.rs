//! Lengths and times in words.

use asperity_output::decimals::fixed;

/// A year \[s\], as the benchmarks count it.
pub(super) const YEAR: f64 = 365.25 * 86_400.0;

/// A length in words, in a unit that leaves digits before the point.
pub(super) fn length(metres: f64) -> String {
    let (scale, unit) = match metres.abs() {
        m if m >= 1e3 => (1e-3, "km"),
        m if m >= 1.0 || m == 0.0 => (1.0, "m"),
        m if m >= 1e-3 => (1e3, "mm"),
        _ => (1e6, "um"),
    };
    format!("{} {unit}", fixed(metres * scale, 4))
}

/// A time in words.
pub(super) fn time(seconds: f64) -> String {
    if seconds.abs() >= 0.1 * YEAR {
        format!("{:.5} yr", seconds / YEAR)
    } else {
        format!("{} s", fixed(seconds, 5))
    }
}
