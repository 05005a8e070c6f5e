//! Tables that grow during a run: energies, moment rate, profiles, stations and seismograms.

use super::moment::Moment;
use super::rows::{Course, Table};
use super::{arrivals, seismograms, stations};
use crate::kinds::faults::moments;
use crate::kinds::faults::profile::{Profile, RATE, SLIP};
use asperity_friction::points::Components;
use asperity_mechanics::dynamics::Budget;
use asperity_output::decimals::{scientific, shortest};
use asperity_output::formats::seismogram;
use asperity_output::tables::describe::FileParts;
use asperity_output::tables::{Column, GrowingTable, energy};
use asperity_output::{OutputError, OutputFile};
use asperity_plan::dynamics::Plan;
use asperity_plan::faults::PointView;
use asperity_plan::faults::cadence::log_rate;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// Decimals of numbers in tables other than seismograms.
const DECIMALS: usize = 9;

/// Tables of runs of bodies with mass.
pub const FILES: [OutputFile; 6] =
    [energy::FILE, moments::FILE, RATE.0, SLIP.0, arrivals::FILE, seismograms::FILE];

/// All tables of a plan.
fn all<const D: usize>(plan: &Plan<D>) -> Vec<Table<'_>> {
    let mut all = vec![energies(plan)];
    if !plan.points.is_empty() {
        all.push(moment_rates(plan));
        all.push(profiles(plan, RATE, |now| &now.fault.rate, log_rate));
        all.push(profiles(plan, SLIP, |now| &now.fault.slip, |slip| slip));
    }
    all.extend(stations::tables(plan));
    let columns = seismogram::columns(&plan.axes);
    all.extend(plan.receivers.iter().enumerate().map(|(k, receiver)| {
        let row = move |now: &Moment<'_>| {
            let [velocity, displacement] = &now.received[k];
            seismogram::row(now.time, velocity, displacement)
        };
        Table::new(seismograms::FILE.named(&receiver.name), columns.clone(), Course::Rows, row)
    }));
    all
}

/// Tables of a run, by their paths, with their columns.
#[must_use]
pub fn tables<const D: usize>(plan: &Plan<D>) -> Vec<FileParts<Column>> {
    let growing = all(plan).into_iter().map(|table| FileParts::new(table.path, table.columns));
    growing.chain([FileParts::new(arrivals::FILE.path, arrivals::columns())]).collect()
}

/// Energy budget. There is one stage.
fn energies<const D: usize>(plan: &Plan<D>) -> Table<'_> {
    let columns = energy::columns(if plan.per_length { "J/m" } else { "J" });
    let row = |now: &Moment<'_>| {
        let row = |budget: &Budget| energy::row(now.time, 0, now.step, &budget.energies(), &[]);
        now.budget.as_ref().map_or(String::new(), row)
    };
    Table::new(energy::FILE.path, columns, Course::Rows, row)
}

/// Moment rates and moments of faults.
fn moment_rates<const D: usize>(plan: &Plan<D>) -> Table<'_> {
    let row = |now: &Moment<'_>| {
        let (rates, sums) = (moments_of(plan, &now.fault.rate), moments_of(plan, &now.fault.slip));
        line(now.time, rates.into_iter().zip(sums).flat_map(|(rate, sum)| [rate, sum]))
    };
    Table::new(moments::FILE.path, moments::columns(&plan.faults, plan.per_length), Course::Rows, row)
}

/// Profile of values `of` all points: with a sign in the plane, and of magnitudes of vectors.
fn profiles<'a, const D: usize>(
    plan: &'a Plan<D>,
    profile: Profile,
    values: for<'n> fn(&'n Moment<'_>) -> &'n Components<Vec<f64>>,
    of: fn(f64) -> f64,
) -> Table<'a> {
    let place = |p: &PointView| if D == 2 { shortest(p.along) } else { p.at.map(shortest).join(" ") };
    let columns = profile.columns(plan.points.iter().map(place));
    let row = move |now: &Moment<'_>| {
        let values = values(now);
        if values.components() == 1 {
            return line(now.time, values.all().iter().copied().map(of));
        }
        line(now.time, (0..values.points()).map(|p| of(values.size(p))))
    };
    Table::new(profile.0.path, columns, Course::Profiles, row)
}

/// The tables of a run, with their files.
pub(super) struct Tables<'a>(Vec<(Table<'a>, GrowingTable)>);

impl<'a> Tables<'a> {
    /// Creates all tables in `out`.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create<const D: usize>(out: &Path, plan: &'a Plan<D>) -> Result<Self, OutputError> {
        Self::open(out, plan, |_| None)
    }

    /// Reopens all tables in `out` at these sizes in bytes. `None` if these are of other tables.
    ///
    /// # Errors
    /// If a file cannot be written, or has fewer bytes than that.
    pub fn reopen<const D: usize>(
        out: &Path,
        plan: &'a Plan<D>,
        sizes: &BTreeMap<String, u64>,
    ) -> Result<Option<Self>, OutputError> {
        let all = all(plan);
        if all.len() != sizes.len() || !all.iter().all(|table| sizes.contains_key(&table.path)) {
            return Ok(None);
        }
        Self::open(out, plan, |table| sizes.get(&table.path).copied()).map(Some)
    }

    fn open<const D: usize>(
        out: &Path,
        plan: &'a Plan<D>,
        size: impl Fn(&Table<'_>) -> Option<u64>,
    ) -> Result<Self, OutputError> {
        let open = |table: Table<'a>| {
            let file = table.open(out, size(&table))?;
            Ok((table, file))
        };
        all(plan).into_iter().map(open).collect::<Result<_, _>>().map(Self)
    }

    /// Sizes of all tables \[bytes\], by their paths.
    pub fn sizes(&self) -> BTreeMap<String, u64> {
        self.0.iter().map(|(table, file)| (table.path.clone(), file.bytes())).collect()
    }

    /// Waits until all rows are on the disc.
    ///
    /// # Errors
    /// If the rows cannot be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.0.iter().try_for_each(|(_, file)| file.settle())
    }

    /// Writes the rows that are due.
    ///
    /// # Errors
    /// If a row cannot be written.
    pub fn step<const D: usize>(&mut self, plan: &Plan<D>, now: &Moment<'_>) -> Result<(), OutputError> {
        for (table, file) in &mut self.0 {
            let due = match table.course {
                Course::Rows => now.budget.is_some(),
                Course::Profiles => now.step.is_multiple_of(plan.cadence.profiles),
            };
            if due {
                file.push((table.row)(now, now.step as u64).as_bytes())?;
            }
        }
        Ok(())
    }
}

/// Row of values, which all threads write: profiles have one for each point of the faults.
fn line(time: f64, values: impl Iterator<Item = f64>) -> String {
    const VALUES: usize = 1024;
    let values: Vec<f64> = values.collect();
    let part = |values: &[f64]| -> String {
        values.iter().flat_map(|&v| [",".into(), scientific(v, DECIMALS)]).collect()
    };
    let parts: Vec<String> = values.par_chunks(VALUES).map(part).collect();
    format!("{}{}\n", shortest(time), parts.concat())
}

/// Rate and sum of ∫ G slip dA of each fault.
pub(super) fn moments_of<const D: usize>(plan: &Plan<D>, values: &Components<Vec<f64>>) -> Vec<f64> {
    let of = |p: usize| plan.points[p].shear_modulus * plan.points[p].area * values.size(p);
    plan.faults.iter().map(|f| f.points.clone().map(of).sum()).collect()
}
