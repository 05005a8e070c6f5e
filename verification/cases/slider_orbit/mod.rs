//! Large perturbations under the slip law: the conserved quantity at k = k_c, closed orbits, the threshold of run-away.

use super::slider::{self, Independent, Set, V_REF};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity::kinds::sliders::{Entry, Report};
use asperity_cycles::Thresholds;
use asperity_cycles::slider::{self as cycles, Problem, SliderState};
use asperity_friction::evolution::slip::Slip;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::History;
use asperity_friction::strength::{Parameters, bare::Bare};
use asperity_ode::Outcome;
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_orbit",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::SlipLaw],
    quick: true,
    run,
};

/// Initial perturbation of ln V that starts the orbit.
const KICK: f64 = 0.5;

fn base() -> Set {
    Set { damping: 0.0, ..slider::MILD }
}

/// A plan with the bare logarithm, for which the theory holds.
fn plan(set: &Set, mu0: f64, kick: f64, end: f64) -> Result<Problem, CaseError> {
    let form = Bare(Parameters::new(mu0, set.a, V_REF)?);
    let law = RateLaw::new(form, Slip::new(set.b, set.length, V_REF)?, set.load, None)?;
    slider::plan(set.slider(Arc::new(law)), History::Constant(set.load), set.load, kick.exp(), end)
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Independent::read()?;
    orbit(ledger, &reference)?;
    thresholds(ledger, &reference)
}

/// G = e^(-x) - 1 + x, x = ln(V/V_load), without cancellation near 0.
fn bowl(x: f64) -> f64 {
    (-x).exp_m1() + x
}

/// H = [(b - a) G(x) + f - a] e^(f/a), f = μ - μ_ss: conserved at k = k_c.
fn conserved(set: &Set, x: f64, f: f64) -> f64 {
    ((set.b - set.a) * bowl(x) + f - set.a) * (f / set.a).exp()
}

/// Root of an increasing or decreasing function between two bounds, by bisection to rounding.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(high) > 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (f(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// Extremes of ln(V/V_load) on the orbit with a conserved quantity H: there f = -(b-a) G, so that H = -a e^(-(b-a) G/a).
fn extremes(set: &Set, conserved: f64) -> [f64; 2] {
    let depth = set.a / (set.b - set.a) * (set.a / -conserved).ln();
    [bisect(0.0, 10.0, |x| bowl(x) - depth), bisect(-10.0, 0.0, |x| bowl(x) - depth)]
}

fn orbit(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    let set = base().at(1.0);
    let mut plan = plan(&set, slider::MU0, KICK, 2000.0)?;
    // Crossings of the initial rate give the period, and extremes of V the size of the orbit.
    let threshold = set.load * KICK.exp();
    plan.events = Some(Thresholds { on: threshold * (1.0 + 1e-9), off: set.load });
    plan.peaks = true;
    plan.most_events = Some(8);
    let steady = slider::MU0;
    let first = conserved(&set, KICK, set.a * KICK);
    let (mut drift, mut curve): (f64, Vec<(f64, f64)>) = (0.0, Vec::new());
    let mut look = |now: &SliderState<'_>| {
        let c = now.conditions[0];
        let (x, f) = (c.log_rate - set.load.ln(), c.friction - steady);
        drift = drift.max((conserved(&set, x, f) / first - 1.0).abs());
        curve.push((x, f * 1e3));
    };
    let (run, cost) = Cost::measure(|| cycles::run(&plan, &mut look));
    let run = run?;
    let cost = cost.counts(&Report::new(&plan, &run).counts);
    ledger
        .claim("conserved quantity over eight closed orbits, largest relative change")
        .value(drift)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "H = [(b-a)(e^-x - 1 + x) + f - a] e^(f/a), a first integral at k = k_c")
        .because("tolerance of 1e-13 a step over some 1000 steps, and dense output between them; H amplifies errors of f by 1/a")
        .why_not_tighter("dense output is an order below the steps")
        .cost(&cost)
        .record();
    let events: Vec<_> = Entry::from_slider(&run, 0).into_iter().filter(|e| e.duration.is_some()).collect();
    let last = events.last().ok_or("no orbit was closed")?;
    let found = [(last.peak_rate / set.load).ln(), (last.least_rate / set.load).ln()];
    ledger
        .claim("extremes of ln(V/V_load) on the closed orbit")
        .values(&found)
        .equals_each(&extremes(&set, first))
        .absolute(1e-9)
        .evidence(Evidence::Exact, "roots of e^-x - 1 + x = (a/(b-a)) ln(a/-H)")
        .because("the orbit is as good as the conserved quantity; extremes are found as events")
        .why_not_tighter("eight orbits of a neutral oscillation add up their errors")
        .cost(&cost)
        .record();
    let period = last.interval.ok_or("one orbit only")?;
    ledger
        .claim("period of the closed orbit")
        .unit("s")
        .value(period)
        .equals(reference.number("periodic_orbit", "period_s")?)
        .relative(1e-9)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("as above")
        .why_not_tighter("as above")
        .cost(&cost)
        .record();
    curve.truncate(2000);
    ledger.plot(
        crate::Plot::xy(
            "Closed orbit of the slip law at k = k_c",
            "ln(V/V_load) [-]",
            "1000 (friction - steady) [-]",
        )
        .series(crate::Series::line("eight orbits", &curve))
        .caption("Eight orbits on top of each other."),
    );
    Ok(())
}

/// e-folds of V above the rate of the load point at which a slider that still accelerates counts as a run-away. Orbits
/// on the two sides of the separatrix diverge as e^(c x/(a k/k_c)), some 1e5 at this x for the stiffest spring here.
/// With twice as many e-folds, squares of rates would overflow.
const AWAY: usize = 280;
/// e-folds after which time restarts from zero: run-away takes finite time, and steps vanish towards it.
const PIECE: usize = 20;

/// Coefficient of friction at the reference rate of sliders that run away: it falls by (b - a) [`AWAY`] = 1.4 and must
/// stay above zero, where the bare form ends. The motion depends on differences of friction only.
const HIGH: f64 = 4.0;

/// True if the slider runs away after a kick: it passes [`AWAY`] before it turns.
fn runs_away(set: &Set, kick: f64) -> Result<bool, CaseError> {
    let mut plan = plan(set, HIGH, kick, 200.0 * set.length / set.load)?;
    (plan.tolerance, plan.peaks, plan.most_events) = (1e-12, true, Some(1));
    // The separatrix of the equations lies at rates that no rock has.
    plan.fastest = f64::INFINITY;
    // Below its initial rate the slider has turned, and what follows does not matter.
    let turning = kick + set.load.ln() - 0.5;
    for level in (2 * PIECE..=AWAY).step_by(PIECE) {
        let on = set.load * (level as f64).exp();
        plan.events = Some(Thresholds { on, off: 0.5 * on });
        let (mut turned, mut reached) = (false, None);
        let mut look = |now: &SliderState<'_>| {
            turned |= now.conditions[0].log_rate < turning;
            if reached.is_none() && now.conditions[0].rate >= on * (1.0 - 1e-9) {
                reached = Some(now.unknowns.to_vec());
            }
        };
        let run = cycles::run(&plan, &mut look)?;
        let Some(unknowns) = reached.filter(|_| !turned) else {
            return match run.outcome {
                Outcome::Failed { reason } => Err(reason.to_string().into()),
                Outcome::Completed | Outcome::Stopped => Ok(false),
            };
        };
        plan.start = unknowns;
        plan.end = 200.0 * set.length / on;
    }
    Ok(true)
}

/// Smallest kick that leads to run-away, by bisection.
fn threshold(set: &Set, guess: f64, width: f64) -> Result<f64, CaseError> {
    let (mut low, mut high) = (guess - width, guess + width);
    if runs_away(set, low)? || !runs_away(set, high)? {
        return Err(format!("the threshold is not within {width} of {guess}").into());
    }
    while high - low > 1e-10 * guess {
        let middle = 0.5 * (low + high);
        if runs_away(set, middle)? { high = middle } else { low = middle }
    }
    Ok(0.5 * (low + high))
}

fn thresholds(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    let set = base();
    // At k = k_c the separatrix is H = 0: b (x - 1) + (b - a) e^-x = 0.
    let exact = bisect(0.0, 1.0, |x| set.b * (x - 1.0) + (set.b - set.a) * (-x).exp());
    let (found, cost) = Cost::measure(|| threshold(&set.at(1.0), exact, 0.1));
    ledger
        .claim("run-away threshold ln(V/V_load) of a kick, k = k_c")
        .value(found?)
        .equals(exact)
        .absolute(1e-8)
        .evidence(Evidence::Exact, "separatrix H = 0 of the conserved quantity: b (x - 1) + (b - a) e^-x = 0")
        .because("bisection to 1e-10; the separatrix is left exponentially, so that steps at 1e-12 are seen as 1e-11 to 1e-9")
        .why_not_tighter("the error depends on how long the orbit stays near the separatrix")
        .cost(&cost)
        .record();
    for ratio in [1.1, 1.5, 2.0] {
        let expected = reference.number("runaway_threshold", &format!("ln_v_over_v_load_k_{ratio}_k_c"))?;
        let (found, cost) = Cost::measure(|| threshold(&set.at(ratio), expected, 0.1));
        ledger
            .claim(format!("run-away threshold ln(V/V_load) of a kick, k = {ratio} k_c"))
            .value(found?)
            .equals(expected)
            .absolute(1e-8)
            .evidence(Evidence::OtherCode, slider::SOURCE)
            .because("bisections of both to 1e-10, as above")
            .why_not_tighter("as above")
            .cost(&cost)
            .record();
    }
    // For large kicks the motion of the load point is negligible, and the threshold is k/k_c.
    for ratio in [6.0, 9.0, 12.0] {
        let (found, cost) = Cost::measure(|| threshold(&set.at(ratio), ratio, 0.1));
        ledger
            .claim(format!("run-away threshold ln(V/V_load) of a kick, k = {ratio} k_c, against k/k_c"))
            .value(found?)
            .equals(ratio)
            .absolute(3.0 * ratio * f64::exp(-ratio))
            .evidence(Evidence::SemiAnalytic, "x = k/k_c, exact but for terms of V_load/V = e^-x")
            .because("the neglected terms are of the size e^-x times κ/(b-a) = k/k_c")
            .why_not_tighter("the coefficient of e^-x is not known in closed form")
            .cost(&cost)
            .record();
    }
    Ok(())
}
