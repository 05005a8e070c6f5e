//! The catalogue in the CMTSOLUTION format of global centroid solutions, one event after another.
//!
//! Units are dyn cm, degrees, km and s. The first line is the hypocentre. The position of the centroid is the mean position of
//! slip and its time the onset (zero shift). The half duration is half the time above the thresholds.

use super::event::SourceParameters;
use crate::decimals::{fixed, scientific};
use jiff::tz::TimeZone;
use std::fmt::Write as _;

/// Dyne centimetres per newton metre.
const DYNE_CM: f64 = 1e7;

/// The file; `None` if the moment is unknown because the length out of the plane is not declared.
#[must_use]
pub fn cmtsolution(title: &str, events: &[SourceParameters]) -> Option<String> {
    let mut text = String::new();
    for (k, event) in events.iter().enumerate() {
        let (spot, centroid, magnitude) = (&event.hypocentre, &event.centroid, event.magnitude?);
        let time = event.onset.to_zoned(TimeZone::UTC);
        // Readers expect the position in fixed columns, which leaves two decimals for the seconds. The time shift holds the
        // remainder.
        let hundredths = time.subsec_nanosecond() / HUNDREDTH;
        let shift = f64::from(time.subsec_nanosecond() % HUNDREDTH) / 1e9;
        let _ = writeln!(
            text,
            " SIM {:04} {:02} {:02} {:02} {:02} {:02}.{hundredths:02} {:>9} {:>9} {:>5} {magnitude:.1} {magnitude:.1} SIMULATED",
            time.year(),
            time.month(),
            time.day(),
            time.hour(),
            time.minute(),
            time.second(),
            fixed(spot.latitude, 4),
            fixed(spot.longitude, 4),
            fixed(spot.depth / 1e3, 1),
        );
        let mut line = |name: &str, value: &str| {
            let _ = writeln!(text, "{name}{value:>width$}", width = WIDTH - name.len());
        };
        line("event name:", &format!("{}-{}", word(title), k + 1));
        line("time shift:", &format!("{shift:.6}"));
        line("half duration:", &format!("{:.4}", 0.5 * event.duration));
        line("latitude:", &fixed(centroid.latitude, 4));
        line("longitude:", &fixed(centroid.longitude, 4));
        line("depth:", &fixed(centroid.depth / 1e3, 4));
        for (name, value) in ["rr", "tt", "pp", "rt", "rp", "tp"].iter().zip(event.tensor.0) {
            line(&format!("M{name}:"), &exponential(value * DYNE_CM));
        }
        text.push('\n');
    }
    Some(text)
}

/// Nanoseconds in a hundredth of a second.
const HUNDREDTH: i32 = 10_000_000;
/// Width of the lines in columns.
const WIDTH: usize = 28;

/// Formats with six decimals and an exponent with sign and two digits, as in Fortran.
fn exponential(value: f64) -> String {
    let text = scientific(value, 6);
    let Some((digits, exponent)) = text.split_once('e') else { return text };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    format!("{digits}E{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs())
}

/// A single word of characters admitted by the format.
fn word(text: &str) -> String {
    text.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_a_signed_exponent_of_two_digits() {
        assert_eq!(exponential(1.0e27), "1.000000E+27");
        assert_eq!(exponential(-3.5e-7), "-3.500000E-07");
        assert_eq!([exponential(0.0), exponential(-0.0)], ["0.000000E+00"; 2]);
    }
}
