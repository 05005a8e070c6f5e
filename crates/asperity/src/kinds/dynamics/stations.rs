//! Files of stations on faults, in the format of the SEAS community.

use super::moment::Moment;
use super::rows::{Course, Table};
use crate::kinds::faults::stations;
use asperity_output::formats::seas::{Head, Row};
use asperity_plan::dynamics::Plan;
use asperity_plan::faults::cadence::NO_RATE;

/// Tables of the stations of all faults.
pub(super) fn tables<const D: usize>(plan: &Plan<D>) -> Vec<Table<'_>> {
    let mut all = Vec::new();
    for fault in &plan.faults {
        for (name, (asked, point)) in stations::names(fault).into_iter().zip(&fault.stations) {
            let view = &plan.points[*point];
            let location = stations::location(fault, asked, view);
            let plain = stations::plain(&plan.title, &location, view, D == 3);
            let head = Head { opens: opens(plan), ..plain };
            let row = |now: &Moment<'_>| row(plan, now, *point);
            let table = Table::new(format!("stations/{name}"), head.columns(), Course::Rows, row);
            all.push(table.headed(head.text()));
        }
    }
    all
}

fn opens<const D: usize>(plan: &Plan<D>) -> bool {
    plan.problem.fault.as_ref().is_some_and(|f| f.opens)
}

/// Row of a station. A point at rest has the smallest slip rate that files show.
fn row<const D: usize>(plan: &Plan<D>, now: &Moment<'_>, point: usize) -> String {
    let points = plan.points.len();
    let of = |values: &[f64]| -> Vec<f64> { values.iter().skip(point).step_by(points).copied().collect() };
    let states = now.fault.states.len() / points;
    let theta = plan.points[point].theta.filter(|_| states == 1);
    let log_state = theta.map_or(f64::NAN, |theta| theta.log10(now.fault.states[point]));
    let row = Row {
        time: now.time,
        slip: of(&now.fault.slip),
        rate: of(&now.fault.rate).into_iter().map(|v| v.abs().max(NO_RATE)).collect(),
        shear: of(&now.fault.shear),
        log_state,
        normal: now.fault.normal[point],
        opening: opens(plan).then(|| now.fault.gap[point]),
        temperature: None,
        pressure: None,
    };
    row.text()
}
