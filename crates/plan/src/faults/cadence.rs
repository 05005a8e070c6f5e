//! Times of the rows of an output file. A row is due after a change of slip rate, after some slip, and after a longest time, so that the size of a
//! file depends on events and not on the number of steps. A row is also written at each extremum of the slip rate, so that no peak falls between two
//! rows. In an event each maximum above all rows of the event so far has a row, however small the rise, so that the largest slip rate of its rows is
//! that of the catalogue.
//!
//! Once a file reaches half of its largest size, these limits double; at three quarters they double again, and so on. The file therefore never
//! exceeds its largest size and still covers a long time.

use crate::shared::words::YEAR;
use asperity_run::Warning;
use asperity_scene::defaults;
use serde::{Deserialize, Serialize};

/// Change of log10 of the largest slip rate from one profile of rates to the next.
pub const RATE_CHANGE: f64 = 0.5;
/// Default time between profiles of slip between events \[s\].
const BETWEEN: f64 = 5.0 * YEAR;
/// Default slip between two profiles in an event, at the slip rate that begins it \[m\]: one second at 1 mm/s.
const PROFILE_SLIP: f64 = 1e-3;
/// Least number of rows of a run; it shortens the longest time between rows in a short run.
const LEAST_ROWS: f64 = 500.0;
/// Least number of profiles of a run; see [`LEAST_ROWS`].
const LEAST_PROFILES: f64 = 100.0;
/// An extremum gets a row if log10 of its slip rate differs by this much from the row before. The error of a peak in a file is at most half a per
/// cent.
const EXTREMUM: f64 = 2e-3;
/// Least slip rate that is distinguished \[m/s\].
pub const NO_RATE: f64 = asperity_output::formats::seas::LEAST_RATE;
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
    /// Slip rate at which an event begins \[m/s\].
    pub fast: f64,
    /// Largest size of a file \[bytes\].
    pub largest_file: u64,
}

/// Limits given in the scene; the others have defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CadenceLimits {
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
    pub fn new(asked: CadenceLimits, end: f64, on: f64, length: Option<f64>) -> Self {
        let between = BETWEEN.min(end / LEAST_PROFILES);
        Self {
            decades: asked.decades.unwrap_or(defaults::DECADES),
            slip: asked.slip.or(length.map(|l| defaults::CADENCE_SLIP * l)).unwrap_or(f64::INFINITY),
            longest: asked.longest.unwrap_or(defaults::LONGEST.min(end / LEAST_ROWS)),
            shortest: asked.shortest.unwrap_or(defaults::SHORTEST.min(end / LEAST_ROWS)),
            contours: asked.contours.unwrap_or([between, (PROFILE_SLIP / on).min(between)]),
            fast: on,
            largest_file: asked.largest_file.unwrap_or(defaults::LARGEST_FILE) as u64,
        }
    }

    /// Description of the limits.
    pub fn words(&self) -> String {
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

/// log10 of a slip rate as files give it: of the least rate for a point at rest.
pub fn log_rate(rate: f64) -> f64 {
    rate.abs().max(NO_RATE).log10()
}

/// Time in a suitable unit, with at most three decimals.
pub fn time(seconds: f64) -> String {
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
pub struct Reading {
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
pub struct Due {
    /// A row for the previous step, where the rate had an extremum.
    pub before: bool,
    /// A row for this step.
    pub now: bool,
}

/// Fill level of a file, and the last values written to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Gauge {
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
    /// Largest slip rate of a row since the rate was last too low for an event \[m/s\].
    highest: f64,
}

impl Gauge {
    /// Gauge of a file of this size without rows.
    pub fn from_size(bytes: u64) -> Self {
        Self { bytes, ..Self::default() }
    }

    /// Factor on the limits.
    pub fn factor(&self) -> f64 {
        2f64.powi(self.doublings as i32)
    }

    /// Rows that are due after a step.
    pub fn step(&mut self, cadence: &Cadence, now: Reading) -> Due {
        let Some((mut last, before)) = self.last.zip(self.before.replace(now)) else {
            (self.last, self.before, self.highest) = (Some(now), Some(now), now.rate);
            return Due { before: false, now: !self.full };
        };
        let factor = self.factor();
        let rising = if now.rate == before.rate { self.rising } else { Some(now.rate > before.rate) };
        let turned = self.rising.is_some() && rising != self.rising;
        let record = self.rising == Some(true) && before.rate >= cadence.fast && before.rate > self.highest;
        self.rising = rising;
        let slip = 0.5 * (before.rate + now.rate) * (now.time - before.time);
        self.slipped += slip;
        let apart = record || before.decades(&last) >= EXTREMUM * factor;
        let extremum = turned && before.time > last.time && apart;
        if extremum {
            (last, self.slipped) = (before, slip);
            self.highest = self.highest.max(before.rate);
        }
        let waited = now.time - last.time;
        let due = now.decades(&last) >= factor * cadence.decades
            || waited >= factor * cadence.longest
            || (self.slipped >= factor * cadence.slip && waited >= factor * cadence.shortest);
        if due {
            (last, self.slipped) = (now, 0.0);
            self.highest = self.highest.max(now.rate);
        }
        if now.rate < cadence.fast {
            self.highest = 0.0;
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

/// A file with its gauge.
#[derive(Clone, Debug)]
pub struct GaugedFile {
    /// Name of the file.
    pub name: String,
    /// Its bytes and the distance of its rows.
    pub gauge: Gauge,
}

/// Warning about files that have exceeded half of their largest size.
pub fn warning(files: &[GaugedFile], largest: u64) -> Option<Warning> {
    let coarse =
        || files.iter().filter_map(|GaugedFile { name, gauge }| Some((gauge.coarse_since?, name, gauge)));
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
