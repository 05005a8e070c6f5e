//! The SEAS benchmark BP2-QD over its full duration: large and small events alternate.

use crate::cases::seas::{self, CycleResults, YEAR};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_cycles::Rupture;
use asperity_plan::faults::Plan;
use asperity_run::Event;

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp2",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::AgeingLaw, Capability::Events],
    quick: false,
    run,
};

const CODES: &str = "codes of the benchmark: large events to the surface alternate with smaller ones";
/// Slip at the surface above which an event counts as large \[m\]: ten years of plate motion.
const LARGE: f64 = 0.3;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = seas::plan(include_str!("../../../scenes/bp2.toml"))?;
    let found = seas::found(&plan, &plan.problem.settings, |_| {})?;
    let large: Vec<bool> =
        found.events.iter().map(|e| e.details.slip.component(0)[0].abs() > LARGE).collect();
    let settled = &large[1..];
    let in_turn = settled.windows(2).filter(|w| w[0] != w[1]).count();
    ledger
        .claim("events from the second on that are followed by one of the other kind")
        .count(in_turn as u64, settled.len() as u64 - 1)
        .evidence(Evidence::OtherCode, CODES)
        .because("all but the last one, which none follows")
        .cost(&found.cost)
        .record();
    ledger
        .claim("events in 1200 yr")
        .value(found.events.len() as f64)
        .at_least(18.0)
        .evidence(Evidence::OtherCode, CODES)
        .because("two a cycle, a cycle of at most 120 yr, after 150 yr to the first")
        .cost(&found.cost)
        .record();
    smaller(ledger, &plan, &found, &large);
    let cycles: Vec<f64> = found.onsets.windows(3).skip(6).map(|w| w[2] - w[0]).collect();
    let spread = cycles.iter().fold(0.0_f64, |m, c| m.max((c / cycles[0] - 1.0).abs()));
    ledger
        .claim("lengths of cycles of two from the seventh event on differ from the first of them by at most, relative")
        .value(spread)
        .at_most(2e-3)
        .evidence(Evidence::ConvergedSelf, "a limit cycle of two events")
        .because("0.2 yr in 100: cells of 156 m leave as much in BP1, and artificial events change cycles by years")
        .cost(&found.cost)
        .record();
    ledger.note(format!("Integrated to {:.1} yr.", plan.problem.settings.end / YEAR));
    Ok(())
}

/// Claim that small events have at most half the slip of large ones.
fn smaller(ledger: &mut Ledger, plan: &Plan, found: &CycleResults, large: &[bool]) {
    let potency = |e: &Event<Rupture>| {
        plan.points.iter().zip(e.details.slip.component(0)).map(|(p, s)| p.area * s.abs()).sum::<f64>()
    };
    let of = |kind: bool| {
        found.events.iter().zip(large).skip(1).filter(move |(_, l)| **l == kind).map(|(e, _)| potency(e))
    };
    let (least, most) = (of(true).fold(f64::INFINITY, f64::min), of(false).fold(0.0, f64::max));
    ledger
        .claim("least moment of a large event over the largest of a small one")
        .value(least / most)
        .at_least(4.0)
        .evidence(Evidence::OtherCode, CODES)
        .because("twice the length and twice the slip")
        .cost(&found.cost)
        .record();
}
