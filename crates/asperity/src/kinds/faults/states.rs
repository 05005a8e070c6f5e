//! The state variable of friction as tables and figures show it: log10 of θ where the law has one, otherwise its first state.

use super::profile::Profile;
use asperity_cycles::Moment;
use asperity_output::OutputFile;
use asperity_output::tables::Sign;
use asperity_plan::faults::{FaultView, Plan};

/// Profile of the state.
pub(super) const PROFILES: Profile = Profile(
    OutputFile::new(
        "state_profiles.csv",
        "state of friction along a fault at intervals: log10 of its time in seconds, where the law has one",
    ),
    "",
    Sign::Log,
    "log10 of the state in seconds, or the first state of a law without it",
);

/// True if the law has a state.
pub(super) fn any(plan: &Plan) -> bool {
    plan.problem.fault.law.states() > 0
}

/// True if the law has a θ at all points of a fault.
pub(super) fn has_theta(plan: &Plan, fault: &FaultView) -> bool {
    let points = || plan.points[fault.points.clone()].iter();
    plan.problem.fault.law.states() == 1 && points().all(|point| point.theta.is_some())
}

/// States of all points.
pub(super) fn profile(plan: &Plan, now: &Moment<'_>) -> Vec<f64> {
    let states = now.states();
    let mut all = Vec::with_capacity(plan.points.len());
    for fault in &plan.faults {
        let theta = has_theta(plan, fault);
        all.extend(fault.points.clone().map(|p| {
            let state = states.at(p)[0];
            plan.points[p].theta.filter(|_| theta).map_or(state, |theta| theta.log10(state))
        }));
    }
    all
}
