//! Moment rates and moments of faults through a run.

use super::plan::Plan;
use asperity_cycles::{Components, Moment};
use asperity_output::decimals::scientific;

/// Name of the table.
pub(super) const FILE: &str = "moment_rate.csv";

/// Unit of moments: in the plane they are per metre of thickness.
pub(super) fn unit(plan: &Plan) -> &'static str {
    if plan.in_space { "N m" } else { "N" }
}

/// Header of the table.
pub(super) fn head(plan: &Plan) -> String {
    let unit = unit(plan);
    let columns = |name: &str| format!(",moment_rate of {name} [{unit}/s],moment of {name} [{unit}]");
    let columns: String = plan.faults.iter().map(|f| columns(&f.name)).collect();
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

/// Row of the table.
pub(super) fn row(plan: &Plan, now: &Moment<'_>) -> String {
    let mut row = format!("{:.14e}", now.at.seconds());
    for (rate, sum) in of(plan, &now.rate).into_iter().zip(of(plan, &now.slip())) {
        for value in [rate, sum] {
            row.push(',');
            row.push_str(&scientific(value, 9));
        }
    }
    row.push('\n');
    row
}
