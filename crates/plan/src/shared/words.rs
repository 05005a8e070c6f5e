//! Lengths and times as text.

use asperity_output::decimals::fixed;

pub use asperity_output::words::time;

/// A year as defined by the benchmarks \[s\].
pub const YEAR: f64 = asperity_output::words::YEAR;

/// Length as text, in a unit that leaves digits before the decimal point.
pub fn length(metres: f64) -> String {
    let (scale, unit) = match metres.abs() {
        m if m >= 1e3 => (1e-3, "km"),
        m if m >= 1.0 || m == 0.0 => (1.0, "m"),
        m if m >= 1e-3 => (1e3, "mm"),
        _ => (1e6, "um"),
    };
    format!("{} {unit}", fixed(metres * scale, 4))
}
