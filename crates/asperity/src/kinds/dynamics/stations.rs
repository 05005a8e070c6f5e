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
    let log_state = match (now.fault.states.view().at(point), plan.points[point].theta) {
        ([state], Some(theta)) => theta.log10(*state),
        _ => f64::NAN,
    };
    let row = Row {
        time: now.time,
        slip: now.fault.slip.at(point).collect(),
        rate: now.fault.rate.at(point).map(|v| v.abs().max(NO_RATE)).collect(),
        shear: now.fault.shear.at(point).collect(),
        log_state,
        normal: now.fault.normal[point],
        opening: opens(plan).then(|| now.fault.gap[point]),
        temperature: None,
        pressure: None,
    };
    row.text()
}
