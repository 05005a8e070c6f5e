//! Coupling of faults to the plates that load them: how far slip lags behind the motion of the plates.
//!
//! At a point it is c = 1 - V.Vp/Vp.Vp, with the slip rate V and the rate Vp of the plates: 1 where the point is locked, 0 where
//! it creeps with the plates, negative where it is faster. The slip deficit grows at c Vp, the backslip of J. C. Savage,
//! J. Geophys. Res. 88 (1983) 4984, and the moment deficit at the integral of G c |Vp|.

use super::moments;
use super::plan::{FaultView, Plan};
use asperity_cycles::{Components, Moment};
use asperity_output::decimals::scientific;

/// Name of the table.
pub(super) const FILE: &str = "locking.csv";
/// Name of the table of profiles.
pub(super) const PROFILES: &str = "coupling_profiles.csv";

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

/// Header of the table.
pub(super) fn head(plan: &Plan) -> String {
    let unit = moments::unit(plan);
    let columns = |name: &str| format!(",coupling of {name} [-],moment_deficit_rate of {name} [{unit}/s]");
    let columns: String = faults(plan).map(|fault| columns(&fault.name)).collect();
    format!("time [s]{columns}\n")
}

/// Row of the table: the mean coupling of each fault, weighted by G |Vp| dA, and the rate of its moment deficit.
pub(super) fn row(plan: &Plan, now: &Moment<'_>) -> String {
    let mut row = format!("{:.14e}", now.at.seconds());
    for fault in faults(plan) {
        let (mut deficit, mut whole) = (0.0, 0.0);
        for p in fault.points.clone() {
            let point = &plan.points[p];
            let Some(plate) = point.plate else { continue };
            let speed = plate.iter().take(now.rate.components()).map(|v| v * v).sum::<f64>().sqrt();
            let moment = point.shear_modulus * point.area * speed;
            deficit += moment * coupling(plan, &now.rate, p);
            whole += moment;
        }
        for value in [deficit / whole, deficit] {
            row.push(',');
            row.push_str(&scientific(value, 9));
        }
    }
    row.push('\n');
    row
}

/// Faults that plates load.
fn faults(plan: &Plan) -> impl Iterator<Item = &FaultView> {
    plan.faults.iter().filter(|fault| loaded(plan, fault))
}
