//! Normal traction that steps, oscillates and vanishes.

use super::slider::{self, Independent, MU0, Set, V_REF};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Series};
use asperity_cycles::slider::Problem;
use asperity_friction::component::Component;
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider};
use asperity_friction::strength::{Parameters, bare::Bare, regularised::Regularised};
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_normal",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::NormalMemory],
    quick: true,
    run,
};

/// Time of the step \[s\].
const STEP: f64 = 1.0;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Independent::read()?;
    for (alpha, name) in [(0.0, "normal_step_alpha_0"), (0.3, "normal_step_alpha_0.3")] {
        step(ledger, &reference, alpha, name)?;
    }
    jump(ledger)?;
    oscillation(ledger, &reference)?;
    unloading(ledger)
}

fn law(alpha: f64) -> Result<Arc<RateLaw<Regularised, Ageing>>, CaseError> {
    let form = Regularised(Parameters::new(MU0, 0.01, V_REF)?);
    let part = Component::new(Ageing::new(0.015, 1e-5, V_REF)?, alpha)?;
    Ok(Arc::new(RateLaw::with_parts(form, vec![part], 1e-6, 5e6, None)?))
}

/// A steady slider at twice the critical stiffness under a normal traction.
fn plan(alpha: f64, normal: History) -> Result<Problem, CaseError> {
    let set = slider::MILD.at(2.0);
    let block = Slider { normal, ..set.slider(law(alpha)?) };
    slider::plan(block, History::Constant(set.load), set.load, 1.0, 1.0)
}

fn compare(ledger: &mut Ledger, title: &str, found: &[(f64, f64)], (v, mu): (&[f64], &[f64]), cost: &Cost) {
    let logs: Vec<f64> = found.iter().map(|f| f.0.ln()).collect();
    let expected: Vec<f64> = v.iter().map(|v| v.ln()).collect();
    ledger
        .claim(format!("{title}: ln V"))
        .values(&logs)
        .equals_each(&expected)
        .absolute(1e-9)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("a tolerance of 1e-13 a step; the reference at 1e-12")
        .why_not_tighter("ln V moves by 1/a = 100 times the error of friction")
        .cost(cost)
        .record();
    let friction: Vec<f64> = found.iter().map(|f| f.1).collect();
    ledger
        .claim(format!("{title}: friction"))
        .values(&friction)
        .equals_each(mu)
        .absolute(1e-11)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("as ln V, times a")
        .why_not_tighter("as ln V")
        .cost(cost)
        .record();
}

fn step(ledger: &mut Ledger, reference: &Independent, alpha: f64, name: &str) -> Result<(), CaseError> {
    // Steady sliding is a solution until the step, where the reference begins. Values just after the step are read a
    // nanosecond later, when ln V has moved by 1e-10.
    let normal = History::table(vec![[STEP, 5e6], [STEP, 5.5e6]])?;
    let times = reference.numbers(name, "t_s")?;
    let late: Vec<f64> = times.iter().filter(|t| **t > 0.0).map(|t| STEP + t).collect();
    let (found, cost) = Cost::measure(|| slider::at_times(&plan(alpha, normal)?, &late));
    let (v, mu) = (reference.numbers(name, "v")?, reference.numbers(name, "mu")?);
    let title = format!("step of the normal traction by 10 %, alpha = {alpha}");
    compare(ledger, &title, &found?, (&v[1..], &mu[1..]), &cost);
    Ok(())
}

/// Jump of ln V without damping, in closed form: a Δln V = T (1/f_2 - 1/f_1) + α ln(f_2/f_1).
fn jump(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (f1, f2, alpha) = (5e6, 5.5e6, 0.3);
    let form = Bare(Parameters::new(MU0, 0.01, V_REF)?);
    let part = Component::new(Ageing::new(0.015, 1e-5, V_REF)?, alpha)?;
    let law = Arc::new(RateLaw::with_parts(form, vec![part], 1e-6, f1, None)?);
    let set = Set { damping: 0.0, ..slider::MILD }.at(2.0);
    let block = Slider { normal: History::table(vec![[STEP, f1], [STEP, f2]])?, ..set.slider(law) };
    let plan = slider::plan(block, History::Constant(set.load), set.load, 1.0, 2.0)?;
    let (before, after) = (plan.system.segment(0.5), plan.system.segment(1.5));
    let mut unknowns = plan.start.clone();
    plan.system.jump(STEP, &before, &after, &mut unknowns)?;
    let found = after.condition(0, STEP, &unknowns).log_rate - set.load.ln();
    let expected = (f1 * MU0 * (1.0 / f2 - 1.0 / f1) + alpha * (f2 / f1).ln()) / 0.01;
    ledger
        .claim("jump of ln V with a sudden step of the normal traction, bare logarithm, alpha = 0.3")
        .value(found)
        .equals(expected)
        .absolute(1e-12)
        .evidence(Evidence::Exact, "traction and f_n^alpha exp(phi) are continuous")
        .because("differences of numbers of the size μ/a = 60 at rounding")
        .why_not_tighter("sixty times the rounding of one, twice")
        .record();
    Ok(())
}

fn oscillation(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    let name = "normal_oscillation";
    let normal = History::sine(5e6, 5e5, 5.0, 0.0)?;
    let times = reference.numbers(name, "t_s")?;
    let (found, cost) = Cost::measure(|| slider::at_times(&plan(0.2, normal)?, &times));
    let (v, mu) = (reference.numbers(name, "v")?, reference.numbers(name, "mu")?);
    let end = times.iter().copied().fold(0.0, f64::max);
    let curve = slider::rates(&Problem { end, ..plan(0.2, History::sine(5e6, 5e5, 5.0, 0.0)?)? })?;
    let points: Vec<(f64, f64)> = times.iter().copied().zip(v.iter().copied()).collect();
    let diagram = slider::through_time("Oscillating normal traction, alpha = 0.2");
    ledger.plot(
        diagram
            .series(Series::line("this code", &curve))
            .series(Series::points("the independent program", &points)),
    );
    compare(ledger, "oscillating normal traction, alpha = 0.2", &found?, (&v, &mu), &cost);
    Ok(())
}

/// Unloading of the normal traction to a millionth of a pascal: damping carries the traction, and V = T/η.
fn unloading(ledger: &mut Ledger) -> Result<(), CaseError> {
    let least = 1e-6;
    for alpha in [0.0, 0.3] {
        let normal = History::table(vec![[1.0, 5e6], [11.0, least]])?;
        // The memory of normal traction drives ln theta to 600 and mu/a to 1000: a tolerance below 1e-12 would be below
        // rounding.
        let plan = Problem { end: 12.0, tolerance: 1e-9, ..plan(alpha, normal)? };
        let (run, cost) = Cost::measure(|| slider::finish(&plan));
        let run = run?;
        let condition = plan.system.segment(11.5).condition(0, 12.0, &run.unknowns);
        let held = condition.friction * least;
        ledger
            .claim(format!("normal traction ramped to 1e-6 Pa, alpha = {alpha}: V η over the traction"))
            .value(condition.rate * slider::MILD.damping / condition.traction)
            .equals(1.0)
            .absolute(2e-6)
            .evidence(Evidence::Exact, "without friction the damping carries the traction")
            .because("the load point moves 1e-6 m/s, so that the damping carries 5 Pa; friction carries f_n μ = 1e-6 Pa times 0.6, or times up to 10 where the memory has aged the contact by e^(alpha ln(f_n)/b)")
            .why_not_tighter("friction is not nothing")
            .cost(&cost)
            .record();
        // The slider follows the load point: V - V_load decays as exp(-k t/η) and vanishes at once.
        ledger
            .claim(format!(
                "normal traction ramped to 1e-6 Pa, alpha = {alpha}: V over the rate of the load point"
            ))
            .value(condition.rate / slider::MILD.load)
            .equals(1.0)
            .absolute(1e-6)
            .evidence(Evidence::Exact, "k (V_load - V) = η dV/dt + d(f_n μ)/dt, at rest after η/k = 1 ms")
            .because("d(f_n μ)/dt of 1e-6 Pa over a second against k V_load of 5e3 Pa/s")
            .why_not_tighter("the state still ages")
            .cost(&cost)
            .record();
        ledger.note(format!(
            "alpha = {alpha}: friction carries {held:.3e} Pa of {:.6} Pa at the end, in {} steps.",
            condition.traction, run.counts.steps
        ));
    }
    Ok(())
}
