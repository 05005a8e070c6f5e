//! The largest slip rate through a run, with means over the faults.

use super::rows::{Course, Table, line};
use asperity_cycles::Moment;
use asperity_output::OutputFile;
use asperity_output::decimals::{fixed, scientific};
use asperity_output::tables::column::{self, Column, Sign};
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::log_rate;

/// The file of the table.
pub(super) const FILE: OutputFile =
    OutputFile::new("largest_rate.csv", "largest slip rate over time; its logarithm is -20 at rest");

/// Columns of the table. Means are weighted by area; for vector slip they are of the components along the rake.
fn columns() -> Vec<Column> {
    vec![
        column::time(),
        Column::new("log10 slip_rate", "m/s", Sign::Log, "largest slip rate"),
        Column::new("point", "", Sign::None, "number of the fastest point"),
        Column::new("mean shear_traction", "Pa", Sign::Along, "shear traction, averaged over the area"),
        Column::new("mean slip", "m", Sign::Along, "slip, averaged over the area"),
    ]
}

/// The table.
pub(super) fn table(plan: &Plan) -> Table<'_> {
    Table::new(FILE.path, columns(), Course::Largest, |now| row(plan, now))
}

fn row(plan: &Plan, now: &Moment<'_>) -> String {
    let (mut point, mut largest) = (0, 0.0);
    for p in 0..plan.points.len() {
        let speed = now.speed(p);
        if speed > largest {
            (point, largest) = (p, speed);
        }
    }
    let (shear, slip) = means(plan, now);
    let values = [fixed(log_rate(largest), 6), point.to_string(), scientific(shear, 6), scientific(slip, 9)];
    line(now.at.seconds(), values)
}

/// Means over the area of shear traction \[Pa\] and slip \[m\].
fn means(plan: &Plan, now: &Moment<'_>) -> (f64, f64) {
    let (mut area, mut shear, mut slip) = (0.0, 0.0, 0.0);
    let (m, slips) = (now.m(), now.slip());
    for (p, point) in plan.points.iter().enumerate() {
        area += point.area;
        shear += point.area * now.normal(p) * plan.problem.fault.law.scale(p) * m.component(0)[p];
        slip += point.area * slips.component(0)[p];
    }
    (shear / area, slip / area)
}
