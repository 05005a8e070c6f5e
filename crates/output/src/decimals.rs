//! Formatting of decimals: values that round to zero have no sign. All numbers of text files that may be negative are formatted
//! here.

/// Formats with a fixed number of decimals.
#[must_use]
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_string(),
        _ => text,
    }
}

/// Formats with a fixed number of decimals, or with an exponent where these would leave fewer than two digits.
#[must_use]
pub fn legible(value: f64, decimals: usize) -> String {
    let least = 10.0_f64.powi(1 - i32::try_from(decimals).unwrap_or(i32::MAX));
    if value == 0.0 || value.abs() >= least { fixed(value, decimals) } else { scientific(value, 3) }
}

/// Formats with a fixed number of decimals and an exponent.
#[must_use]
pub fn scientific(value: f64, decimals: usize) -> String {
    // Adding zero turns -0 into 0.
    format!("{:.decimals$e}", value + 0.0)
}

/// The shortest decimal that reads back as the same number.
#[must_use]
pub fn shortest(value: f64) -> String {
    format!("{}", value + 0.0)
}

/// The shortest decimal with an exponent that reads back as the same number.
#[must_use]
pub fn shortest_scientific(value: f64) -> String {
    format!("{:e}", value + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_rounds_to_zero_has_a_sign() {
        assert_eq!(fixed(-0.0, 6), "0.000000");
        assert_eq!(fixed(-4e-7, 6), "0.000000");
        assert_eq!(fixed(-6e-7, 6), "-0.000001");
        assert_eq!(fixed(-0.4, 0), "0");
        assert_eq!(fixed(f64::NEG_INFINITY, 2), "-inf");
        assert_eq!(scientific(-0.0, 3), "0.000e0");
        assert_eq!([0.0, 0.001, -2.5e-6].map(|v| legible(v, 4)), ["0.0000", "0.0010", "-2.500e-6"]);
        assert_eq!(scientific(-1e-30, 1), "-1.0e-30");
        assert_eq!([shortest(-0.0), shortest_scientific(-0.0)], ["0", "0e0"]);
        assert_eq!([shortest(-0.25), shortest_scientific(-1e-30)], ["-0.25", "-1e-30"]);
    }
}
