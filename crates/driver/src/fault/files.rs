//! Output files of a run: stations, the largest slip rate, and profiles of slip and of slip rates, or in space snapshots.
//!
//! Rows come by change and by simulated time, not by step, so that files grow with what happens.

use super::checkpoint::{Checkpoint, ResumeError};
use super::plan::Plan;
use super::run::{Moment, Watcher};
use super::snapshots::{self, Snapshots, Taken};
use super::stations;
use crate::observe::{ObserveError, atomic};
use crate::ode::Control;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A year \[s\], as the benchmarks count it.
pub(super) const YEAR: f64 = 365.25 * 86_400.0;
/// Time between rows of stations while nothing is fast, and in an event \[s\]: the cadence the benchmarks ask for.
const STATION_INTERVALS: [f64; 2] = [0.1 * YEAR, 0.1];
/// Time between profiles of slip while nothing is fast, and in an event \[s\].
pub(super) const PROFILE_INTERVALS: [f64; 2] = [5.0 * YEAR, 1.0];
/// A profile of rates is written where ln of the largest slip rate has changed by so much: half a decade.
pub(super) const RATE_CHANGE: f64 = 1.15;
/// Rows and profiles of a run at least, where those intervals are long beside it.
const LEAST_ROWS: f64 = 500.0;
pub(super) const LEAST_PROFILES: f64 = 100.0;
/// A row is written where ln of the largest slip rate has changed by so much: an eighth of a decade.
const CHANGE: f64 = 0.3;

/// Columns of the largest slip rate; means are weighted with areas, and along the rake where slip may turn.
const LARGEST_HEAD: &str = "time [s],log10 slip_rate [m/s],point,mean shear_traction [Pa],mean slip [m]\n";

/// A file that grows by whole rows.
#[derive(Debug)]
struct Rows {
    path: PathBuf,
    file: fs::File,
    length: u64,
}

impl Rows {
    fn create(path: PathBuf, head: &str) -> Result<Self, ObserveError> {
        atomic::write(&path, head.as_bytes())?;
        let file = fs::OpenOptions::new().append(true).open(&path);
        let file = file.map_err(|source| ObserveError::write(&path, source))?;
        Ok(Self { path, file, length: head.len() as u64 })
    }

    /// Goes on with a file that had so many bytes; later ones are cut off.
    fn reopen(path: PathBuf, expected: u64) -> Result<Self, ResumeError> {
        let file = fs::OpenOptions::new().append(true).open(&path);
        let found = file.and_then(|file| Ok((file.metadata()?.len(), file)));
        let (found, file) = found.map_err(|source| ResumeError::Read { path: path.clone(), source })?;
        if found < expected {
            return Err(ResumeError::Shorter { path, found, expected });
        }
        file.set_len(expected).map_err(|source| ObserveError::write(&path, source))?;
        Ok(Self { path, file, length: expected })
    }

    /// One write for a row: a run that is killed leaves whole rows.
    fn push(&mut self, row: &str) -> Result<(), ObserveError> {
        self.length += row.len() as u64;
        self.file.write_all(row.as_bytes()).map_err(|source| ObserveError::write(&self.path, source))
    }

    /// Waits until the rows are on the disc.
    fn settle(&self) -> Result<(), ObserveError> {
        self.file.sync_data().map_err(|source| ObserveError::write(&self.path, source))
    }
}

/// When something was written last.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Last {
    pub time: f64,
    /// Largest slip rate then \[m/s\].
    pub largest: f64,
}

/// Where the files of a run stand.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Bytes of the files, in their order.
    lengths: Vec<u64>,
    row: Option<Last>,
    profile: Option<f64>,
    rates: Option<Last>,
    /// In space.
    #[serde(default)]
    snapshots: Option<Taken>,
}

/// Writes `stations/`, `largest_rate.csv` and, in the plane, `slip_profiles.csv` and `rate_profiles.csv` (log10 of m/s), in space
/// snapshots.
#[derive(Debug)]
pub struct Files<'a> {
    plan: &'a Plan,
    /// The largest slip rate, profiles of slip and of slip rates or the list of snapshots, then stations.
    rows: Vec<Rows>,
    /// Points of the stations.
    stations: Vec<usize>,
    row: Option<Last>,
    profile: Option<f64>,
    rates: Option<Last>,
    snapshots: Option<Snapshots>,
    failure: Option<ObserveError>,
}

impl<'a> Files<'a> {
    /// Makes the files with their headers in `out`.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn create(out: &Path, plan: &'a Plan) -> Result<Self, ObserveError> {
        atomic::writable_dir(out)?;
        atomic::create_dir(&out.join("stations"))?;
        let mut rows = Vec::new();
        for (path, head) in Self::heads(out, plan) {
            rows.push(Rows::create(path, &head)?);
        }
        Ok(Self {
            plan,
            rows,
            stations: stations::points(plan),
            row: None,
            profile: None,
            rates: None,
            snapshots: Snapshots::begin(out, plan)?,
            failure: None,
        })
    }

    /// Goes on with the files in `out` from where they stood; what was written after that is cut off.
    ///
    /// # Errors
    /// When a file is missing, shorter than it was, or cannot be written.
    pub fn resume(out: &Path, plan: &'a Plan, from: &Position) -> Result<Self, ResumeError> {
        let (mut rows, heads) = (Vec::new(), Self::heads(out, plan));
        if heads.len() != from.lengths.len() {
            return Err(Checkpoint::foreign(out, "it has not the output files of this scene"));
        }
        for ((path, _), &length) in heads.into_iter().zip(&from.lengths) {
            rows.push(Rows::reopen(path, length)?);
        }
        let Position { row, profile, rates, snapshots, .. } = *from;
        let snapshots = Snapshots::begin(out, plan)?.map(|s| s.from(snapshots.unwrap_or_default()));
        Ok(Self {
            plan,
            rows,
            stations: stations::points(plan),
            row,
            profile,
            rates,
            snapshots,
            failure: None,
        })
    }

    /// Where the files stand, once all of that is on the disc.
    ///
    /// # Errors
    /// When something could not be written.
    pub fn position(&self) -> Result<Position, ObserveError> {
        self.rows.iter().try_for_each(Rows::settle)?;
        let lengths = self.rows.iter().map(|r| r.length).collect();
        let snapshots = self.snapshots.as_ref().map(Snapshots::taken);
        Ok(Position { lengths, row: self.row, profile: self.profile, rates: self.rates, snapshots })
    }

    /// All files with their headers.
    fn heads(out: &Path, plan: &Plan) -> Vec<(PathBuf, String)> {
        let mut heads = vec![(out.join("largest_rate.csv"), LARGEST_HEAD.to_string())];
        if plan.in_space {
            heads.push((out.join(snapshots::LIST), snapshots::HEAD.to_string()));
        } else {
            let along: String = plan.points.iter().map(|p| format!(",{}", p.along)).collect();
            let head = format!("time [s]{along}\n");
            heads.push((out.join("slip_profiles.csv"), head.clone()));
            heads.push((out.join("rate_profiles.csv"), head));
        }
        let folder = out.join("stations");
        heads.extend(stations::heads(plan).into_iter().map(|(name, head)| (folder.join(name), head)));
        heads
    }

    /// The first thing that could not be written.
    pub fn failure(&mut self) -> Option<ObserveError> {
        self.failure.take()
    }

    fn write(&mut self, now: &Moment<'_>) -> Result<(), ObserveError> {
        let time = now.at.seconds();
        let fast = usize::from(now.largest >= self.plan.settings.thresholds.on);
        let end = self.plan.settings.end;
        let interval = STATION_INTERVALS[fast].min(end / LEAST_ROWS);
        let due = self.row.is_none_or(|last| {
            let change = (now.largest / last.largest).ln().abs();
            time - last.time >= interval || change >= CHANGE
        });
        if due {
            self.row = Some(Last { time, largest: now.largest });
            let points = self.plan.points.len();
            let point = (0..points).find(|&p| now.speed(p) == now.largest).unwrap_or(0);
            let (shear, slip) = means(self.plan, now);
            self.rows[0]
                .push(&format!("{time:.14e},{:.6},{point},{shear:.6e},{slip:.9e}\n", now.largest.log10()))?;
            let general = self.rows.len() - self.stations.len();
            for (point, rows) in self.stations.iter().zip(&mut self.rows[general..]) {
                rows.push(&stations::row(self.plan, now, *point))?;
            }
        }
        match &mut self.snapshots {
            Some(snapshots) => match snapshots.take(self.plan, now)? {
                Some(row) => self.rows[1].push(&row),
                None => Ok(()),
            },
            None => self.profiles(now, fast),
        }
    }

    /// Profiles of slip and of slip rates along lines.
    fn profiles(&mut self, now: &Moment<'_>, fast: usize) -> Result<(), ObserveError> {
        let (time, end) = (now.at.seconds(), self.plan.settings.end);
        let interval = PROFILE_INTERVALS[fast].min(end / LEAST_PROFILES);
        if self.profile.is_none_or(|last| time - last >= interval) {
            self.profile = Some(time);
            let mut row = format!("{time:.14e}");
            for slip in now.slip() {
                row.push_str(&format!(",{slip:.6e}"));
            }
            row.push('\n');
            self.rows[1].push(&row)?;
        }
        let due = self.rates.is_none_or(|last| {
            let change = (now.largest / last.largest).ln().abs();
            time - last.time >= PROFILE_INTERVALS[fast] || change >= RATE_CHANGE
        });
        if due {
            self.rates = Some(Last { time, largest: now.largest });
            let mut row = format!("{time:.14e}");
            for rate in now.rate {
                row.push_str(&format!(",{:.3}", rate.abs().log10()));
            }
            row.push('\n');
            self.rows[2].push(&row)?;
        }
        Ok(())
    }
}

impl Watcher for Files<'_> {
    fn now(&mut self, moment: &Moment<'_>) -> Control {
        match self.write(moment) {
            Ok(()) => Control::Go,
            Err(failure) => {
                self.failure = Some(failure);
                Control::Stop
            }
        }
    }
}

/// Means of shear traction \[Pa\] and slip \[m\] over the area, along the rake where slip may turn.
fn means(plan: &Plan, now: &Moment<'_>) -> (f64, f64) {
    let (mut area, mut shear, mut slip) = (0.0, 0.0, 0.0);
    for (p, point) in plan.points.iter().enumerate() {
        area += point.area;
        shear += point.area * now.normal(&plan.fault, p) * plan.fault.law.scale(p) * now.unknowns[p];
        slip += point.area * now.slip()[p];
    }
    (shear / area, slip / area)
}
