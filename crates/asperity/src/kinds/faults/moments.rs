//! Moment rates and moments of faults through a run.

use super::rows::{Course, Table, line};
use asperity_cycles::{Components, Moment};
use asperity_output::decimals::scientific;
use asperity_plan::faults::{FaultView, Plan};

/// Name of the table.
pub(crate) const FILE: &str = "moment_rate.csv";

/// Unit of moments: in the plane they are per metre of thickness.
pub(super) fn unit(plan: &Plan) -> &'static str {
    if plan.in_space { "N m" } else { "N" }
}

/// The table.
pub(super) fn table(plan: &Plan) -> Table<'_> {
    Table::new(FILE, head(&plan.faults, unit(plan)), Course::Largest, |now| row(plan, now))
}

/// Header of the table for moments in this unit.
pub(crate) fn head(faults: &[FaultView], unit: &str) -> String {
    let columns = |name: &str| format!(",moment_rate of {name} [{unit}/s],moment of {name} [{unit}]");
    let columns: String = faults.iter().map(|f| columns(&f.name)).collect();
    format!("time [s]{columns}\n")
}

/// ∫ G |v| dA of each fault, of slip or of slip rates v.
fn of(plan: &Plan, values: &Components<&[f64]>) -> Vec<f64> {
    let at = |p: usize| plan.points[p].shear_modulus * plan.points[p].area * values.size(p);
    plan.faults.iter().map(|f| f.points.clone().map(at).sum()).collect()
}

/// Moment rate of all faults together \[N m/s; N/s in the plane\].
pub(super) fn rate(plan: &Plan, now: &Moment<'_>) -> f64 {
    of(plan, &now.rate).iter().sum()
}

fn row(plan: &Plan, now: &Moment<'_>) -> String {
    let both = of(plan, &now.rate).into_iter().zip(of(plan, &now.slip()));
    line(now.at.seconds(), both.flat_map(|(rate, sum)| [scientific(rate, 9), scientific(sum, 9)]))
}
