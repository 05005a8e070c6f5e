//! Times of the rows of an output file: by change of slip rate, by slip, and after a longest time, so that files grow with what happens and
//! not with steps; and at each extremum of the slip rate, so that no peak falls between two rows.
//!
//! A file that has grown to half of what it may is written with twice these amounts from then on, at three quarters with four times, and so
//! forth: it never passes its largest size, and goes on for long.

use super::words::YEAR;
use crate::warning::Warning;
use serde::{Deserialize, Serialize};

/// Change of log10 of the slip rate from row to row, where nothing is said.
const DECADES: f64 = 0.125;
/// A profile of rates is written where log10 of the largest slip rate has changed by so much.
pub(super) const RATE_CHANGE: f64 = 0.5;
/// Slip from row to row over the smallest characteristic slip of the fault, where nothing is said: states change over the whole of it. In BP1,
/// 4 mm in a tenth of a second at 4 cm/s.
const SLIP: f64 = 0.5;
/// Longest time between rows \[s\], where nothing is said: the cadence the benchmarks ask for while nothing is fast.
const LONGEST: f64 = 0.1 * YEAR;
/// Least time between rows for slip alone \[s\], where nothing is said: the cadence the benchmarks ask for in events.
const SHORTEST: f64 = 0.1;
/// Time between profiles of slip while nothing is fast \[s\], where nothing is said.
const BETWEEN: f64 = 5.0 * YEAR;
/// Slip over the time between two profiles in an event at the slip rate that begins it \[m\], where nothing is said: at 1 mm/s one second.
const PROFILE_SLIP: f64 = 1e-3;
/// Rows and profiles of a run at least, where those times are long beside it.
const LEAST_ROWS: f64 = 500.0;
/// See [`LEAST_ROWS`].
const LEAST_PROFILES: f64 = 100.0;
/// Largest size of a file \[bytes\], where nothing is said.
const LARGEST_FILE: f64 = 100e6;
/// An extremum makes a row where log10 of the slip rate differs by so much from the row before: what a peak in a file may lack is half a per cent.
const EXTREMUM: f64 = 2e-3;
/// Slip rate that stands for all that is slower \[m/s\]: what the benchmarks in space take for none.
pub(super) const NO_RATE: f64 = 1e-20;
/// Doublings after which a file is full in any case: no file has so many rows.
const MOST_DOUBLINGS: u32 = 60;

/// Limits that make rows due.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cadence {
    /// Change of log10 of the slip rate.
    pub decades: f64,
    /// Slip \[m\]; infinite where no law has a characteristic one and none is given.
    pub slip: f64,
    /// Longest time \[s\].
    pub longest: f64,
    /// Least time for slip alone \[s\].
    pub shortest: f64,
    /// Times between profiles of slip, between events and in them \[s\].
    pub contours: [f64; 2],
    /// Largest size of a file \[bytes\].
    pub largest_file: u64,
}

/// Requests of the scene; others have defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Asked {
    /// See [`Cadence`].
    pub decades: Option<f64>,
    /// \[m\].
    pub slip: Option<f64>,
    /// \[s\].
    pub longest: Option<f64>,
    /// \[s\].
    pub shortest: Option<f64>,
    /// \[s\].
    pub contours: Option<[f64; 2]>,
    /// \[bytes\].
    pub largest_file: Option<f64>,
}

impl Cadence {
    /// Limits for a run of this length \[s\] whose events begin at `on` \[m/s\]; `length` is the smallest characteristic slip.
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

    /// In words.
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

/// A time in the unit it reads well in, with three decimals at most.
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
    /// \[s\].
    pub time: f64,
    /// \[m/s\].
    pub rate: f64,
}

impl Reading {
    /// Decades between two rates.
    fn decades(&self, other: &Self) -> f64 {
        (self.rate.max(NO_RATE) / other.rate.max(NO_RATE)).log10().abs()
    }
}

/// Which rows are due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Due {
    /// One of the step before, where the rate turned.
    pub before: bool,
    /// One of this step.
    pub now: bool,
}

/// Position in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Gauge {
    /// Size \[bytes\].
    pub bytes: u64,
    /// Number of doublings of the amounts.
    pub doublings: u32,
    /// Time of the first one \[s\].
    pub coarse_since: Option<f64>,
    /// True if there is no room for another row.
    pub full: bool,
    /// At the last row.
    last: Option<Reading>,
    /// At the last step.
    before: Option<Reading>,
    /// True if the rate grew then.
    rising: Option<bool>,
    /// Slip since the last row \[m\].
    slipped: f64,
}

impl Gauge {
    /// Of a file that has so many bytes and no row.
    pub fn of(bytes: u64) -> Self {
        Self { bytes, ..Self::default() }
    }

    /// Factor of the amounts.
    pub fn factor(&self) -> f64 {
        2f64.powi(self.doublings as i32)
    }

    /// Which rows are due after a step.
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

    /// True if a profile is due after a step: after `interval` \[s\], or where the rate has changed by `decades`.
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

    /// A row of so many bytes has been written at `time` \[s\] to a file of so many bytes at most.
    pub fn spend(&mut self, row: u64, most: u64, time: f64) {
        self.bytes += row;
        while self.doublings < MOST_DOUBLINGS && self.bytes >= most - (most >> (self.doublings + 1)) {
            self.doublings += 1;
            self.coarse_since.get_or_insert(time);
        }
        self.full = self.bytes + row > most;
    }
}

/// Warning about files that have grown beyond half of their largest size.
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

    /// Rows over steps of a history, with the rates they have.
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
        // A bump of a tenth of a decade, below what makes a row by itself, and a pulse of one step on top.
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
        // A row in a million seconds, then one in a tenth of a second.
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
