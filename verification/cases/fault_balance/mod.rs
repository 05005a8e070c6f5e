//! Balances of a fault through cycles: energy, slip, and a run that restarts.

use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_driver::fault::{Balance, Moment, Plan, Report, Run, Settings, Watcher, resume};
use asperity_driver::ode::{Control, Outcome};

/// See the README.
pub const CASE: Case = Case {
    name: "fault_balance",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::Events, Capability::Determinism],
    quick: true,
    run,
};

/// Sums works, and keeps one of the places where the run restarts.
struct Look<'a> {
    balance: Balance<'a>,
    /// Restarts until the one to keep.
    wait: usize,
    kept: Option<Run>,
}

impl Watcher for Look<'_> {
    fn now(&mut self, moment: &Moment<'_>) -> Control {
        self.balance.step(moment);
        Control::Go
    }

    fn pause(&mut self, run: &Run) -> Control {
        if self.wait == 0 && self.kept.is_none() {
            self.kept = Some(run.clone());
        }
        self.wait = self.wait.saturating_sub(1);
        Control::Go
    }
}

/// A run with its report.
struct Followed {
    run: Run,
    report: Report,
    kept: Option<Run>,
    cost: Cost,
}

fn follow(plan: &Plan, tolerance: f64, start: Option<Run>) -> Result<Followed, CaseError> {
    let settings = Settings { tolerance, ..plan.settings };
    let start = start.unwrap_or_else(|| Run::new(plan.start.clone(), settings.thresholds));
    let mut look = Look { balance: Balance::new(plan), wait: 5, kept: None };
    let (run, cost) = Cost::of(|| resume(&plan.fault, &plan.loading, start, &settings, &mut look));
    if run.outcome != Outcome::Stopped {
        return Err(format!("the run did not end with its events: {:?}", run.outcome).into());
    }
    let cost = cost.count("steps", run.counts.steps as f64);
    let report = Report::new(plan, &run, &mut look.balance);
    Ok(Followed { run, report, kept: look.kept, cost })
}

/// Tolerance of the run whose imbalance is bounded, and of one more exact.
const TOLERANCES: [f64; 2] = [1e-4, 1e-6];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = seas::plan(include_str!("scene.toml"))?;
    let [coarse, fine] = [follow(&plan, TOLERANCES[0], None)?, follow(&plan, TOLERANCES[1], None)?];
    energy(ledger, &coarse, &fine);
    slip(ledger, &fine)?;
    restart(ledger, &plan, &coarse)
}

fn energy(ledger: &mut Ledger, coarse: &Followed, fine: &Followed) {
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

fn slip(ledger: &mut Ledger, found: &Followed) -> Result<(), CaseError> {
    let last = found.report.cycles.last().ok_or("the run has no cycle")?;
    let closure = last.closure().ok_or("the loads drive no steady slip")?;
    ledger
        .claim("slip of the last cycle, in its event and before, over what the loads drive")
        .value(closure)
        .equals(1.0)
        .absolute(1e-3)
        .evidence(Evidence::Exact, "tractions return in a cycle that repeats itself")
        .because("cycles repeat to some 1e-3 after nine events")
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

fn restart(ledger: &mut Ledger, plan: &Plan, whole: &Followed) -> Result<(), CaseError> {
    let kept = whole.kept.clone().ok_or("the run never restarted")?;
    let again = follow(plan, TOLERANCES[0], Some(kept))?;
    let bits = |run: &Run| -> Vec<u64> {
        let events = run.catalogue.events().iter();
        let events = events.flat_map(|e| e.slip.iter().chain(&e.drop).chain([&e.peak]));
        run.unknowns.iter().chain(events).map(|v| v.to_bits()).collect()
    };
    let (a, b) = (bits(&whole.run), bits(&again.run));
    let differ = a.iter().zip(&b).filter(|(a, b)| a != b).count() + a.len().abs_diff(b.len());
    ledger
        .claim("numbers that differ in a run that goes on from its sixth restart")
        .count(differ as u64, 0)
        .evidence(Evidence::Exact, "the run that was not broken off")
        .because("an unbroken run restarts there as well")
        .covers(&[Capability::FaultCycles, Capability::Determinism])
        .cost(&again.cost)
        .record();
    Ok(())
}
