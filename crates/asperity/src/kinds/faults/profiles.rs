//! Profiles along faults in the plane through a run: slip, slip rate and, where there are any, states, coupling, opening and heat.

use super::profile::{Profile, RATE, SLIP};
use super::rows::{Course, Table, line};
use super::{locking, pore, states};
use asperity_cycles::heat::{Heat, TEMPERATURE};
use asperity_cycles::{Moment, OPENING, Opening};
use asperity_output::OutputFile;
use asperity_output::decimals::{fixed, scientific};
use asperity_output::tables::Sign;
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::{RATE_CHANGE, log_rate};

/// The tables; none in space, where there are snapshots.
pub(super) fn tables(plan: &Plan) -> Vec<Table<'_>> {
    if plan.in_space {
        return Vec::new();
    }
    let processes = &plan.problem.fault.processes;
    let heat = processes.find::<Heat>();
    let six = |value| scientific(value, 6);
    let mut all = vec![
        table(plan, SLIP, SELDOM, |_, now| now.slip().component(0).to_vec(), six),
        table(plan, RATE, OFTEN, |_, now| now.rate.component(0).to_vec(), |v| fixed(log_rate(v), 3)),
    ];
    if processes.find::<Opening>().is_some() {
        all.push(table(plan, OPEN, SELDOM, |_, now| now.pressed.values(&OPENING).to_vec(), six));
    }
    if heat.is_some() {
        all.push(table(plan, WARMTH, SELDOM, |_, now| now.pressed.values(&TEMPERATURE).to_vec(), six));
    }
    if pore::any(plan) {
        let values: Values = |plan, now| (0..plan.points.len()).map(|p| pore::at(now.pressed, p)).collect();
        all.push(table(plan, FLUID, SELDOM, values, six));
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

/// Files of profiles, those of bodies with mass among them.
pub(crate) const FILES: [OutputFile; 7] =
    [SLIP.0, RATE.0, states::PROFILES.0, locking::PROFILES.0, OPEN.0, WARMTH.0, FLUID.0];

const OPEN: Profile = Profile(
    OutputFile::new("opening_profiles.csv", "opening along a fault at intervals"),
    "m",
    Sign::Apart,
    "separation of the sides",
);
const WARMTH: Profile = Profile(
    OutputFile::new("temperature_profiles.csv", "temperature along a fault at intervals"),
    "K",
    Sign::None,
    "temperature",
);
const FLUID: Profile = Profile(
    OutputFile::new("pressure_profiles.csv", "pore pressure along a fault at intervals"),
    "Pa",
    Sign::None,
    "pore pressure",
);

/// Profiles that do not depend on the change of the largest slip rate.
pub(super) const SELDOM: Course = Course::Time { change: f64::INFINITY, between_events: false };
const OFTEN: Course = Course::Time { change: RATE_CHANGE, between_events: false };

/// Values of all points.
type Values = fn(&Plan, &Moment<'_>) -> Vec<f64>;

fn table<'a>(
    plan: &'a Plan,
    profile: Profile,
    course: Course,
    values: Values,
    text: fn(f64) -> String,
) -> Table<'a> {
    let columns = profile.columns(plan.points.iter().map(|p| p.along.to_string()));
    let row = move |now: &Moment<'_>| line(now.at.seconds(), values(plan, now).into_iter().map(text));
    Table::new(profile.0.path, columns, course, row)
}
