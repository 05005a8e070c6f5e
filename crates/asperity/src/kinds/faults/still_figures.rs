//! Maps of faults in space between events, from snapshots: slip rate, coupling, state.

use super::instants::instants;
use super::{locking, snapshots, states};
use asperity_cycles::FaultRun;
use asperity_output::figures::{Plot, Still, Stills};
use asperity_plan::faults::{FaultView, Plan};

/// Largest number of events whose cycles have maps.
const EVENTS: usize = 2;

/// Decades of slip rates below the fastest point that maps show. Slower points are locked.
const DECADES: f64 = 14.0;

/// Maps of each fault, whose shapes have these numbers.
pub(super) fn plots(plan: &Plan, run: &FaultRun, names: &[String], shapes: &[usize]) -> Vec<Plot> {
    if !plan.in_space {
        return Vec::new();
    }
    let chosen: Vec<_> =
        instants(plan, run, EVENTS).into_iter().map(|at| (at.file, at.words, at.time)).collect();
    let of = |((fault, stem), &shape): ((&FaultView, &String), &usize)| {
        Plot::Stills(Stills {
            stem: stem.clone(),
            name: fault.name.clone(),
            snapshots: format!("fields/{}_", fault.name),
            list: snapshots::LIST.path.into(),
            shape,
            chosen: chosen.clone(),
            stills: stills(plan, fault),
        })
    };
    plan.faults.iter().zip(names).zip(shapes).map(of).collect()
}

fn stills(plan: &Plan, fault: &FaultView) -> Vec<Still> {
    let still = |[array, file, name, label]: [&str; 4], range, span| Still {
        array: array.into(),
        file: file.into(),
        name: name.into(),
        label: label.into(),
        range,
        span,
    };
    let rate = ["log10_slip_rate", "rate", "slip rate", "log₁₀ of slip rate [m/s]"];
    let mut all = vec![still(rate, None, Some(DECADES))];
    if locking::loaded(plan, fault) {
        let coupling = ["coupling", "coupling", "coupling", "Coupling [–], below 0 as 0"];
        all.push(still(coupling, Some((0.0, 1.0)), None));
    }
    if states::has_theta(plan, fault) {
        all.push(still(["log10_theta", "state", "state θ", "log₁₀ of θ [s]"], None, None));
    } else if states::any(plan) {
        all.push(still(["state_1", "state", "state variable", "State variable [–]"], None, None));
    }
    all
}
