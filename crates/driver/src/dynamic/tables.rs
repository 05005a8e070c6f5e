//! Tables that grow during a run: energies, moment rate, profiles, stations and seismograms.

use super::moment::{Moment, size};
use super::plan::Plan;
use super::stations::{self, Stationed};
use crate::fault::cadence::log_rate;
use asperity_mechanics::dynamics::Budget;
use asperity_output::decimals::{scientific, shortest};
use asperity_output::view::EnergyParts;
use asperity_output::{Growing, OutputError, seismogram, table};
use std::path::{Path, PathBuf};

/// Decimals of numbers in tables other than seismograms.
const DECIMALS: usize = 9;

/// All tables of a run, in a fixed order.
pub(super) struct Tables {
    stations: Vec<Stationed>,
    files: Vec<Growing>,
}

/// Name and header of energies.
fn energies<const D: usize>(plan: &Plan<D>) -> (String, Vec<u8>) {
    ("energy.csv".into(), table::energy_header(if plan.per_length { "J/m" } else { "J" }))
}

/// Name and header of the moment rate.
fn moments<const D: usize>(plan: &Plan<D>) -> (String, Vec<u8>) {
    let unit = if plan.per_length { "N" } else { "N m" };
    let columns = |f: &crate::fault::FaultView| {
        format!(",moment_rate of {0} [{unit}/s],moment of {0} [{unit}]", f.name)
    };
    let head = format!("time [s]{}\n", plan.faults.iter().map(columns).collect::<String>());
    ("moment_rate.csv".into(), head.into())
}

/// Names and headers of all tables.
fn heads<const D: usize>(plan: &Plan<D>, stations: &[Stationed]) -> Vec<(String, Vec<u8>)> {
    let mut heads = vec![energies(plan)];
    if !plan.points.is_empty() {
        heads.push(moments(plan));
        let place = |p: &crate::fault::PointView| {
            if D == 2 { shortest(p.along) } else { p.at.map(shortest).join(" ") }
        };
        let columns: String = plan.points.iter().map(|p| format!(",{}", place(p))).collect();
        heads.push(("rate_profiles.csv".into(), format!("time [s]{columns}\n").into()));
        heads.push(("slip_profiles.csv".into(), format!("time [s]{columns}\n").into()));
    }
    heads.extend(stations.iter().map(|s| (format!("stations/{}", s.name), s.head.clone().into())));
    let header = seismogram::header(&plan.axes).into_bytes();
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
        let open = |(k, (name, head)): (usize, (String, Vec<u8>))| {
            let path: PathBuf = out.join(name);
            match sizes.and_then(|s| s.get(k)) {
                Some(&size) => Growing::reopen(path, size),
                None => Growing::create(path, &head),
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
                let profile = |values, of: fn(f64) -> f64| profile(now.time, values, plan.points.len(), of);
                self.files[2].push(profile(&now.fault.rate, log_rate).as_bytes())?;
                self.files[3].push(profile(&now.fault.slip, |slip| slip).as_bytes())?;
            }
            first = 4;
        }
        let Some(budget) = &now.budget else { return Ok(()) };
        // There is one stage.
        self.files[0].push(&table::energy_row(now.time, 0, now.step, &energy(budget)))?;
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

/// An energy budget in the form of all tables.
fn energy(b: &Budget) -> EnergyParts {
    EnergyParts {
        kinetic: b.kinetic,
        elastic: b.elastic,
        viscous: b.viscous,
        friction: b.friction,
        absorbed: b.absorbed,
        start: b.initial,
        loads: b.loads,
        released: b.released,
        missing: b.missing(),
        ..EnergyParts::default()
    }
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

/// Row of a profile: `of` values with a sign in the plane, and of magnitudes of vectors.
fn profile(time: f64, values: &[f64], points: usize, of: fn(f64) -> f64) -> String {
    if values.len() == points {
        return line(time, values.iter().copied().map(of));
    }
    line(time, (0..points).map(|p| of(size(values, points, p))))
}
