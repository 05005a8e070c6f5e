//! Times of the rows of an output file. A row is due after a change of slip rate, after some slip, and after a longest time, so that the size of a
//! file depends on events and not on the number of steps. A row is also written at each extremum of the slip rate, so that no peak falls between two
//! rows.
//!
//! Once a file reaches half of its largest size, these limits double; at three quarters they double again, and so on. The file therefore never
//! exceeds its largest size and still covers a long time.

use super::words::YEAR;
use crate::warning::Warning;
use serde::{Deserialize, Serialize};

/// Default change of log10 of the slip rate from row to row.
const DECADES: f64 = 0.125;
/// Change of log10 of the largest slip rate from one profile of rates to the next.
pub(super) const RATE_CHANGE: f64 = 0.5;
/// Default slip from row to row over the smallest characteristic slip of the fault, which is the slip over which the state evolves. In BP1 this is 4
/// mm, or a tenth of a second at 4 cm/s.
const SLIP: f64 = 0.5;
/// Default longest time between rows \[s\]: the cadence that the benchmarks request between events.
const LONGEST: f64 = 0.1 * YEAR;
/// Default least time between rows due to slip alone \[s\]: the cadence that the benchmarks request in events.
const SHORTEST: f64 = 0.1;
/// Default time between profiles of slip between events \[s\].
const BETWEEN: f64 = 5.0 * YEAR;
/// Default slip between two profiles in an event, at the slip rate that begins it \[m\]: one second at 1 mm/s.
const PROFILE_SLIP: f64 = 1e-3;
/// Least number of rows of a run; it shortens the longest time between rows in a short run.
const LEAST_ROWS: f64 = 500.0;
/// Least number of profiles of a run; see [`LEAST_ROWS`].
const LEAST_PROFILES: f64 = 100.0;
/// Default largest size of a file \[bytes\].
const LARGEST_FILE: f64 = 100e6;
/// An extremum gets a row if log10 of its slip rate differs by this much from the row before. The error of a peak in a file is at most half a per
/// cent.
const EXTREMUM: f64 = 2e-3;
/// Least slip rate that is distinguished \[m/s\]; the benchmarks in 3D treat it as zero.
pub(crate) const NO_RATE: f64 = 1e-20;
/// Largest number of doublings, after which a file counts as full; no file has so many rows.
const MOST_DOUBLINGS: u32 = 60;

/// Limits after which rows are due.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cadence {
    /// Change of log10 of the slip rate.
    pub decades: f64,
    /// Slip \[m\]; infinite if none is given and no law has a characteristic slip.
    pub slip: f64,
    /// Longest time \[s\].
    pub longest: f64,
    /// Least time between rows due to slip alone \[s\].
    pub shortest: f64,
    /// Times between profiles of slip, between and during events \[s\].
    pub contours: [f64; 2],
    /// Largest size of a file \[bytes\].
    pub largest_file: u64,
}

/// Limits given in the scene; the others have defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Asked {
    /// Change of log10 of the slip rate; see [`Cadence`].
    pub decades: Option<f64>,
    /// Slip \[m\].
    pub slip: Option<f64>,
    /// Longest time \[s\].
    pub longest: Option<f64>,
    /// Least time between rows due to slip alone \[s\].
    pub shortest: Option<f64>,
    /// Times between profiles of slip \[s\].
    pub contours: Option<[f64; 2]>,
    /// Largest size of a file \[bytes\].
    pub largest_file: Option<f64>,
}

impl Cadence {
    /// Limits for a run of duration `end` \[s\] whose events begin at the slip rate `on` \[m/s\]; `length` is the smallest characteristic slip \[m\].
    pub(super) fn new(asked: Asked, end: f64, on: f64, length: Option<f64>) -> Self {
        let between = BETWEEN.min(end / LEAST_PROFILES);
        Self {
            decades: asked.decades.unwrap_or(DECADES),
            slip: asked.slip.or(length.map(|l| SLIP * l)).unwrap_or(f64::INFINITY),
            longest: asked.longest.unwrap_or(LONGEST.min(end / LEAST_ROWS)),
            shortest: asked.shortest.unwrap_or(SHORTEST.min(end / LEAST_ROWS)),
            contours: asked.contours.unwrap_or([between, (PROFILE_SLIP / on).min(between)]),
            largest_file: asked.largest_file.unwrap_or(LARGEST_FILE) as u64,
        }
    }

    /// Description of the limits.
    pub(super) fn words(&self) -> String {
        let slip =
            if self.slip.is_finite() { format!(", after slip of {:e} m", self.slip) } else { String::new() };
        let [between, within] = self.contours.map(time);
        format!(
            "rows where the slip rate changes by {} decades or turns{slip}, and every {}; profiles every {between}, in events every {within}",
            self.decades,
            time(self.longest)
        )
    }
}

/// Time in a suitable unit, with at most three decimals.
pub(super) fn time(seconds: f64) -> String {
    let units =
        [("yr", YEAR, 0.1 * YEAR), ("d", 86_400.0, 86_400.0), ("h", 3600.0, 3600.0), ("min", 60.0, 60.0)];
    let fitting = units.into_iter().find(|(_, _, from)| seconds >= *from);
    let (name, unit) = fitting.map_or(("s", 1.0), |(name, unit, _)| (name, unit));
    let value = seconds / unit;
    let text = if (1e-3..1e4).contains(&value) { format!("{value:.3}") } else { format!("{value:.3e}") };
    let digits = match text.split_once('e') {
        None => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        Some(_) => text,
    };
    format!("{digits} {name}")
}

/// A slip rate at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Reading {
    /// Time \[s\].
    pub time: f64,
    /// Slip rate \[m/s\].
    pub rate: f64,
}

impl Reading {
    /// Decades between two slip rates.
    fn decades(&self, other: &Self) -> f64 {
        (self.rate.max(NO_RATE) / other.rate.max(NO_RATE)).log10().abs()
    }
}

/// Rows that are due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Due {
    /// A row for the previous step, where the rate had an extremum.
    pub before: bool,
    /// A row for this step.
    pub now: bool,
}

/// Fill level of a file, and the last values written to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Gauge {
    /// Size \[bytes\].
    pub bytes: u64,
    /// Number of doublings of the limits.
    pub doublings: u32,
    /// Time of the first doubling \[s\].
    pub coarse_since: Option<f64>,
    /// True if there is no room for another row.
    pub full: bool,
    /// Reading at the last row.
    last: Option<Reading>,
    /// Reading at the last step.
    before: Option<Reading>,
    /// True if the rate increased in the last step.
    rising: Option<bool>,
    /// Slip since the last row \[m\].
    slipped: f64,
}

impl Gauge {
    /// Gauge of a file of this size without rows.
    pub fn of(bytes: u64) -> Self {
        Self { bytes, ..Self::default() }
    }

    /// Factor on the limits.
    pub fn factor(&self) -> f64 {
        2f64.powi(self.doublings as i32)
    }

    /// Rows that are due after a step.
    pub fn step(&mut self, cadence: &Cadence, now: Reading) -> Due {
        let Some((mut last, before)) = self.last.zip(self.before.replace(now)) else {
            (self.last, self.before) = (Some(now), Some(now));
            return Due { before: false, now: !self.full };
        };
        let factor = self.factor();
        let rising = if now.rate == before.rate { self.rising } else { Some(now.rate > before.rate) };
        let turned = self.rising.is_some() && rising != self.rising;
        self.rising = rising;
        let slip = 0.5 * (before.rate + now.rate) * (now.time - before.time);
        self.slipped += slip;
        let extremum = turned && before.time > last.time && before.decades(&last) >= EXTREMUM * factor;
        if extremum {
            (last, self.slipped) = (before, slip);
        }
        let waited = now.time - last.time;
        let due = now.decades(&last) >= factor * cadence.decades
            || waited >= factor * cadence.longest
            || (self.slipped >= factor * cadence.slip && waited >= factor * cadence.shortest);
        if due {
            (last, self.slipped) = (now, 0.0);
        }
        self.last = Some(last);
        Due { before: extremum && !self.full, now: due && !self.full }
    }

    /// True if a profile is due after a step: after `interval` \[s\], or if the rate has changed by `decades`.
    pub fn profile(&mut self, now: Reading, interval: f64, decades: f64) -> bool {
        let factor = self.factor();
        let due = self.last.is_none_or(|last| {
            now.time - last.time >= factor * interval || now.decades(&last) >= factor * decades
        });
        if due {
            self.last = Some(now);
        }
        due && !self.full
    }

    /// Accounts for a row of `row` bytes, written at `time` \[s\] to a file of at most `most` bytes.
    pub fn spend(&mut self, row: u64, most: u64, time: f64) {
        self.bytes += row;
        while self.doublings < MOST_DOUBLINGS && self.bytes >= most - (most >> (self.doublings + 1)) {
            self.doublings += 1;
            self.coarse_since.get_or_insert(time);
        }
        self.full = self.bytes + row > most;
    }
}

/// Warning about files that have exceeded half of their largest size.
pub(super) fn warning(files: &[(String, Gauge)], largest: u64) -> Option<Warning> {
    let coarse = || files.iter().filter_map(|(name, g)| Some((g.coarse_since?, name, g)));
    let (since, name, _) = coarse().min_by(|a, b| a.0.total_cmp(&b.0))?;
    let most = coarse().map(|(_, _, g)| g.doublings).max().unwrap_or_default();
    let full = coarse().filter(|(_, _, g)| g.full).count();
    let ends = if full > 0 { format!("; {full} of them are full and end early") } else { String::new() };
    let message = format!(
        "output files grew beyond half of `largest_file` ({:.3} MB), {} in all, `{name}` first, at {}: their rows stand up to 2^{most} times \
         as far apart since then{ends}",
        largest as f64 / 1e6,
        coarse().count(),
        time(since)
    );
    Some(Warning::at(
        0..0,
        message,
        "raise `largest_file` in `[output]`, or the amounts in its `cadence` and `contours`",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CADENCE: Cadence = Cadence {
        decades: 0.125,
        slip: 4e-3,
        longest: 1e6,
        shortest: 0.1,
        contours: [1e8, 1.0],
        largest_file: 1_000_000,
    };

    /// Rows that are due over the steps of a history, with their rates.
    fn rows(history: &[(f64, f64)], gauge: &mut Gauge, bytes: u64) -> Vec<(f64, f64)> {
        let (mut rows, mut before) = (Vec::new(), (f64::NAN, f64::NAN));
        for &(time, rate) in history {
            let due = gauge.step(&CADENCE, Reading { time, rate });
            for (due, row) in [(due.before, before), (due.now, (time, rate))] {
                if due {
                    rows.push(row);
                    gauge.spend(bytes, CADENCE.largest_file, time);
                }
            }
            before = (time, rate);
        }
        rows
    }

    #[test]
    fn the_peak_of_a_short_event_has_a_row() {
        // A bump of a tenth of a decade, too small for a row by itself, with a pulse of one step on top.
        let history: Vec<(f64, f64)> = (0..1000)
            .map(|k| (f64::from(k) * 1e-4, 1e-9 * (1.0 + 0.2 * (-(f64::from(k - 500) / 50.0).powi(2)).exp())))
            .collect();
        let found = rows(&history, &mut Gauge::default(), 1);
        let peak = history.iter().map(|r| r.1).fold(0.0, f64::max);
        assert!(found.iter().any(|r| r.1 == peak), "{found:?}");
        assert!(found.len() < 5, "{found:?}");
        assert!(found.windows(2).all(|w| w[0].0 < w[1].0));
    }

    #[test]
    fn rows_follow_change_and_slip_and_not_steps() {
        let steps = |n: u32| -> Vec<(f64, f64)> {
            // 1e8 s at 1e-9 m/s, then 100 s at 0.1 m/s.
            let slow = (0..n).map(|k| (1e8 * f64::from(k) / f64::from(n), 1e-9));
            slow.chain((0..n).map(|k| (1e8 + 100.0 * f64::from(k) / f64::from(n), 0.1))).collect()
        };
        let counts = [20_000, 40_000].map(|n| rows(&steps(n), &mut Gauge::default(), 1).len());
        // One row per million seconds, then one per tenth of a second.
        for count in counts {
            assert!((950..=1150).contains(&count), "{count}");
        }
    }

    #[test]
    fn a_file_becomes_coarser_and_never_passes_its_size() {
        let history: Vec<(f64, f64)> =
            (0..200_000).map(|k| (f64::from(k), if k % 2 == 0 { 1e-9 } else { 1e-3 })).collect();
        let mut gauge = Gauge::default();
        let found = rows(&history, &mut gauge, 100);
        assert!(gauge.bytes <= CADENCE.largest_file && gauge.doublings > 2, "{gauge:?}");
        assert_eq!(gauge.bytes, 100 * found.len() as u64);
        let warning = warning(&[("a".into(), gauge)], CADENCE.largest_file).unwrap();
        assert!(warning.message.contains("`a` first"), "{warning}");
        assert!(super::warning(&[("a".into(), Gauge::default())], 1).is_none());
    }

    #[test]
    fn slow_slip_makes_profiles_as_far_apart_as_its_slip() {
        let of = |on: f64| Cadence::new(Asked::default(), 3000.0 * YEAR, on, Some(8e-3));
        assert_eq!(of(1e-3).contours, [5.0 * YEAR, 1.0]);
        assert!((of(1e-8).contours[1] - 1e5).abs() < 1e-3);
        assert_eq!(of(1e-3).contours.map(time), ["5 yr", "1 s"]);
        assert_eq!(
            [1e5, 0.1, 0.1 * YEAR, 2e-6, 90.0].map(time),
            ["1.157 d", "0.1 s", "0.1 yr", "2.000e-6 s", "1.5 min"]
        );
        assert_eq!(of(1e-3).slip, 4e-3);
        assert_eq!((of(1e-3).longest, of(1e-3).shortest), (0.1 * YEAR, 0.1));
    }
}
