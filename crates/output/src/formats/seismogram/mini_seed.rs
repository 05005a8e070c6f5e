//! Version 2 of miniSEED (SEED 2.4 of the FDSN, chapter 8): records of 4096 bytes, big-endian, with samples as 64-bit floats.
//!
//! Blockettes 1000 (encoding), 100 (exact sampling rate) and 1001 (microseconds of the start) follow the fixed header.

use super::trace::Trace;
use jiff::tz::TimeZone;
use jiff::{SignedDuration, Zoned};

/// Shortest interval at which the microseconds of a record's start still tell two samples apart \[s\]: a microsecond, to the
/// rounding of an interval that is a multiple of a step.
pub const SHORTEST: f64 = 1e-6 * (1.0 - 1e-9);

/// Bytes of a record.
const RECORD: usize = 4096;
/// Decadic exponent of two of the bytes of a record.
const EXPONENT: u8 = 12;
/// Bytes before the samples of a record: the fixed header and its blockettes, rounded up to multiples of 64.
const BEFORE: usize = 128;
/// Samples in a full record.
const SAMPLES: usize = (RECORD - BEFORE) / 8;
/// Code of 64-bit floats.
const DOUBLES: u8 = 5;
/// Positions of the blockettes.
const BLOCKETTES: [u16; 3] = [48, 56, 68];
/// Nanoseconds in a tenth of a millisecond, the unit of the fixed header.
const TENTH: i64 = 100_000;
/// Records after which their numbers of six digits begin again.
const NUMBERS: usize = 1_000_000;

/// The file with these traces one after another.
///
/// # Errors
/// If a time lies outside the calendar.
pub fn mini_seed(traces: &[Trace]) -> Result<Vec<u8>, jiff::Error> {
    let (mut file, mut number) = (Vec::new(), 1);
    for trace in traces {
        for (k, samples) in trace.samples.chunks(SAMPLES).enumerate() {
            file.extend(record(trace, k * SAMPLES, samples, number)?);
            number = number % (NUMBERS - 1) + 1;
        }
    }
    Ok(file)
}

/// Start of a record: the calendar time to a tenth of a millisecond, and the microseconds beyond it.
fn start(trace: &Trace, first: usize) -> Result<(Zoned, u16, i8), jiff::Error> {
    let micro = (trace.nanoseconds(first) as f64 / 1e3).round() as i64;
    let time = trace.epoch.checked_add(SignedDuration::from_micros(micro))?.to_zoned(TimeZone::UTC);
    let fraction = i64::from(time.subsec_nanosecond());
    Ok((time, (fraction / TENTH) as u16, (fraction % TENTH / 1000) as i8))
}

fn record(trace: &Trace, first: usize, samples: &[f64], number: usize) -> Result<Vec<u8>, jiff::Error> {
    let (time, tenths, micro) = start(trace, first)?;
    let (factor, multiplier) = rate(trace.interval);
    let mut out = Vec::with_capacity(RECORD);
    out.extend(format!("{number:06}D ").bytes());
    for (text, width) in [(trace.station.as_str(), 5), ("", 2), (&trace.channel, 3), (&trace.network, 2)] {
        out.extend(format!("{text:<width$}").bytes().take(width));
    }
    out.extend((time.year() as u16).to_be_bytes());
    out.extend((time.day_of_year() as u16).to_be_bytes());
    out.extend([time.hour() as u8, time.minute() as u8, time.second() as u8, 0]);
    out.extend(tenths.to_be_bytes());
    out.extend((samples.len() as u16).to_be_bytes());
    out.extend(factor.to_be_bytes());
    out.extend(multiplier.to_be_bytes());
    // Flags of activity, input and quality; number of blockettes; time correction.
    out.extend([0, 0, 0, BLOCKETTES.len() as u8, 0, 0, 0, 0]);
    out.extend((BEFORE as u16).to_be_bytes());
    out.extend(BLOCKETTES[0].to_be_bytes());
    out.extend(blockette(1000, BLOCKETTES[1]));
    out.extend([DOUBLES, 1, EXPONENT, 0]);
    out.extend(blockette(100, BLOCKETTES[2]));
    out.extend(((1.0 / trace.interval) as f32).to_be_bytes());
    out.extend([0; 4]);
    out.extend(blockette(1001, 0));
    out.extend([0, micro as u8, 0, 0]);
    out.resize(BEFORE, 0);
    samples.iter().for_each(|value| out.extend(value.to_be_bytes()));
    out.resize(RECORD, 0);
    Ok(out)
}

/// Type of a blockette and position of the next.
fn blockette(kind: u16, next: u16) -> [u8; 4] {
    let ([a, b], [c, d]) = (kind.to_be_bytes(), next.to_be_bytes());
    [a, b, c, d]
}

/// Largest factor of a sampling rate.
const MOST: f64 = 32_767.0;

/// Factor and multiplier whose product, or quotient for a negative multiplier, is the sampling rate: the last convergent of its
/// continued fraction whose parts fit.
fn rate(interval: f64) -> (i16, i16) {
    let rate = 1.0 / interval;
    if rate > MOST {
        let multiplier = (rate / MOST).ceil();
        return ((rate / multiplier).round() as i16, multiplier as i16);
    }
    let (mut before, mut last, mut rest) = ((0.0, 1.0), (1.0, 0.0), rate);
    loop {
        let whole = rest.floor();
        let next = (whole * last.0 + before.0, whole * last.1 + before.1);
        if next.0 > MOST || next.1 > MOST {
            break;
        }
        (before, last) = (last, next);
        let part = rest - whole;
        if part * last.1 <= f64::EPSILON * rate * MOST || part == 0.0 {
            break;
        }
        rest = 1.0 / part;
    }
    if last.0 == 0.0 {
        // Slower than one sample per longest period; the exact rate is in blockette 100.
        return (1, -(MOST as i16));
    }
    (last.0 as i16, if last.1 > 1.0 { -(last.1 as i16) } else { 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trace(count: usize, interval: f64) -> Trace {
        Trace {
            network: "AS".into(),
            station: "ST01".into(),
            channel: "HXX".into(),
            epoch: "2000-02-29T12:34:56.789Z".parse().unwrap(),
            start: 0.000_123,
            interval,
            samples: (0..count).map(|k| (k as f64).sin()).collect(),
        }
    }

    #[test]
    fn a_record_has_the_bytes_of_the_standard() {
        let file = mini_seed(&[trace(3, 0.01)]).unwrap();
        assert_eq!(file.len(), 4096);
        assert_eq!(&file[..20], b"000001D ST01   HXXAS");
        // 2000, day 60, 12:34:56.7891 and 23 microseconds.
        assert_eq!(file[20..30], [7, 208, 0, 60, 12, 34, 56, 0, 0x1e, 0xd3]);
        assert_eq!(file[73], 23);
        assert_eq!((&file[30..32], &file[32..36]), (&[0, 3][..], &[0, 100, 0, 1][..]));
        assert_eq!((file[52], file[53], file[54]), (5, 1, 12));
        assert_eq!(file[60..64], 100.0_f32.to_be_bytes());
        assert_eq!(file[136..144], 1.0_f64.sin().to_be_bytes());
        assert_eq!(&file[152..], &[0; 4096 - 152]);
    }

    #[test]
    fn long_traces_continue_in_further_records_with_times_of_their_own() {
        let file = mini_seed(&[trace(1000, 0.01), trace(10, 0.01)]).unwrap();
        assert_eq!(file.len(), 4 * 4096);
        let counts: Vec<u16> =
            file.chunks(4096).map(|r| u16::from_be_bytes(r[30..32].try_into().unwrap())).collect();
        assert_eq!(counts, [496, 496, 8, 10]);
        let second = |record: &[u8]| record[26];
        assert_eq!(file.chunks(4096).map(second).collect::<Vec<_>>(), [56, 1, 6, 56]);
    }

    #[test]
    fn the_rate_is_a_fraction_of_whole_numbers() {
        assert_eq!(rate(0.01), (100, 1));
        assert_eq!(rate(0.3), (10, -3));
        assert_eq!(rate(7.0), (1, -7));
        assert_eq!(rate(1.0 / 1024.0), (1024, 1));
        assert_eq!(rate(1e-6), (32258, 31));
        assert_eq!(rate(1e9), (1, -32767));
        for interval in [0.007_312_3, std::f64::consts::PI, 1.0 / 32_766.9] {
            let (factor, multiplier) = rate(interval);
            let found = f64::from(factor) * f64::from(multiplier.max(1)) / f64::from((-multiplier).max(1));
            assert!((found * interval - 1.0).abs() < 1e-4, "{interval}: {factor} {multiplier}");
        }
    }
}
