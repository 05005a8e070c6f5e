//! SAC files, version 6 (Goldstein and Snoke 2005): a header of 632 bytes and the samples as 32-bit floats, little-endian.

use super::trace::Trace;
use jiff::tz::TimeZone;

/// Number of words of the header that are floats, and that are integers.
const WORDS: (usize, usize) = (70, 40);
/// Characters of the header.
const CHARACTERS: usize = 192;
/// Value of what is not given, in all three parts of the header.
const ABSENT: (f32, i32, &str) = (-12345.0, -12345, "-12345  ");
/// Version of the header.
const VERSION: i32 = 6;
/// Codes of a time series, of a dependent variable without its customary unit, and of a reference time that is the origin time.
const CODES: [(usize, i32); 3] = [(15, 1), (16, 5), (17, 11)];
/// Positions of the codes of station, location, channel and network among the characters.
const NAMES: [usize; 4] = [0, 24, 160, 168];
/// Nanoseconds in a second.
const NANO: f64 = 1e9;
/// Nanoseconds in a millisecond.
const MILLION: i32 = 1_000_000;

/// The file of one trace. Samples are in m/s, and the type of the dependent variable is "unknown", since the format has velocities in
/// nm/s. The reference time is time zero to the millisecond.
#[must_use]
pub fn sac(trace: &Trace) -> Vec<u8> {
    let samples: Vec<f32> = trace.samples.iter().map(|v| *v as f32).collect();
    let mut out = Vec::with_capacity(4 * (WORDS.0 + WORDS.1) + CHARACTERS + 4 * samples.len());
    floats(trace, &samples).iter().for_each(|word| out.extend(word.to_le_bytes()));
    integers(trace).iter().for_each(|word| out.extend(word.to_le_bytes()));
    out.extend(characters(trace));
    samples.iter().for_each(|value| out.extend(value.to_le_bytes()));
    out
}

fn floats(trace: &Trace, samples: &[f32]) -> [f32; WORDS.0] {
    let mut words = [ABSENT.0; WORDS.0];
    // The remainder of the reference time below a millisecond.
    let below = f64::from(trace.epoch.subsec_nanosecond().rem_euclid(MILLION)) / NANO;
    let last = samples.len().saturating_sub(1) as f64;
    words[0] = trace.interval as f32;
    words[1] = samples.iter().copied().fold(f32::INFINITY, f32::min);
    words[2] = samples.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    words[5] = (below + trace.start) as f32;
    words[6] = (below + trace.start + last * trace.interval) as f32;
    words[7] = below as f32;
    words[56] = (samples.iter().map(|v| f64::from(*v)).sum::<f64>() / (last + 1.0)) as f32;
    words
}

fn integers(trace: &Trace) -> [i32; WORDS.1] {
    let time = trace.epoch.to_zoned(TimeZone::UTC);
    let mut words = [ABSENT.1; WORDS.1];
    words[0] = i32::from(time.year());
    words[1] = i32::from(time.day_of_year());
    words[2] = i32::from(time.hour());
    words[3] = i32::from(time.minute());
    words[4] = i32::from(time.second());
    words[5] = time.subsec_nanosecond() / MILLION;
    words[6] = VERSION;
    words[9] = trace.samples.len() as i32;
    for (word, code) in CODES {
        words[word] = code;
    }
    // Equal spacing; polarity; may be overwritten; distances are not computed from coordinates; unused.
    words[35..].copy_from_slice(&[1, 1, 1, 0, 0]);
    words
}

fn characters(trace: &Trace) -> [u8; CHARACTERS] {
    let mut text = [b' '; CHARACTERS];
    for (k, byte) in text.iter_mut().enumerate() {
        // The name of the event, of sixteen characters, is absent with its first eight.
        let at = if (16..24).contains(&k) { 7 } else { k % 8 };
        *byte = ABSENT.2.as_bytes()[at];
    }
    let names = [trace.station.as_str(), "", &trace.channel, &trace.network];
    for (at, name) in NAMES.into_iter().zip(names) {
        let padded = format!("{name:<8}");
        text[at..at + 8].copy_from_slice(&padded.as_bytes()[..8]);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_has_the_words_of_the_format() {
        let trace = Trace {
            network: "AS".into(),
            station: "ST01".into(),
            channel: "HXX".into(),
            epoch: "2000-02-29T12:34:56.7895Z".parse().unwrap(),
            start: 0.25,
            interval: 0.5,
            samples: vec![1.0, -2.0, 4.0],
        };
        let file = sac(&trace);
        assert_eq!(file.len(), 632 + 12);
        let float = |k: usize| f32::from_le_bytes(file[4 * k..4 * k + 4].try_into().unwrap());
        let int = |k: usize| i32::from_le_bytes(file[4 * k..4 * k + 4].try_into().unwrap());
        assert_eq!([0, 1, 2, 5, 6, 7, 56].map(float), [0.5, -2.0, 4.0, 0.2505, 1.2505, 5e-4, 1.0]);
        assert_eq!([70, 71, 72, 73, 74, 75, 76, 79].map(int), [2000, 60, 12, 34, 56, 789, 6, 3]);
        assert_eq!([85, 86, 87, 105].map(int), [1, 5, 11, 1]);
        assert_eq!(&file[440..464], b"ST01    -12345          ");
        assert_eq!((&file[600..616], &file[464..480]), (&b"HXX     AS      "[..], &b"        -12345  "[..]));
        assert_eq!(file[632..636], 1.0_f32.to_le_bytes());
    }
}
