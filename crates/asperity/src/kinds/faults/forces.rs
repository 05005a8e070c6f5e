//! Forces of faults through a run: integrals of the tractions over the points that slide by friction.

use super::rows::{Course, Table, line};
use asperity_cycles::Moment;
use asperity_output::OutputFile;
use asperity_output::decimals::scientific;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_plan::faults::{FaultView, Plan};

/// The file of the table.
pub(super) const FILE: OutputFile =
    OutputFile::new("fault_forces.csv", "shear and normal force of each fault over time");

/// Unit of forces: in the plane they are per metre of thickness.
fn unit(plan: &Plan) -> &'static str {
    if plan.in_space { "N" } else { "N/m" }
}

/// The table.
pub(super) fn table(plan: &Plan) -> Table<'_> {
    let unit = unit(plan);
    let of_fault = |fault: &FaultView| {
        [
            Column::new(
                "shear_force",
                unit,
                Sign::Along,
                "integral of the shear traction, with that of radiation",
            ),
            Column::new("normal_force", unit, Sign::Compression, "integral of the effective normal traction"),
        ]
        .map(|column| column.for_part(&fault.name))
    };
    let columns = [column::time()].into_iter().chain(plan.faults.iter().flat_map(of_fault)).collect();
    let row = |now: &Moment<'_>| {
        let values = plan.faults.iter().flat_map(|fault| fault_forces(plan, fault, now));
        line(now.at.seconds(), values.map(|value| scientific(value, 9)))
    };
    Table::new(FILE.path, columns, Course::Largest, row)
}

/// Shear force along positive slip, with that of radiation damping, and effective normal force of a fault at a moment \[N; N/m\]. With vector slip the
/// shear force is its component along the rake.
fn fault_forces(plan: &Plan, fault: &FaultView, now: &Moment<'_>) -> [f64; 2] {
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
