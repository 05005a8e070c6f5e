//! The largest slip rate through a run, with means over the faults.

use super::rows::{Course, Table, line};
use asperity_cycles::Moment;
use asperity_output::decimals::{fixed, scientific};
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::log_rate;

/// Columns of the table. Means are weighted by area; for vector slip they are of the components along the rake.
const HEAD: &str = "time [s],log10 slip_rate [m/s],point,mean shear_traction [Pa],mean slip [m]\n";

/// The table.
pub(super) fn table(plan: &Plan) -> Table<'_> {
    Table::new("largest_rate.csv", HEAD.into(), Course::Largest, |now| row(plan, now))
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
