//! Output files of a run: stations, the largest slip rate, profiles of slip, slip rate and opening in 2D, and snapshots in 3D.
//!
//! Rows are due after changes and after intervals of simulated time, not after steps, so that the size of a file
//! depends on events.

use super::cadence::{Cadence, Gauge, RATE_CHANGE, Reading, log_rate, warning};
use super::forces;
use super::locking;
use super::moments;
use super::plan::Plan;
use super::position::Position;
use super::receivers;
use super::snapshots::{self, Snapshots};
use super::source_time::SourceTimes;
use super::states;
use super::stations;
use super::surface_profiles;
use crate::checkpoint::{self, ResumeError};
use crate::warning::Warning;
use asperity_cycles::{Faults, Moment};
use asperity_ode::{Clock, Control, ObserveError, Observer};
use asperity_output::decimals::{fixed, scientific};
use asperity_output::{Growing, OutputError, atomic};
use std::cell::LazyCell;
use std::path::{Path, PathBuf};

/// Columns of the largest slip rate. Means are weighted by area; for vector slip they are of the components along the
/// rake.
const LARGEST_HEAD: &str = "time [s],log10 slip_rate [m/s],point,mean shear_traction [Pa],mean slip [m]\n";

/// A file that grows by whole rows, with the gauge that decides when the next one is due.
#[derive(Debug)]
struct Rows {
    file: Growing,
    gauge: Gauge,
}

impl Rows {
    fn create(path: PathBuf, head: &str) -> Result<Self, OutputError> {
        Ok(Self { file: Growing::create(path, head.as_bytes())?, gauge: Gauge::of(head.len() as u64) })
    }

    /// Resumes a file at the size recorded in its gauge; anything beyond is cut off.
    fn reopen(path: PathBuf, gauge: Gauge) -> Result<Self, OutputError> {
        Ok(Self { file: Growing::reopen(path, gauge.bytes)?, gauge })
    }

    /// Writes the row of a time \[s\].
    fn push(&mut self, row: &str, cadence: &Cadence, time: f64) -> Result<(), OutputError> {
        self.gauge.spend(row.len() as u64, cadence.largest_file, time);
        self.file.push(row.as_bytes())
    }
}

/// Writes `stations/`, `largest_rate.csv`, `moment_rate.csv`, `locking.csv` of faults that plates load, the moment rates of events in `events/` and, if the scene requests
/// them, `points/`, `forces/` and `springs/`. In 2D it also writes `slip_profiles.csv`, `rate_profiles.csv` (log10 of m/s) and profiles of coupling, states, opening and heat, where there are any;
/// in 3D, snapshots.
#[derive(Debug)]
pub struct Files<'a> {
    plan: &'a Plan,
    /// The largest slip rate and the moment rates, then profiles of slip and slip rate and others or the list of snapshots, profiles of the
    /// surface, the locking, forces of faults, receivers, points, forces and springs of bodies, then stations.
    rows: Vec<Rows>,
    /// Number of files that are neither of bodies nor of stations.
    general: usize,
    /// Points of the stations.
    stations: Vec<usize>,
    /// End of the last step, and the number of steps taken.
    before: Option<Clock>,
    step: u64,
    snapshots: Option<Snapshots>,
    events: SourceTimes,
}

impl<'a> Files<'a> {
    /// Creates the files in `out` and writes their headers.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(out: &Path, plan: &'a Plan) -> Result<Self, OutputError> {
        atomic::writable_dir(out)?;
        atomic::create_dir(&out.join("stations"))?;
        for (path, _) in sampled(plan).into_iter().chain(receivers::heads(&plan.receivers)) {
            out.join(path).parent().map_or(Ok(()), atomic::create_dir)?;
        }
        let mut rows = Vec::new();
        for (path, head) in Self::heads(out, plan) {
            rows.push(Rows::create(path, &head)?);
        }
        Ok(Self {
            plan,
            general: general(plan, &rows),
            rows,
            stations: stations::points(plan),
            before: None,
            step: 0,
            snapshots: Snapshots::begin(out, plan)?,
            events: SourceTimes::create(out, plan)?,
        })
    }

    /// Resumes the files in `out` at their recorded positions; anything written after them is cut off.
    ///
    /// # Errors
    /// If a file is missing, shorter than it was, or cannot be written.
    pub fn resume(out: &Path, plan: &'a Plan, from: &Position) -> Result<Self, ResumeError> {
        let (mut rows, heads) = (Vec::new(), Self::heads(out, plan));
        if heads.len() != from.gauges.len() {
            return Err(checkpoint::foreign(out, "it has not the output files of this scene"));
        }
        for ((path, _), &gauge) in heads.into_iter().zip(&from.gauges) {
            rows.push(Rows::reopen(path, gauge)?);
        }
        let Position { before, snapshots, events, .. } = *from;
        let snapshots = Snapshots::begin(out, plan)?.map(|s| s.from(snapshots.unwrap_or_default()));
        Ok(Self {
            plan,
            general: general(plan, &rows),
            rows,
            stations: stations::points(plan),
            before,
            step: from.step,
            snapshots,
            events: SourceTimes::resume(out, plan, events)?,
        })
    }

    /// Current positions in the files.
    #[must_use]
    pub fn position(&self) -> Position {
        let gauges = self.rows.iter().map(|r| r.gauge).collect();
        let snapshots = self.snapshots.as_ref().map(Snapshots::taken);
        Position { gauges, before: self.before, step: self.step, snapshots, events: self.events.written() }
    }

    /// Waits until all files are on the disc.
    ///
    /// # Errors
    /// If something could not be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.events.settle()?;
        self.rows.iter().try_for_each(|rows| rows.file.settle())
    }

    /// Warning about files whose rows have been thinned out.
    #[must_use]
    pub fn warning(&self) -> Option<Warning> {
        let name =
            |r: &Rows| r.file.path().file_name().map_or(String::new(), |n| n.to_string_lossy().into_owned());
        let mut files: Vec<(String, Gauge)> = self.rows.iter().map(|r| (name(r), r.gauge)).collect();
        files.extend(self.snapshots.as_ref().map(|s| ("fields".to_string(), s.taken().gauge)));
        files.extend(self.events.coarse());
        warning(&files, self.plan.cadence.largest_file)
    }

    /// Paths of all files, with their headers.
    fn heads(out: &Path, plan: &Plan) -> Vec<(PathBuf, String)> {
        let mut heads = vec![
            (out.join("largest_rate.csv"), LARGEST_HEAD.to_string()),
            (out.join(moments::FILE), moments::head(plan)),
        ];
        if plan.in_space {
            heads.push((out.join(snapshots::LIST), snapshots::HEAD.to_string()));
        } else {
            let along: String = plan.points.iter().map(|p| format!(",{}", p.along)).collect();
            let head = format!("time [s]{along}\n");
            heads.push((out.join("slip_profiles.csv"), head.clone()));
            heads.push((out.join("rate_profiles.csv"), head.clone()));
            let further = further(plan).map(|further| (out.join(further.file), head.clone()));
            heads.extend(further);
        }
        heads.extend(surface_profiles::heads(plan).into_iter().map(|(name, head)| (out.join(name), head)));
        if locking::any(plan) {
            heads.push((out.join(locking::FILE), locking::head(plan)));
        }
        heads.push((out.join(forces::FILE), forces::head(plan)));
        heads
            .extend(receivers::heads(&plan.receivers).into_iter().map(|(path, head)| (out.join(path), head)));
        heads.extend(sampled(plan).into_iter().map(|(path, head)| (out.join(path), head)));
        let folder = out.join("stations");
        heads.extend(stations::heads(plan).into_iter().map(|(name, head)| (folder.join(name), head)));
        heads
    }

    fn write(&mut self, now: &Moment<'_>) -> Result<(), OutputError> {
        let (plan, time) = (self.plan, now.at.seconds());
        let earlier = self.before.replace(now.at);
        self.step += u64::from(now.dt > 0.0);
        let then = now.step.as_ref().zip(earlier).map(|(step, at)| now.start_of(step, at));
        let (tables, rest) = self.rows.split_at_mut(self.general);
        let (samples, stations) = rest.split_at_mut(rest.len() - self.stations.len());
        let whole = |now: &Moment<'_>| largest_row(plan, now);
        follow(&mut tables[0], plan, now.largest, (now, then.as_ref()), &whole)?;
        let moments = |now: &Moment<'_>| moments::row(plan, now);
        follow(&mut tables[1], plan, now.largest, (now, then.as_ref()), &moments)?;
        self.events.step(plan, now)?;
        let first = tables.len() - plan.receivers.all.len();
        let all = |now: &Moment<'_>| forces::row(plan, now);
        follow(&mut tables[first - 1], plan, now.largest, (now, then.as_ref()), &all)?;
        if locking::any(plan) {
            let row = |now: &Moment<'_>| locking::row(plan, now);
            follow(&mut tables[first - 2], plan, now.largest, (now, then.as_ref()), &row)?;
        }
        for (number, rows) in tables[first..].iter_mut().enumerate() {
            let row = |now: &Moment<'_>| receivers::row(&plan.receivers, number, now);
            follow(rows, plan, now.largest, (now, then.as_ref()), &row)?;
        }
        for (&point, rows) in self.stations.iter().zip(stations) {
            let row = |now: &Moment<'_>| stations::row(plan, now, point);
            follow(rows, plan, now.speed(point), (now, then.as_ref()), &row)?;
        }
        follow_samples(samples, plan, (now, then.as_ref()), self.step)?;
        match &mut self.snapshots {
            Some(snapshots) => match snapshots.take(plan, now)? {
                Some(row) => tables[2].push(&row, &plan.cadence, time),
                None => Ok(()),
            },
            None => self.profiles(now),
        }
    }

    /// Writes profiles of slip and slip rate along lines if they are due.
    fn profiles(&mut self, now: &Moment<'_>) -> Result<(), OutputError> {
        let (time, cadence) = (now.at.seconds(), &self.plan.cadence);
        let fast = usize::from(now.largest >= self.plan.problem.settings.thresholds.on);
        let (reading, interval) = (Reading { time, rate: now.largest }, cadence.contours[fast]);
        if self.rows[2].gauge.profile(reading, interval, f64::INFINITY) {
            let row = profile(time, now.slip().component(0), |slip| scientific(slip, 6));
            self.rows[2].push(&row, cadence, time)?;
        }
        if self.rows[3].gauge.profile(reading, interval, RATE_CHANGE) {
            let row = profile(time, now.rate.component(0), |rate| fixed(log_rate(rate), 3));
            self.rows[3].push(&row, cadence, time)?;
        }
        let known = further(self.plan).count();
        for (rows, further) in self.rows[4..].iter_mut().zip(further(self.plan)) {
            if fast == 1 && further.between_events {
                continue;
            }
            if rows.gauge.profile(reading, interval, further.change) {
                let row = profile(time, &(further.values)(self.plan, now), |value| scientific(value, 6));
                rows.push(&row, cadence, time)?;
            }
        }
        let Some(line) = surface_profiles::followed(self.plan) else { return Ok(()) };
        for (rows, &axis) in self.rows[4 + known..].iter_mut().zip(&line.axes) {
            if rows.gauge.profile(reading, interval, f64::INFINITY) {
                let row = profile(time, &surface_profiles::values(line, axis, now), |u| scientific(u, 9));
                rows.push(&row, cadence, time)?;
            }
        }
        Ok(())
    }
}

/// Files of values of the bodies, with their headers.
fn sampled(plan: &Plan) -> Vec<(String, String)> {
    plan.sampling.as_ref().map_or_else(Vec::new, |sampling| sampling.sampled.heads())
}

/// Number of files that are neither of bodies nor of stations.
fn general(plan: &Plan, rows: &[Rows]) -> usize {
    rows.len() - stations::points(plan).len() - sampled(plan).len()
}

/// Writes the rows of the values of bodies that are due; all follow the largest slip rate. The bodies are solved for once a moment.
fn follow_samples(
    files: &mut [Rows],
    plan: &Plan,
    (now, then): (&Moment<'_>, Option<&Moment<'_>>),
    step: u64,
) -> Result<(), OutputError> {
    let (Some(sampling), Some(view)) = (&plan.sampling, &plan.bodies) else { return Ok(()) };
    let at = |moment: &Moment<'_>, step: u64| {
        let when = (moment.at.seconds(), sampling.number, step);
        sampling.sampled.rows(when, &sampling.at(view, moment))
    };
    let at_end = LazyCell::new(|| at(now, step));
    let at_start = LazyCell::new(|| then.map_or_else(Vec::new, |then| at(then, step.saturating_sub(1))));
    for (k, rows) in files.iter_mut().enumerate() {
        let row = |moment: &Moment<'_>| {
            if std::ptr::eq(moment, now) { at_end[k].clone() } else { at_start[k].clone() }
        };
        follow(rows, plan, now.largest, (now, then), &row)?;
    }
    Ok(())
}

/// Profiles in 2D beyond those of slip and slip rate.
struct Further {
    file: &'static str,
    /// Change of log10 of the largest slip rate after which one is due before its time.
    change: f64,
    /// True if there is none in events.
    between_events: bool,
    /// Values of all points.
    values: fn(&Plan, &Moment<'_>) -> Vec<f64>,
}

/// Further profiles of a plan.
fn further(plan: &Plan) -> impl Iterator<Item = Further> {
    let fault = &plan.problem.fault;
    let often = |file, values| Further { file, change: RATE_CHANGE, between_events: false, values };
    let seldom = |file, values| Further { file, change: f64::INFINITY, between_events: false, values };
    let heats = fault.heat.is_some();
    let pressurises = fault.heat.as_ref().is_some_and(|heat| heat.pressurises());
    let all: [(bool, Further); 5] = [
        (fault.opening.is_some(), seldom("opening_profiles.csv", |_, now| now.pressed.opening.clone())),
        (heats, seldom("temperature_profiles.csv", |_, now| now.pressed.surface.temperature.clone())),
        (pressurises, seldom("pressure_profiles.csv", |_, now| now.pressed.surface.pressure.clone())),
        (states::any(plan), often(states::PROFILES, states::profile)),
        (locking::any(plan), Further { between_events: true, ..often(locking::PROFILES, locking::profile) }),
    ];
    all.into_iter().filter(|f| f.0).map(|f| f.1)
}

/// Writes the rows of a file that follows a slip rate, if due: one for this step, and one for its start if the rate had an extremum there.
fn follow(
    rows: &mut Rows,
    plan: &Plan,
    rate: f64,
    (now, then): (&Moment<'_>, Option<&Moment<'_>>),
    row: &dyn Fn(&Moment<'_>) -> String,
) -> Result<(), OutputError> {
    let time = now.at.seconds();
    let due = rows.gauge.step(&plan.cadence, Reading { time, rate });
    let mut at_end = due.now;
    if due.before {
        match then {
            Some(then) => rows.push(&row(then), &plan.cadence, then.at.seconds())?,
            // A method that does not provide the start of its steps: the row comes one step late.
            None => at_end = true,
        }
    }
    if at_end && !rows.gauge.full { rows.push(&row(now), &plan.cadence, time) } else { Ok(()) }
}

/// Row of the largest slip rate.
fn largest_row(plan: &Plan, now: &Moment<'_>) -> String {
    let (mut point, mut largest) = (0, 0.0);
    for p in 0..plan.points.len() {
        let speed = now.speed(p);
        if speed > largest {
            (point, largest) = (p, speed);
        }
    }
    let (time, (shear, slip)) = (now.at.seconds(), means(plan, now));
    let (rate, shear, slip) = (fixed(log_rate(largest), 6), scientific(shear, 6), scientific(slip, 9));
    format!("{time:.14e},{rate},{point},{shear},{slip}\n")
}

/// Row of a profile.
fn profile(time: f64, values: &[f64], text: impl Fn(f64) -> String) -> String {
    let mut row = format!("{time:.14e}");
    for &value in values {
        row.push(',');
        row.push_str(&text(value));
    }
    row.push('\n');
    row
}

impl Observer<Faults> for Files<'_> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Control, ObserveError> {
        self.write(moment)?;
        Ok(Control::Go)
    }
}

/// Means over the area of shear traction \[Pa\] and slip \[m\]; for vector slip, of the components along the rake.
fn means(plan: &Plan, now: &Moment<'_>) -> (f64, f64) {
    let (mut area, mut shear, mut slip) = (0.0, 0.0, 0.0);
    let (m, slips) = (now.m(), now.slip());
    for (p, point) in plan.points.iter().enumerate() {
        area += point.area;
        shear += point.area * now.normal(p) * plan.problem.fault.law.scale(p) * m.component(0)[p];
        slip += point.area * slips.component(0)[p];
    }
    (shear / area, slip / area)
}
