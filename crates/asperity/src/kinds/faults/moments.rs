//! Moment rates and moments of faults through a run.

use super::rows::{Course, Table, line};
use asperity_cycles::{Components, Moment};
use asperity_output::OutputFile;
use asperity_output::decimals::scientific;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_plan::faults::{FaultView, Plan};

/// Name of the table.
pub(crate) const FILE: OutputFile = OutputFile::new("moment_rate.csv", "moment rate over time");

/// The table.
pub(super) fn table(plan: &Plan) -> Table<'_> {
    Table::new(FILE.path, columns(&plan.faults, !plan.in_space), Course::Largest, |now| row(plan, now))
}

/// Columns of the table, per metre of thickness or not.
pub(crate) fn columns(faults: &[FaultView], per_length: bool) -> Vec<Column> {
    let (rate, sum) = if per_length { ("N/s", "N") } else { ("N m/s", "N m") };
    let of = |fault: &FaultView| {
        [
            Column::new(
                "moment_rate",
                rate,
                Sign::Size,
                "integral of G times slip rate over points that slide by friction",
            ),
            Column::new(
                "moment",
                sum,
                Sign::Size,
                "integral of G times slip over points that slide by friction",
            ),
        ]
        .map(|column| column.for_part(&fault.name))
    };
    [column::time()].into_iter().chain(faults.iter().flat_map(of)).collect()
}

/// ∫ G |v| dA of each fault, of slip or of slip rates v.
fn fault_moments(plan: &Plan, values: &Components<&[f64]>) -> Vec<f64> {
    let at = |p: usize| plan.points[p].shear_modulus * plan.points[p].area * values.size(p);
    plan.faults.iter().map(|f| f.points.clone().map(at).sum()).collect()
}

/// Moment rate of all faults together \[N m/s; N/s in the plane\].
pub(super) fn rate(plan: &Plan, now: &Moment<'_>) -> f64 {
    fault_moments(plan, &now.rate).iter().sum()
}

fn row(plan: &Plan, now: &Moment<'_>) -> String {
    let both = fault_moments(plan, &now.rate).into_iter().zip(fault_moments(plan, &now.slip()));
    line(now.at.seconds(), both.flat_map(|(rate, sum)| [scientific(rate, 9), scientific(sum, 9)]))
}
