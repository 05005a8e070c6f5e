//! Times as text.

use crate::decimals::legible;

/// A year \[s\].
pub const YEAR: f64 = 365.25 * 86_400.0;

/// Simulated time, in years if it is long.
#[must_use]
pub fn time(seconds: f64) -> String {
    if seconds.abs() >= 0.1 * YEAR {
        format!("{:.5} yr", seconds / YEAR)
    } else {
        format!("{} s", legible(seconds, 5))
    }
}

/// Wall time to one or two digits, in a unit that suits it.
#[must_use]
pub fn about(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 100.0 => (s, "s"),
        s if s < 6000.0 => (s / 60.0, "min"),
        s if s < 172_800.0 => (s / 3600.0, "h"),
        s => (s / 86_400.0, "days"),
    };
    if value < 10.0 && unit != "s" { format!("{value:.1} {unit}") } else { format!("{value:.0} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_units_that_suit_them() {
        assert_eq!([2.0 * YEAR, 0.5, 2e-6].map(time), ["2.00000 yr", "0.50000 s", "2.000e-6 s"]);
        assert_eq!([3.2, 150.0, 7200.0, 1e6].map(about), ["3 s", "2.5 min", "2.0 h", "12 days"]);
    }
}
