//! Plots of a run, drawn from its tables, so that a resumed run has the same plots as an uninterrupted one.

use super::arrivals::Arrivals;
use super::fields::Taken;
use super::plan::Plan;
use crate::fault::FaultView;
use crate::fault::figures::each;
use crate::fault::shape::shape;
use asperity_output::OutputError;
use asperity_output::plots::{self, Chart, Measure, Profiles, RupturedFault, Ruptures};
use std::path::{Path, PathBuf};

/// Draws the plots of the run in `out` into its folder `plots`.
///
/// # Errors
/// If a file cannot be read or written.
pub(super) fn draw<const D: usize>(
    out: &Path,
    plan: &Plan<D>,
    arrivals: &Arrivals,
    taken: &Taken,
) -> Result<(), OutputError> {
    let folder = out.join("plots");
    plots::draw_charts(&folder, &charts(out, plan)?)?;
    let frames: Vec<(f64, Vec<f64>)> =
        taken.times.iter().copied().zip(taken.speeds.iter().cloned()).collect();
    plots::draw_velocities(&folder, &plan.title, &plan.mesh, &frames)?;
    if plan.points.is_empty() {
        return Ok(());
    }
    let rates = Written(out.join("rate_profiles.csv"));
    let fault = |f: &FaultView| RupturedFault {
        name: f.name.clone(),
        points: f.points.clone(),
        shape: shape(D == 3, f, &plan.points[f.points.clone()]),
        arrivals: arrivals.times[f.points.clone()].iter().map(|t| t.unwrap_or(f64::NAN)).collect(),
    };
    let faults = plan.faults.iter().map(fault).collect();
    plots::draw_ruptures(&folder, &Ruptures { title: plan.title.clone(), faults, rates: &rates }).map(|_| ())
}

/// Profiles of slip rate in their table.
struct Written(PathBuf);

impl Profiles for Written {
    fn each(&self, look: &mut dyn FnMut(f64, &[f64])) -> Result<(), OutputError> {
        each(&self.0, &mut |row| look(row[0], &row[1..]))
    }
}

/// Charts of energies and of the moment rate.
fn charts<const D: usize>(out: &Path, plan: &Plan<D>) -> Result<Vec<Chart>, OutputError> {
    let parts = ["kinetic", "elastic", "viscous", "friction", "absorbed", "loads", "released"];
    let mut energies: Vec<(String, Vec<(f64, f64)>)> =
        parts.iter().map(|p| ((*p).to_string(), Vec::new())).collect();
    each(&out.join("energy.csv"), &mut |row| {
        energies.iter_mut().zip(&row[1..]).for_each(|(curve, v)| curve.1.push((row[0], *v)));
    })?;
    // Parts that the scene does not have are left out.
    energies.retain(|curve| curve.1.iter().any(|p| p.1 != 0.0));
    let (energy, rate) = if plan.per_length {
        (Measure::EnergyPerLength, Measure::MomentRatePerLength)
    } else {
        (Measure::Energy, Measure::MomentRate)
    };
    let chart = |file: &str, y, curves| Chart {
        file: file.into(),
        title: plan.title.clone(),
        x: ("Time", Measure::Time),
        y,
        curves,
    };
    let mut charts = vec![chart("energy", ("Energy", energy), energies)];
    if !plan.points.is_empty() {
        let mut rates: Vec<(String, Vec<(f64, f64)>)> =
            plan.faults.iter().map(|f| (f.name.clone(), Vec::new())).collect();
        each(&out.join("moment_rate.csv"), &mut |row| {
            rates.iter_mut().zip(row[1..].chunks(2)).for_each(|(curve, v)| curve.1.push((row[0], v[0])));
        })?;
        charts.push(chart("moment_rate", ("Moment rate", rate), rates));
    }
    Ok(charts)
}
