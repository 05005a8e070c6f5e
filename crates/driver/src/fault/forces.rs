//! Forces of faults through a run: integrals of the tractions over the points that slide by friction.

use super::plan::{FaultView, Plan};
use asperity_cycles::Moment;
use asperity_output::decimals::scientific;

/// Name of the table.
pub(super) const FILE: &str = "fault_forces.csv";

/// Unit of forces: in the plane they are per metre of thickness.
fn unit(plan: &Plan) -> &'static str {
    if plan.in_space { "N" } else { "N/m" }
}

/// Header of the table.
pub(super) fn head(plan: &Plan) -> String {
    let unit = unit(plan);
    let columns =
        |f: &FaultView| format!(",shear_force of {0} [{unit}],normal_force of {0} [{unit}]", f.name);
    let columns: String = plan.faults.iter().map(columns).collect();
    format!("time [s]{columns}\n")
}

/// Shear force along positive slip, with that of radiation damping, and effective normal force of a fault at a moment \[N; N/m\]. With vector slip the
/// shear force is its component along the rake.
fn of(plan: &Plan, fault: &FaultView, now: &Moment<'_>) -> [f64; 2] {
    let problem = &plan.problem.fault;
    let (m, rate) = (now.m(), now.rate);
    let (mut shear, mut pressed) = (0.0, 0.0);
    for p in fault.points.clone() {
        let (area, normal) = (plan.points[p].area, now.normal(p));
        let resisted = normal * problem.law.scale(p) * m.component(0)[p];
        shear += area * (resisted + problem.damping[p] * rate.component(0)[p]);
        pressed += area * normal;
    }
    [shear, pressed]
}

/// Row of the table.
pub(super) fn row(plan: &Plan, now: &Moment<'_>) -> String {
    let mut row = format!("{:.14e}", now.at.seconds());
    for value in plan.faults.iter().flat_map(|fault| of(plan, fault, now)) {
        row.push(',');
        row.push_str(&scientific(value, 9));
    }
    row.push('\n');
    row
}
