//! Tables that grow during a run: energies, moment rate, profiles, stations and seismograms.

use super::moment::{Moment, size};
use super::plan::Plan;
use super::stations::{self, Stationed};
use asperity_mechanics::dynamics::Budget;
use asperity_output::decimals::{scientific, shortest};
use asperity_output::{Growing, OutputError, seismogram};
use std::path::{Path, PathBuf};

/// Decimals of numbers in tables other than seismograms.
const DECIMALS: usize = 9;

/// All tables of a run, in a fixed order.
pub(super) struct Tables {
    stations: Vec<Stationed>,
    files: Vec<Growing>,
}

/// Name and header of energies.
fn energies<const D: usize>(plan: &Plan<D>) -> (String, String) {
    let unit = if plan.per_length { "J/m" } else { "J" };
    let parts = ["kinetic", "elastic", "viscous", "friction", "absorbed", "loads", "released", "missing"];
    let columns: String = parts.iter().map(|part| format!(",{part} [{unit}]")).collect();
    ("energy.csv".into(), format!("time [s]{columns}\n"))
}

/// Name and header of the moment rate.
fn moments<const D: usize>(plan: &Plan<D>) -> (String, String) {
    let unit = if plan.per_length { "N" } else { "N m" };
    let columns = |f: &crate::fault::FaultView| {
        format!(",moment_rate of {0} [{unit}/s],moment of {0} [{unit}]", f.name)
    };
    ("moment_rate.csv".into(), format!("time [s]{}\n", plan.faults.iter().map(columns).collect::<String>()))
}

/// Names and headers of all tables.
fn heads<const D: usize>(plan: &Plan<D>, stations: &[Stationed]) -> Vec<(String, String)> {
    let mut heads = vec![energies(plan)];
    if !plan.points.is_empty() {
        heads.push(moments(plan));
        let place = |p: &crate::fault::PointView| {
            if D == 2 { shortest(p.along) } else { p.at.map(shortest).join(" ") }
        };
        let columns: String = plan.points.iter().map(|p| format!(",{}", place(p))).collect();
        heads.push(("rate_profiles.csv".into(), format!("time [s]{columns}\n")));
        heads.push(("slip_profiles.csv".into(), format!("time [s]{columns}\n")));
    }
    heads.extend(stations.iter().map(|s| (format!("stations/{}", s.name), s.head.clone())));
    let header = seismogram::header(&plan.axes);
    heads.extend(plan.receivers.iter().map(|r| (format!("seismograms/{}.csv", r.name), header.clone())));
    heads
}

impl Tables {
    /// Creates all tables in `out`, or resumes them at these sizes in bytes.
    ///
    /// # Errors
    /// If a file cannot be written, or has fewer bytes than that.
    pub fn open<const D: usize>(
        out: &Path,
        plan: &Plan<D>,
        sizes: Option<&[u64]>,
    ) -> Result<Self, OutputError> {
        let stations = stations::all(plan);
        let open = |(k, (name, head)): (usize, (String, String))| {
            let path: PathBuf = out.join(name);
            match sizes.and_then(|s| s.get(k)) {
                Some(&size) => Growing::reopen(path, size),
                None => Growing::create(path, head.as_bytes()),
            }
        };
        let files = heads(plan, &stations).into_iter().enumerate().map(open).collect::<Result<_, _>>()?;
        Ok(Self { stations, files })
    }

    /// Sizes of all tables \[bytes\].
    pub fn sizes(&self) -> Vec<u64> {
        self.files.iter().map(Growing::bytes).collect()
    }

    /// Waits until all rows are on the disc.
    ///
    /// # Errors
    /// If the rows cannot be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.files.iter().try_for_each(Growing::settle)
    }

    /// Writes the rows that are due.
    ///
    /// # Errors
    /// If a row cannot be written.
    pub fn step<const D: usize>(&mut self, plan: &Plan<D>, now: &Moment<'_>) -> Result<(), OutputError> {
        let mut first = 1;
        if !plan.points.is_empty() {
            if now.step.is_multiple_of(plan.cadence.profiles) {
                self.files[2].push(profile(now.time, &now.fault.rate, plan.points.len()).as_bytes())?;
                self.files[3].push(profile(now.time, &now.fault.slip, plan.points.len()).as_bytes())?;
            }
            first = 4;
        }
        let Some(budget) = &now.budget else { return Ok(()) };
        self.files[0].push(energy(budget).as_bytes())?;
        if first > 1 {
            self.files[1].push(moment(plan, now).as_bytes())?;
        }
        let (on_faults, on_bodies) = self.files[first..].split_at_mut(self.stations.len());
        for (file, station) in on_faults.iter_mut().zip(&self.stations) {
            file.push(stations::row(plan, now, station.point).as_bytes())?;
        }
        for (file, [velocity, displacement]) in on_bodies.iter_mut().zip(&now.received) {
            file.push(seismogram::row(now.time, velocity, displacement).as_bytes())?;
        }
        Ok(())
    }
}

fn line(time: f64, values: impl Iterator<Item = f64>) -> String {
    let mut text = shortest(time);
    values.for_each(|v| text.extend([",", &scientific(v, DECIMALS)]));
    text.push('\n');
    text
}

fn energy(b: &Budget) -> String {
    let parts = [b.kinetic, b.elastic, b.viscous, b.friction, b.absorbed, b.loads, b.released, b.missing()];
    line(b.time, parts.into_iter())
}

/// Rate and sum of ∫ G slip dA of each fault.
pub(super) fn moments_of<const D: usize>(plan: &Plan<D>, values: &[f64]) -> Vec<f64> {
    let of =
        |p: usize| plan.points[p].shear_modulus * plan.points[p].area * size(values, plan.points.len(), p);
    plan.faults.iter().map(|f| f.points.clone().map(of).sum()).collect()
}

fn moment<const D: usize>(plan: &Plan<D>, now: &Moment<'_>) -> String {
    let (rates, sums) = (moments_of(plan, &now.fault.rate), moments_of(plan, &now.fault.slip));
    line(now.time, rates.into_iter().zip(sums).flat_map(|(rate, sum)| [rate, sum]))
}

/// Row of a profile: values with a sign in the plane, magnitudes of vectors.
fn profile(time: f64, values: &[f64], points: usize) -> String {
    if values.len() == points {
        return line(time, values.iter().copied());
    }
    line(time, (0..points).map(|p| size(values, points, p)))
}
