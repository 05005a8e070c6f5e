//! Output files of a run: stations in the format of the SEAS community, the largest slip rate, and profiles of slip.
//!
//! Rows come by change and by simulated time, not by step, so that files grow with what happens.

use super::plan::Plan;
use super::run::{Moment, Watcher};
use crate::observe::{ObserveError, atomic};
use crate::ode::Control;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A year \[s\], as the benchmarks count it.
const YEAR: f64 = 365.25 * 86_400.0;
/// Time between rows of stations while nothing is fast, and in an event \[s\]: the cadence the benchmarks ask for.
const STATION_INTERVALS: [f64; 2] = [0.1 * YEAR, 0.1];
/// Time between profiles of slip while nothing is fast, and in an event \[s\].
const PROFILE_INTERVALS: [f64; 2] = [5.0 * YEAR, 1.0];
/// A row is written where ln of the largest slip rate has changed by so much: an eighth of a decade.
const CHANGE: f64 = 0.3;

/// A file that grows by whole rows.
#[derive(Debug)]
struct Rows {
    path: PathBuf,
    file: fs::File,
}

impl Rows {
    fn create(path: PathBuf, head: &str) -> Result<Self, ObserveError> {
        atomic::write(&path, head.as_bytes())?;
        let file = fs::OpenOptions::new().append(true).open(&path);
        let file = file.map_err(|source| ObserveError::write(&path, source))?;
        Ok(Self { path, file })
    }

    /// One write for a row: a run that is killed leaves whole rows.
    fn push(&mut self, row: &str) -> Result<(), ObserveError> {
        self.file.write_all(row.as_bytes()).map_err(|source| ObserveError::write(&self.path, source))
    }
}

/// When something was written last.
#[derive(Clone, Copy, Debug)]
struct Last {
    time: f64,
    log_largest: f64,
}

/// Writes `stations/`, `largest_rate.csv` and `slip_profiles.csv`.
#[derive(Debug)]
pub struct Files<'a> {
    plan: &'a Plan,
    largest: Rows,
    stations: Vec<(usize, Rows)>,
    profiles: Rows,
    row: Option<Last>,
    profile: Option<f64>,
    failure: Option<ObserveError>,
}

impl<'a> Files<'a> {
    /// Makes the files with their headers in `out`.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn create(out: &Path, plan: &'a Plan) -> Result<Self, ObserveError> {
        atomic::writable_dir(out)?;
        let folder = out.join("stations");
        atomic::create_dir(&folder)?;
        let mut stations = Vec::new();
        for fault in &plan.faults {
            // Tenths of a kilometre in three digits, as the benchmarks name their stations, where that tells them apart.
            let tenths = |asked: f64| (asked / 100.0).round();
            let apart = fault.stations.windows(2).all(|w| tenths(w[0].0) < tenths(w[1].0));
            for (k, &(asked, point)) in fault.stations.iter().enumerate() {
                let name = if apart {
                    format!("{}_dp{:03}", fault.name, tenths(asked))
                } else {
                    format!("{}_{k:03}", fault.name)
                };
                let head = station_head(plan, &fault.name, asked, point);
                stations.push((point, Rows::create(folder.join(name), &head)?));
            }
        }
        let mut profile_head = String::from("time [s]");
        for p in &plan.points {
            profile_head.push_str(&format!(",{}", p.along));
        }
        profile_head.push('\n');
        Ok(Self {
            plan,
            largest: Rows::create(out.join("largest_rate.csv"), "time [s],log10 slip_rate [m/s],point\n")?,
            stations,
            profiles: Rows::create(out.join("slip_profiles.csv"), &profile_head)?,
            row: None,
            profile: None,
            failure: None,
        })
    }

    /// Ends the files.
    ///
    /// # Errors
    /// The first thing that could not be written.
    pub fn finish(self) -> Result<(), ObserveError> {
        self.failure.map_or(Ok(()), Err)
    }

    fn write(&mut self, now: &Moment<'_>) -> Result<(), ObserveError> {
        let time = now.at.seconds();
        let fast = usize::from(now.largest >= self.plan.settings.thresholds.on);
        let log_largest = now.largest.ln();
        let due = self.row.is_none_or(|last| {
            time - last.time >= STATION_INTERVALS[fast] || (log_largest - last.log_largest).abs() >= CHANGE
        });
        if due {
            self.row = Some(Last { time, log_largest });
            let point = now.rate.iter().position(|v| v.abs() == now.largest).unwrap_or(0);
            self.largest.push(&format!("{time:.14e},{:.6},{point}\n", now.largest.log10()))?;
            for (point, rows) in &mut self.stations {
                rows.push(&station_row(self.plan, now, *point))?;
            }
        }
        if self.profile.is_none_or(|last| time - last >= PROFILE_INTERVALS[fast]) {
            self.profile = Some(time);
            let mut row = format!("{time:.14e}");
            for slip in now.slip() {
                row.push_str(&format!(",{slip:.6e}"));
            }
            row.push('\n');
            self.profiles.push(&row)?;
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

fn station_head(plan: &Plan, fault: &str, asked: f64, point: usize) -> String {
    let view = &plan.points[point];
    let columns = [
        "Column #1 = Time (s)",
        "Column #2 = Slip (m)",
        "Column #3 = Slip rate (log10 m/s)",
        "Column #4 = Shear stress (MPa)",
        "Column #5 = State (log10 s)",
        "Column #6 = Normal stress (MPa)",
    ];
    let mut head = format!(
        "# problem={}\n# code=asperity\n# code_version={}\n# tributary_area={:.6e} m per m\n# location= {asked} m along fault {fault}, point at {:.6} m\n",
        plan.title,
        env!("CARGO_PKG_VERSION"),
        view.area,
        view.along
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
