//! Energy budget of spring-sliders through stick-slip cycles.

use super::slider::{self, Kind, Set};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Series};
use asperity::kinds::sliders::{Entry, Report};
use asperity_cycles::Energy;
use asperity_cycles::slider::{Problem, SliderRun, SliderState, run as integrate};
use asperity_ode::Outcome;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_balance",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::AgeingLaw, Capability::SlipLaw, Capability::Events],
    quick: true,
    run,
};

/// Tolerances of the runs; the default is the second.
const TOLERANCES: [f64; 3] = [1e-6, 1e-8, 1e-10];
/// Number of events in each run.
const EVENTS: usize = 5;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, set, kind) in [
        ("mild, ageing law", slider::MILD, Kind::Ageing),
        ("mild, slip law", slider::MILD, Kind::Slip),
        ("hard, ageing law", slider::HARD, Kind::Ageing),
        ("inertial, ageing law", slider::INERTIAL, Kind::Ageing),
        ("inertial, slip law", slider::INERTIAL, Kind::Slip),
    ] {
        closes(ledger, name, &set, kind)?;
    }
    let mut problem = slider::MILD.plan(Kind::Ageing, 1.5, 1e12)?;
    slider::events(&mut problem, EVENTS);
    let curve = Series::line("mild, ageing law", &slider::rates(&problem)?);
    ledger.plot(slider::through_time("Slip rate of one of the runs").series(curve));
    steady(ledger)
}

/// Runs a problem under an observer, which makes it keep an energy budget.
fn observed(problem: &Problem) -> Result<(SliderRun, Energy, Cost), CaseError> {
    let (run, cost) = Cost::measure(|| integrate(problem, &mut |_: &SliderState<'_>| ()));
    let run = run?;
    if let Outcome::Failed { reason } = &run.outcome {
        return Err(format!("failed at {:e} s: {reason}", run.at.seconds()).into());
    }
    let energy = run.progress.budget.ok_or("a run that was observed has no energy budget")?.energy();
    let cost = cost.counts(&Report::new(problem, &run).counts);
    Ok((run, energy, cost))
}

fn closes(ledger: &mut Ledger, name: &str, set: &Set, kind: Kind) -> Result<(), CaseError> {
    for tolerance in TOLERANCES {
        let mut problem = set.plan(kind, 1.5, 1e12)?;
        slider::events(&mut problem, EVENTS);
        (problem.method, problem.tolerance) = (slider::method(set).0, tolerance);
        let (run, energy, cost) = observed(&problem)?;
        claim(ledger, &format!("{name}, {EVENTS} events"), set, tolerance, (&run, energy, &cost));
        if set.mass.is_some() {
            // The kinetic energy vanishes by the end of an event and is largest in the middle.
            let first = Entry::all(&run).into_iter().next().ok_or("no event")?;
            let until = first.onset + 0.5 * first.duration.ok_or("the event has no end")?;
            let (run, energy, cost) = observed(&Problem { end: until, most_events: None, ..problem })?;
            claim(ledger, &format!("{name}, amid an event"), set, tolerance, (&run, energy, &cost));
        }
    }
    Ok(())
}

fn claim(
    ledger: &mut Ledger,
    name: &str,
    set: &Set,
    tolerance: f64,
    (run, energy, cost): (&SliderRun, Energy, &Cost),
) {
    let steps = run.counts.steps as f64;
    ledger
        .claim(format!("{name}: imbalance of energy over its largest part, tolerance {tolerance:e}"))
        .value(energy.imbalance())
        .at_most(set.a / slider::MU0 * steps.sqrt() * tolerance)
        .evidence(
            Evidence::Exact,
            "work of the load point = elastic energy + friction + radiation + kinetic energy",
        )
        .because(
            "an error of ln V of one tolerance in each step moves friction by a/f of it, and those of all steps add up like a random \
             walk",
        )
        .why_not_tighter(
            "most steps of hard and inertial cycles lie where nothing slips, and an implicit method errs by less than its estimate",
        )
        .cost(cost)
        .record();
}

/// A slider that slides steadily from the start: all work of the load point goes into friction and damping.
fn steady(ledger: &mut Ledger) -> Result<(), CaseError> {
    const END: f64 = 1e4;
    let set = slider::MILD.at(2.0);
    let problem = set.plan(Kind::Ageing, 1.0, END)?;
    let (_, energy, cost) = observed(&problem)?;
    // μ = μ_0 at the reference rate, which is that of the load point, and damping carries η V.
    let [friction, radiated] =
        [slider::MU0 * set.normal * set.load * END, set.damping * set.load * set.load * END];
    ledger
        .claim("steady sliding for 10000 s: friction, radiation, work of loads")
        .unit("J/m2")
        .values(&[energy.friction, energy.radiated, energy.loads])
        .equals_each(&[friction, radiated, friction + radiated])
        .relative(2e-14)
        .evidence(Evidence::Exact, "f_n μ_0 V t, η V² t and their sum")
        .because("the state is steady: rounding of 466 steps of four points each")
        .why_not_tighter("rounding adds up like a random walk here, and need not on another processor")
        .cost(&cost)
        .record();
    ledger
        .claim("steady sliding for 10000 s: elastic energy over the work of loads")
        .value(energy.elastic / energy.loads)
        .at_most(1e-26)
        .evidence(Evidence::Exact, "the spring keeps its length")
        .because("the square of rounding in slip, some 1e-14 of it after 466 steps, times k u/(2 f) = 2")
        .why_not_tighter("slip and load point have equal rounding here, which is luck")
        .cost(&cost)
        .record();
    Ok(())
}
