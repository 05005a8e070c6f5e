//! Lengths as text with a unit, as written in scenes.

/// Formats a length in metres in the largest unit from nm to km in which it is at least 1.
#[must_use]
pub fn show(length: f64) -> String {
    let (factor, unit) = match length.abs() {
        0.0 => (1.0, "m"),
        l if l >= 1e3 => (1e-3, "km"),
        l if l >= 1.0 => (1.0, "m"),
        l if l * 1e3 >= 1.0 => (1e3, "mm"),
        l if l * 1e6 >= 1.0 => (1e6, "um"),
        _ => (1e9, "nm"),
    };
    let rounded: f64 = format!("{:.9e}", length * factor).parse().unwrap_or(length * factor);
    format!("{rounded} {unit}")
}

/// Formats a measured length to four significant digits.
#[must_use]
pub fn brief(length: f64) -> String {
    show(format!("{length:.3e}").parse().unwrap_or(length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_shown_in_the_unit_that_fits() {
        assert_eq!(show(0.00125), "1.25 mm");
        assert_eq!(show(40.0e3), "40 km");
        assert_eq!(show(2.0 / 1e8), "20 nm");
        assert_eq!(show(-0.001), "-1 mm");
        assert_eq!(show(0.0), "0 m");
        assert_eq!(brief(2.500_000_1), "2.5 m");
        assert_eq!(brief(-0.001_234_56), "-1.235 mm");
    }
}
