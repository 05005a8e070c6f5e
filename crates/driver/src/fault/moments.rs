//! Moment rates and moments of faults through a run.

use super::plan::Plan;
use super::rows::{Course, Table, line};
use asperity_cycles::{Components, Moment};
use asperity_output::decimals::scientific;

/// Name of the table.
pub(super) const FILE: &str = "moment_rate.csv";

/// Unit of moments: in the plane they are per metre of thickness.
pub(super) fn unit(plan: &Plan) -> &'static str {
    if plan.in_space { "N m" } else { "N" }
}

/// The table.
pub(super) fn table(plan: &Plan) -> Table<'_> {
    let unit = unit(plan);
    let columns = |name: &str| format!(",moment_rate of {name} [{unit}/s],moment of {name} [{unit}]");
    let columns: String = plan.faults.iter().map(|f| columns(&f.name)).collect();
    Table::new(FILE, format!("time [s]{columns}\n"), Course::Largest, |now| row(plan, now))
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
