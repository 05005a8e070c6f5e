//! Figures of a run: what they need beside its tables.

use super::arrivals::Arrivals;
use super::fields::WrittenFields;
use crate::kinds::faults::compass::Compass;
use crate::kinds::faults::shape::shape;
use asperity_output::figures::{Curves, Fault, Measure, Plot, Points, Sheet, Velocities, VisibleMesh, short};
use asperity_output::tables::energy::ENERGIES;
use asperity_plan::dynamics::Plan;
use asperity_plan::faults::FaultView;

/// Figures of a run up to a time \[s\].
pub(super) fn sheet<const D: usize>(
    plan: &Plan<D>,
    end: f64,
    arrivals: &Arrivals,
    taken: &WrittenFields,
) -> Sheet {
    let mut sheet = Sheet::new(&plan.title, [0.0, end], D == 3);
    sheet.plots.extend(curves(plan).into_iter().map(Plot::Curves));
    if let Some((mesh, nodes)) = VisibleMesh::from_mesh(&plan.mesh, &[]) {
        let most = taken.speeds.iter().flatten().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
        let seen = |speeds: &Vec<f64>| nodes.iter().map(|&node| seen(speeds[node], most)).collect();
        let frames = taken.times.iter().copied().zip(taken.speeds.iter().map(seen)).collect();
        let mesh = sheet.mesh(mesh);
        sheet.plots.push(Plot::Velocities(Velocities { mesh, frames }));
    }
    if !plan.points.is_empty() {
        let fault = |f: &FaultView| Fault {
            name: f.name.clone(),
            points: f.points.clone(),
            shape: sheet.shape(shape(D == 3, f, &plan.points[f.points.clone()], &Compass::default())),
            arrivals: arrivals.times[f.points.clone()].iter().map(|t| t.map_or(f64::NAN, short)).collect(),
        };
        let faults = plan.faults.iter().map(fault).collect();
        sheet.plots.push(Plot::Ruptures(faults));
    }
    sheet
}

/// Decimals of velocities below the first digit of the largest: colours show fewer.
const DECIMALS: i32 = 4;

/// A velocity with as many decimals as colours show beside the largest one.
fn seen(velocity: f64, most: f64) -> f64 {
    if most <= 0.0 {
        return velocity;
    }
    let decimals = (DECIMALS - most.log10().floor() as i32).max(0) as usize;
    format!("{velocity:.decimals$}").parse().unwrap_or(velocity)
}

/// Energies and moment rates, from their tables.
fn curves<const D: usize>(plan: &Plan<D>) -> Vec<Curves> {
    let (energy, rate) = if plan.per_length {
        (Measure::EnergyPerLength, Measure::MomentRatePerLength)
    } else {
        (Measure::Energy, Measure::MomentRate)
    };
    let chart = |file: &str, y: (&str, Measure), curves: Vec<(String, usize)>, without_zero| {
        let of = |(name, y)| (name, Points::Table { table: format!("{file}.csv"), x: 0, y, size: false });
        Curves {
            file: file.into(),
            title: plan.title.clone(),
            x: ("Time".into(), Measure::Time),
            y: (y.0.into(), y.1),
            curves: curves.into_iter().map(of).collect(),
            event: None,
            without_zero,
            until: None,
            pairs: false,
        }
    };
    let shown = ["kinetic", "elastic", "viscous", "friction", "absorbed", "loads", "released"];
    let named = ENERGIES.into_iter().enumerate();
    // Time, stage and step precede them.
    let parts =
        named.filter(|(_, name)| shown.contains(name)).map(|(k, name)| (name.into(), 3 + k)).collect();
    // Parts that the scene does not have are left out.
    let mut all = vec![chart("energy", ("Energy", energy), parts, true)];
    if !plan.points.is_empty() {
        let faults = plan.faults.iter().enumerate().map(|(k, f)| (f.name.clone(), 1 + 2 * k)).collect();
        all.push(chart("moment_rate", ("Moment rate", rate), faults, false));
    }
    all
}
