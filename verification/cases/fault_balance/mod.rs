//! Balances of a fault through earthquake cycles: energy, slip, and a restarted run.

use crate::cases::cycle_run::CycleRun;
use crate::cases::seas;
use crate::{Capability, Case, CaseError, Evidence, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "fault_balance",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::Events, Capability::Determinism],
    quick: true,
    run,
};

/// Tolerances of the run whose imbalance is bounded and of a more accurate run.
const TOLERANCES: [f64; 2] = [1e-4, 1e-6];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = seas::plan(include_str!("scene.toml"))?;
    let [coarse, fine] = [CycleRun::with(&plan, TOLERANCES[0])?, CycleRun::with(&plan, TOLERANCES[1])?];
    energy(ledger, &coarse, &fine);
    slip(ledger, &fine)?;
    coarse.restarted(ledger, &plan, TOLERANCES[0])
}

fn energy(ledger: &mut Ledger, coarse: &CycleRun, fine: &CycleRun) {
    let from = "work of loads on slip = elastic energy + work of friction + radiated energy";
    for (found, tolerance) in [coarse, fine].into_iter().zip(TOLERANCES) {
        ledger
            .claim(format!("imbalance of energy over its largest part, ten events, tolerance {tolerance:e}"))
            .value(found.report.energy.imbalance)
            .at_most(0.5 * tolerance)
            .evidence(Evidence::Exact, from)
            .because(
                "half a tolerance: an error of ln V of one tolerance in each step moves friction by a/f, a sixtieth, of it, and those of \
                 some thousand steps add up like a random walk",
            )
            .covers(&[Capability::FaultCycles, Capability::Antiplane])
            .cost(&found.cost)
            .record();
    }
}

fn slip(ledger: &mut Ledger, found: &CycleRun) -> Result<(), CaseError> {
    let last = found.report.cycles.last().ok_or("the run has no cycle")?;
    let closure = last.closure().ok_or("the loads drive no steady slip")?;
    ledger
        .claim("slip of the last cycle, in its event and before, over what the loads drive")
        .value(closure)
        .equals(1.0)
        .absolute(1e-3)
        .evidence(Evidence::Exact, "tractions return in a cycle that repeats itself")
        .because("cycles repeat to some 1e-3 after nine events")
        .why_not_tighter("the residual of repetition depends on the phase at which the run ends")
        .covers(&[Capability::FaultCycles, Capability::Events])
        .cost(&found.cost)
        .record();
    ledger
        .claim("imbalance of energy of the last cycle over its largest part, tolerance 1e-6")
        .value(last.energy.imbalance)
        .at_most(1e-6)
        .evidence(Evidence::Exact, "as over the whole run")
        .because("one tolerance: elastic energy and work of loads are differences of sums ten times as large")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
    Ok(())
}
