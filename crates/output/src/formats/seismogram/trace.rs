//! One component of motion at a station, and its codes.

use jiff::Timestamp;

/// Names of the components, which are also the orientation codes of their channels.
pub const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// One component of motion, sampled at equal intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Code of the network, at most two characters.
    pub network: String,
    /// Code of the station, at most five characters.
    pub station: String,
    /// Code of the channel, three characters.
    pub channel: String,
    /// Time zero of the simulation.
    pub epoch: Timestamp,
    /// Time of the first sample after time zero \[s\].
    pub start: f64,
    /// Time between two samples \[s\].
    pub interval: f64,
    /// Particle velocity \[m/s\].
    pub samples: Vec<f64>,
}

impl Trace {
    /// Nanoseconds from time zero to a sample.
    pub(super) fn nanoseconds(&self, sample: usize) -> i64 {
        ((self.start + sample as f64 * self.interval) * 1e9).round() as i64
    }
}

/// Band codes of SEED by the shortest interval to which they apply \[s\].
const BANDS: [(f64, char); 6] =
    [(1.0, 'L'), (0.1, 'M'), (0.0125, 'B'), (0.004, 'H'), (FASTEST, 'C'), (0.0, 'F')];
/// Interval below which data have the band code F \[s\].
const FASTEST: f64 = 1e-3;
/// Part of an interval that rounding may take from it.
const ROUNDING: f64 = 1e-9;

/// Code of a channel: the band of its sampling, X for data that are not measured (FDSN source identifiers), and its axis.
#[must_use]
pub fn channel(interval: f64, axis: char) -> String {
    let band =
        BANDS.iter().find(|(least, _)| interval * (1.0 + ROUNDING) >= *least).map_or('F', |band| band.1);
    [band, 'X', axis].iter().collect()
}

/// True if a text is a code: one to `most` capital letters and digits.
#[must_use]
pub fn code(text: &str, most: usize) -> bool {
    (1..=most).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_of_a_channel_follows_its_sampling() {
        let codes = [2.0, 0.5, 0.05, 1.0 / 80.0, 0.01, 0.004, 0.002, 1e-5].map(|dt| channel(dt, 'X'));
        assert_eq!(codes, ["LXX", "MXX", "BXX", "BXX", "HXX", "HXX", "CXX", "FXX"]);
    }

    #[test]
    fn codes_are_short_and_of_capitals_and_digits() {
        assert!(code("ST01", 5) && code("A", 2));
        assert!(!code("", 5) && !code("STATION", 5) && !code("st", 5) && !code("Ä", 5) && !code("A B", 5));
    }
}
