//! Profiles along faults in the plane through a run: slip, slip rate and, where there are any, states, coupling, opening and heat.

use super::rows::{Course, Table, line};
use super::{locking, states};
use asperity_cycles::heat::{Heat, PRESSURE, TEMPERATURE};
use asperity_cycles::{Moment, OPENING, Opening};
use asperity_output::decimals::{fixed, scientific};
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::{RATE_CHANGE, log_rate};

/// The tables; none in space, where there are snapshots.
pub(super) fn tables(plan: &Plan) -> Vec<Table<'_>> {
    if plan.in_space {
        return Vec::new();
    }
    let processes = &plan.problem.fault.processes;
    let heat = processes.find::<Heat>();
    let mut all = vec![
        table(
            plan,
            "slip_profiles.csv",
            SELDOM,
            |_, now| now.slip().component(0).to_vec(),
            |u| scientific(u, 6),
        ),
        table(
            plan,
            "rate_profiles.csv",
            OFTEN,
            |_, now| now.rate.component(0).to_vec(),
            |v| fixed(log_rate(v), 3),
        ),
    ];
    let six = |value| scientific(value, 6);
    if processes.find::<Opening>().is_some() {
        all.push(table(
            plan,
            "opening_profiles.csv",
            SELDOM,
            |_, now| now.pressed.of(&OPENING).to_vec(),
            six,
        ));
    }
    if heat.is_some() {
        let values: Values = |_, now| now.pressed.of(&TEMPERATURE).to_vec();
        all.push(table(plan, "temperature_profiles.csv", SELDOM, values, six));
    }
    if heat.is_some_and(Heat::pressurises) {
        let values: Values = |_, now| now.pressed.of(&PRESSURE).to_vec();
        all.push(table(plan, "pressure_profiles.csv", SELDOM, values, six));
    }
    if states::any(plan) {
        all.push(table(plan, states::PROFILES, OFTEN, states::profile, six));
    }
    if locking::any(plan) {
        let course = Course::Time { change: RATE_CHANGE, between_events: true };
        all.push(table(plan, locking::PROFILES, course, locking::profile, six));
    }
    all
}

/// Profiles that do not depend on the change of the largest slip rate.
pub(super) const SELDOM: Course = Course::Time { change: f64::INFINITY, between_events: false };
const OFTEN: Course = Course::Time { change: RATE_CHANGE, between_events: false };

/// Values of all points.
type Values = fn(&Plan, &Moment<'_>) -> Vec<f64>;

fn table<'a>(
    plan: &'a Plan,
    path: &str,
    course: Course,
    values: Values,
    text: fn(f64) -> String,
) -> Table<'a> {
    let along: String = plan.points.iter().map(|p| format!(",{}", p.along)).collect();
    let row = move |now: &Moment<'_>| line(now.at.seconds(), values(plan, now).into_iter().map(text));
    Table::new(path, format!("time [s]{along}\n"), course, row)
}
