//! Coupling of faults to the plates that load them: how far slip lags behind the motion of the plates.
//!
//! At a point it is c = 1 - V.Vp/Vp.Vp, with the slip rate V and the rate Vp of the plates: 1 where the point is locked, 0 where
//! it creeps with the plates, negative where it is faster. The slip deficit grows at c Vp, the backslip of J. C. Savage,
//! J. Geophys. Res. 88 (1983) 4984, and the moment deficit at the integral of G c |Vp|.

use super::profile::Profile;
use super::rows::{Course, Table, line};
use asperity_cycles::{Components, Moment};
use asperity_output::OutputFile;
use asperity_output::decimals::scientific;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_plan::faults::{FaultView, Plan};

/// Profile of the coupling.
pub(super) const PROFILES: Profile = Profile(
    OutputFile::new(
        "coupling_profiles.csv",
        "coupling along a fault to the plates that load it, at intervals between events",
    ),
    "-",
    Sign::None,
    "coupling to the plates that load the fault",
);

/// The table of means.
pub(super) const FILE: OutputFile = OutputFile::new(
    "locking.csv",
    "mean coupling of faults to the plates that load them, and moment deficit rate, over time",
);

/// True if plates load any fault.
pub(super) fn any(plan: &Plan) -> bool {
    plan.faults.iter().any(|fault| loaded(plan, fault))
}

/// True if plates load a fault.
pub(super) fn loaded(plan: &Plan, fault: &FaultView) -> bool {
    plan.points[fault.points.clone()].iter().any(|point| point.plate.is_some())
}

/// Coupling of a point; NaN on a fault that no plates load.
pub(super) fn coupling(plan: &Plan, rate: &Components<&[f64]>, point: usize) -> f64 {
    let Some(plate) = plan.points[point].plate else { return f64::NAN };
    let own = plate.iter().take(rate.components());
    let (along, whole) = own.enumerate().fold((0.0, 0.0), |(along, whole), (c, plate)| {
        (along + rate.component(c)[point] * plate, whole + plate * plate)
    });
    1.0 - along / whole
}

/// Coupling of all points.
pub(super) fn profile(plan: &Plan, now: &Moment<'_>) -> Vec<f64> {
    (0..plan.points.len()).map(|p| coupling(plan, &now.rate, p)).collect()
}

/// The table, if plates load any fault: the mean coupling of each, weighted by G |Vp| dA, and the rate of its moment deficit.
pub(super) fn table(plan: &Plan) -> Option<Table<'_>> {
    let unit = if plan.in_space { "N m/s" } else { "N/s" };
    let of_fault = |fault: &FaultView| {
        [
            Column::new("coupling", "-", Sign::None, "mean coupling to the plates, weighted by G Vp dA"),
            Column::new("moment_deficit_rate", unit, Sign::None, "rate at which the moment deficit grows"),
        ]
        .map(|column| column.for_part(&fault.name))
    };
    let columns = [column::time()].into_iter().chain(faults(plan).flat_map(of_fault)).collect();
    let row = |now: &Moment<'_>| {
        let values = faults(plan).flat_map(|fault| deficit(plan, fault, now));
        line(now.at.seconds(), values.map(|value| scientific(value, 9)))
    };
    any(plan).then(|| Table::new(FILE.path, columns, Course::Largest, row))
}

/// Mean coupling of a fault \[-\], and the rate of its moment deficit \[N m/s; N/s in the plane\].
fn deficit(plan: &Plan, fault: &FaultView, now: &Moment<'_>) -> [f64; 2] {
    let (mut deficit, mut whole) = (0.0, 0.0);
    for p in fault.points.clone() {
        let point = &plan.points[p];
        let Some(plate) = point.plate else { continue };
        let speed = plate.iter().take(now.rate.components()).map(|v| v * v).sum::<f64>().sqrt();
        let moment = point.shear_modulus * point.area * speed;
        deficit += moment * coupling(plan, &now.rate, p);
        whole += moment;
    }
    [deficit / whole, deficit]
}

/// Faults that plates load.
fn faults(plan: &Plan) -> impl Iterator<Item = &FaultView> {
    plan.faults.iter().filter(|fault| loaded(plan, fault))
}
