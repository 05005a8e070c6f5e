//! Output files of a run: stations in the format of the SEAS community, the largest slip rate, and profiles of slip and of
//! slip rates.
//!
//! Rows come by change and by simulated time, not by step, so that files grow with what happens.

use super::checkpoint::{Checkpoint, ResumeError};
use super::plan::Plan;
use super::run::{Moment, Watcher};
use crate::observe::{ObserveError, atomic};
use crate::ode::Control;
use crate::scene::model::Station;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A year \[s\], as the benchmarks count it.
const YEAR: f64 = 365.25 * 86_400.0;
/// Time between rows of stations while nothing is fast, and in an event \[s\]: the cadence the benchmarks ask for.
const STATION_INTERVALS: [f64; 2] = [0.1 * YEAR, 0.1];
/// Time between profiles of slip while nothing is fast, and in an event \[s\].
const PROFILE_INTERVALS: [f64; 2] = [5.0 * YEAR, 1.0];
/// A profile of rates is written where ln of the largest slip rate has changed by so much: half a decade.
const RATE_CHANGE: f64 = 1.15;
/// Rows and profiles of a run at least, where those intervals are long beside it.
const LEAST_ROWS: f64 = 500.0;
const LEAST_PROFILES: f64 = 100.0;
/// A row is written where ln of the largest slip rate has changed by so much: an eighth of a decade.
const CHANGE: f64 = 0.3;

/// Columns of the largest slip rate; means are weighted with areas.
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
struct Last {
    time: f64,
    /// Largest slip rate then \[m/s\].
    largest: f64,
}

/// Where the files of a run stand.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Bytes of the files, in their order.
    lengths: Vec<u64>,
    row: Option<Last>,
    profile: Option<f64>,
    rates: Option<Last>,
}

/// Writes `stations/`, `largest_rate.csv`, `slip_profiles.csv` and `rate_profiles.csv` (log10 of m/s).
#[derive(Debug)]
pub struct Files<'a> {
    plan: &'a Plan,
    /// The largest slip rate, profiles of slip and of slip rates, then stations.
    rows: Vec<Rows>,
    /// Points of the stations.
    stations: Vec<usize>,
    row: Option<Last>,
    profile: Option<f64>,
    rates: Option<Last>,
    failure: Option<ObserveError>,
}

/// Files before those of the stations.
const GENERAL: usize = 3;

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
            stations: stations(plan),
            row: None,
            profile: None,
            rates: None,
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
        let Position { row, profile, rates, .. } = *from;
        Ok(Self { plan, rows, stations: stations(plan), row, profile, rates, failure: None })
    }

    /// Where the files stand, once all of that is on the disc.
    ///
    /// # Errors
    /// When something could not be written.
    pub fn position(&self) -> Result<Position, ObserveError> {
        self.rows.iter().try_for_each(Rows::settle)?;
        let lengths = self.rows.iter().map(|r| r.length).collect();
        Ok(Position { lengths, row: self.row, profile: self.profile, rates: self.rates })
    }

    /// All files with their headers.
    fn heads(out: &Path, plan: &Plan) -> Vec<(PathBuf, String)> {
        let mut profile_head = String::from("time [s]");
        for p in &plan.points {
            profile_head.push_str(&format!(",{}", p.along));
        }
        profile_head.push('\n');
        let mut heads = vec![
            (out.join("largest_rate.csv"), LARGEST_HEAD.to_string()),
            (out.join("slip_profiles.csv"), profile_head.clone()),
            (out.join("rate_profiles.csv"), profile_head),
        ];
        let folder = out.join("stations");
        for fault in &plan.faults {
            // Tenths of a kilometre in three digits, as the benchmarks name their stations, where that tells them apart.
            let tenths = |asked: &Station| match asked {
                Station::Along(s) => (s / 100.0).round(),
                Station::At(_) => f64::NAN,
            };
            let apart = fault.stations.windows(2).all(|w| tenths(&w[0].0) < tenths(&w[1].0));
            for (k, (asked, point)) in fault.stations.iter().enumerate() {
                let tenths = tenths(asked);
                let name = if apart && !tenths.is_nan() {
                    format!("{}_dp{tenths:03}", fault.name)
                } else {
                    format!("{}_{k:03}", fault.name)
                };
                let point = *point;
                let head = station_head(plan, &fault.name, asked, point);
                heads.push((folder.join(name), head));
            }
        }
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
            let point = now.rate.iter().position(|v| v.abs() == now.largest).unwrap_or(0);
            let (shear, slip) = means(self.plan, now);
            self.rows[0]
                .push(&format!("{time:.14e},{:.6},{point},{shear:.6e},{slip:.9e}\n", now.largest.log10()))?;
            for (point, rows) in self.stations.iter().zip(&mut self.rows[GENERAL..]) {
                rows.push(&station_row(self.plan, now, *point))?;
            }
        }
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

/// Means of shear traction \[Pa\] and slip \[m\] over the area.
fn means(plan: &Plan, now: &Moment<'_>) -> (f64, f64) {
    let (mut area, mut shear, mut slip) = (0.0, 0.0, 0.0);
    for (p, point) in plan.points.iter().enumerate() {
        area += point.area;
        shear += point.area * now.normal(&plan.fault, p) * plan.fault.law.scale(p) * now.unknowns[p];
        slip += point.area * now.slip()[p];
    }
    (shear / area, slip / area)
}

/// Points of all stations.
fn stations(plan: &Plan) -> Vec<usize> {
    plan.faults.iter().flat_map(|f| f.stations.iter().map(|s| s.1)).collect()
}

fn station_head(plan: &Plan, fault: &str, asked: &Station, point: usize) -> String {
    let view = &plan.points[point];
    let location = match asked {
        Station::Along(s) => format!("{s} m along fault {fault}, point at {:.6} m", view.along),
        Station::At(at) => format!("{at:?} m on fault {fault}, point at {:?} m", view.at),
    };
    let columns = [
        "Column #1 = Time (s)",
        "Column #2 = Slip (m)",
        "Column #3 = Slip rate (log10 m/s)",
        "Column #4 = Shear stress (MPa)",
        "Column #5 = State (log10 s)",
        "Column #6 = Normal stress (MPa)",
    ];
    let mut head = format!(
        "# problem={}\n# code=asperity\n# code_version={}\n# tributary_area={:.6e} {}\n# location= {location}\n",
        plan.title,
        env!("CARGO_PKG_VERSION"),
        view.area,
        if plan.in_space { "m2" } else { "m per m" }
    );
    for column in columns {
        head.push_str(&format!("# {column}\n"));
    }
    head.push_str("t slip slip_rate shear_stress state normal_stress\n");
    head
}

fn station_row(plan: &Plan, now: &Moment<'_>, point: usize) -> String {
    let states = plan.fault.law.states();
    let normal = now.normal(&plan.fault, point);
    // The traction that friction resists with: what drives less the damping.
    let shear = normal * plan.fault.law.scale(point) * now.unknowns[point];
    let theta = plan.points[point]
        .theta
        .filter(|_| states == 1)
        .map_or(f64::NAN, |(time, per)| (time.ln() + now.states()[point] * per) / std::f64::consts::LN_10);
    format!(
        "{:.14e} {:.9e} {:.9} {:.9e} {:.9} {:.9e}\n",
        now.at.seconds(),
        now.slip()[point],
        now.rate[point].abs().log10(),
        shear / 1e6,
        theta,
        normal / 1e6
    )
}
