//! Lengths and times as text.

use asperity_output::decimals::fixed;

/// A year as defined by the benchmarks \[s\].
pub(super) const YEAR: f64 = 365.25 * 86_400.0;

/// Length as text, in a unit that leaves digits before the decimal point.
pub(crate) fn length(metres: f64) -> String {
    let (scale, unit) = match metres.abs() {
        m if m >= 1e3 => (1e-3, "km"),
        m if m >= 1.0 || m == 0.0 => (1.0, "m"),
        m if m >= 1e-3 => (1e3, "mm"),
        _ => (1e6, "um"),
    };
    format!("{} {unit}", fixed(metres * scale, 4))
}

/// Time as text.
pub(crate) fn time(seconds: f64) -> String {
    if seconds.abs() >= 0.1 * YEAR {
        format!("{:.5} yr", seconds / YEAR)
    } else {
        format!("{} s", fixed(seconds, 5))
    }
}
