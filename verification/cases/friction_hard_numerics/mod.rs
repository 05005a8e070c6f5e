//! Numerical pitfalls of rate-and-state friction: results of naive formulations and of ours.

use super::slider::{self, Kind, Set};
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity::kinds::sliders::Entry;
use asperity_cycles::slider::{self as cycles, SliderState};
use asperity_friction::Failure;
use asperity_friction::component::Component;
use asperity_friction::evolution::stateless::Stateless;
use asperity_friction::evolution::{Evolution, ageing::Ageing, slip::Slip};
use asperity_friction::law::{Drives, Law, RateDependent};
use asperity_friction::point::{Point, Solver};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};
use asperity_ode::Clock;

/// See the README.
pub const CASE: Case = Case {
    name: "friction_hard_numerics",
    readme: include_str!("README.md"),
    covers: &[Capability::PointSolver, Capability::LawFamily, Capability::Slider],
    quick: true,
    run,
};

const V_REF: f64 = 1e-6;

/// A row of the table: pitfall, naive result, our result.
type Row = [String; 3];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let rows = [
        rest(ledger)?,
        lagged(ledger)?,
        small_steps(ledger)?,
        net_force(ledger)?,
        overflow(ledger)?,
        decades(ledger)?,
        stopping(ledger)?,
        swallowed(ledger)?,
        durations(ledger)?,
    ];
    ledger.table("Traps", &["trap", "naive form", "here"], rows);
    Ok(())
}

fn row(trap: &str, naive: impl std::fmt::Display, ours: impl std::fmt::Display) -> Row {
    [trap.to_string(), naive.to_string(), ours.to_string()]
}

/// The unregularised logarithm at V = 0.
fn rest(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let naive = 0.6 + 0.01 * f64::ln(0.0 / V_REF);
    let parameters = || Parameters::new(0.6, 0.01, V_REF);
    let bare = RateLaw::new(Bare(parameters()?), Stateless, 1.0, None)?;
    let mut mu = [0.0];
    let refused = bare.coefficient(&[1e6], &[0.0], &[], &mut mu);
    let typed = matches!(refused, Err(Failure::BareLogAtRest { point: 0, rate: 0.0 }));
    ledger
        .claim("the bare logarithm at rest is refused by a typed error that names point and rate")
        .count(u64::from(typed), 1)
        .evidence(Evidence::Exact, "ln 0 does not exist")
        .because("no value is right")
        .record();
    RateLaw::velocity(parameters()?, None)?.coefficient(&[1e6], &[0.0], &[], &mut mu)?;
    Ok(row(
        "bare logarithm at rest, friction coefficient",
        naive,
        format!("typed error; regularised form: {}", mu[0]),
    ))
}

/// Growth factor per step of a small disturbance, with friction from the previous step and a spring; dt = s a f_n/(k V).
fn lagged_growth(s: f64) -> f64 {
    let (a, normal, k, load) = (0.01, 5e6, 1e9, 1e-6);
    let dt = s * a * normal / (k * load);
    let mu = |v: f64| 0.6 + a * (v / V_REF).ln();
    // The slip rate follows from k (u_load - u) = f_n μ(V of the previous step).
    let (mut v, mut traction) = (load * (1.0 + 1e-9), normal * mu(load));
    let mut sizes = Vec::new();
    for _ in 0..200 {
        let next = normal * mu(v);
        let gained = traction + k * load * dt - next;
        (v, traction) = (gained / (k * dt), next);
        sizes.push((v / load - 1.0).abs());
    }
    (sizes[160] / sizes[80]).powf(1.0 / 80.0)
}

/// Below dt = 2 a f_n/(k V) the scheme with friction from the previous step is unstable: it fails for small steps.
fn lagged(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let (mut low, mut high) = (1.5, 2.5);
    while high - low > 1e-9 {
        let middle = 0.5 * (low + high);
        if lagged_growth(middle) > 1.0 { low = middle } else { high = middle }
    }
    ledger
        .claim("friction of the step before: length of step below which it is unstable, in a f_n/(k V)")
        .value(low)
        .equals(2.0)
        .absolute(1e-4)
        .evidence(Evidence::Exact, "e_(n+1) = -r (e_n - e_(n-1)), r = a f_n/(k V dt): |e| grows for r > 1/2")
        .because("a disturbance of 1e-9 leaves nonlinear terms of 1e-9 and rounding of V over 1e-9: 1e-6 in the growth over 80 steps, 1e-5 in the threshold")
        .why_not_tighter("rounding over the disturbance")
        .record();
    // The implicit step with the exact tangent, at a thousandth of that step.
    let form = Bare(Parameters::new(0.6, 0.01, V_REF)?);
    let parts: [Component<Stateless>; 0] = [];
    let mut solver = Solver::new(&form, &parts, 1.0);
    let (a, normal, k, load) = (0.01, 5e6, 1e9, 1e-6);
    let dt = 2e-3 * a * normal / (k * load);
    let mut traction = normal * (0.6 + a * (1.0 + 1e-6f64).ln());
    for _ in 0..3000 {
        let p = Point { normal, drive: traction + k * load * dt, spring: k * dt, dt, guess: None };
        let s = solver.solve(&p, &[])?;
        traction = normal * s.mu;
    }
    let left = ((traction / normal - 0.6) / a).abs() / 1e-6;
    // Each implicit step reduces it by the factor 1 + 2e-3.
    let expected = (1.0 + 2e-3f64).powi(-3000);
    ledger
        .claim("implicit step of a point at a thousandth of that length: what is left of a disturbance after 3000 steps")
        .value(left)
        .equals(expected)
        .absolute(1e-4)
        .evidence(Evidence::Exact, "backward Euler of de/dt = -(k V/a f_n) e")
        .because("a disturbance of 1e-6 in ln V against rounding of ln V of 1e-14 a step and terms of 1e-6")
        .why_not_tighter("rounding of friction over a times the disturbance")
        .record();
    let points: Vec<(f64, f64)> =
        (1..=40).map(|n| 0.1 * f64::from(n)).map(|s| (s, lagged_growth(s))).collect();
    ledger.plot(
        Plot::xy("Friction of the step before", "dt k V/(a f_n) [-]", "growth of a disturbance per step [-]")
            .series(Series::marked("measured", &points))
            .caption("Unstable below 2: an event-limited step control arrives there by design."),
    );
    Ok(row(
        "friction of the step before: growth per step at dt = 0.1 a f_n/(k V)",
        format!("{:.2}", lagged_growth(0.1)),
        format!("decays by {:.3} a step", 1.0 / 1.1),
    ))
}

/// 1 - e^(-x) for steps much shorter than L/V.
fn small_steps(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let (b, length) = (0.015, 1e-5);
    let law = Slip::new(b, length, V_REF)?;
    let z = f64::ln(1e-9);
    let x: f64 = 1e-13;
    // From steady state ∂φ/∂ln V = -b (1 - e^(-x)) = -b (x - x²/2 + ...).
    let found = law.step(law.steady(z), z, x * length / z.exp()).d_log_rate;
    let exact = -b * (x - 0.5 * x * x);
    let naive = -b * (1.0 - (-x).exp());
    ledger
        .claim("dphi/dln V of a step of 1e-13 L, relative error")
        .value((found / exact - 1.0).abs())
        .at_most(1e-14)
        .evidence(Evidence::Exact, "-b (1 - e^-x)")
        .because("rounding of x, of e^z and of the product")
        .why_not_tighter("e^z carries the rounding of z = -20")
        .record();
    Ok(row(
        "1 - e^(-V dt/L) at 1e-13, relative error",
        format!("{:.1e}", (naive / exact - 1.0).abs()),
        format!("{:.1e}", (found / exact - 1.0).abs()),
    ))
}

/// The net force on a creeping mass is the difference of two tractions that agree to almost all digits.
fn net_force(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let set = Set { load: 1e-9, ..slider::INERTIAL };
    let mut plan = set.plan(Kind::Ageing, 1.0, 2000.0)?;
    // Held back by an aged contact it creeps at a thousandth of the load-point rate and accelerates.
    let mut states = vec![0.0];
    plan.system.sliders()[0].law.steady((set.load * 1e-3).ln(), &mut states);
    plan.start = plan.system.start(&[set.load * 1e-3], &[states])?;
    plan.tolerance = 1e-11;
    let mut last = Vec::new();
    let mut look = |now: &SliderState<'_>| last = now.unknowns.to_vec();
    let (run, cost) = Cost::measure(|| cycles::run(&plan, &mut look));
    run?;
    let segment = plan.system.segment(1.0);
    let condition = segment.condition(0, 2000.0, &last);
    let mut rates = vec![0.0; last.len()];
    segment.rates(2000.0, &last, &mut rates);
    // Without mass the slider would gain dV/dt = (k (V_load - V) - f_n dphi/dt) V/(a f_n); mass changes this by its ratio to a
    // f_n/V, about 1e-10 here.
    let ageing = set.b * rates[1];
    let quasi = (set.stiffness * (set.load - condition.rate) - set.normal * ageing) * condition.rate
        / (set.a * set.normal);
    let mass = set.mass.ok_or("the set has mass")?;
    let net = last[2] * set.a * set.normal;
    ledger
        .claim("net force on a creeping mass over its mass, against the quasi-static acceleration, relative error")
        .value((net / mass / quasi - 1.0).abs())
        .at_most(1e-6)
        .evidence(Evidence::SemiAnalytic, "without mass: dV/dt = (k (V_load - V) - f_n dphi/dt) V/(a f_n)")
        .because("tolerance of 1e-11 a step on the unknowns; the net force is slaved to them by a stiffness of 1e9")
        .why_not_tighter("the net force is far below its own absolute tolerance and relaxes from step to step")
        .cost(&cost)
        .record();
    let digits = condition.traction * f64::EPSILON / net.abs();
    Ok(row(
        "T - f_n mu of a creeping mass, relative error",
        format!("{digits:.0e} (rounding of T over the net force)"),
        format!("{:.1e} (an unknown of its own)", (net / mass / quasi - 1.0).abs()),
    ))
}

/// e^((μ0 + φ)/a) for small a.
fn overflow(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let (mu0, a, phi, v) = (0.6, 1e-4, 0.1, 1e-9);
    let naive = a * (v / (2.0 * V_REF) * f64::exp((mu0 + phi) / a)).asinh();
    let form = Regularised(Parameters::new(mu0, a, V_REF)?);
    let found = form.at(f64::ln(v), phi).mu;
    ledger
        .claim("regularised strength at a = 1e-4, where the exponential has 3000 digits")
        .value(found)
        .equals(mu0 + phi + a * (v / V_REF).ln())
        .absolute(1e-15)
        .evidence(Evidence::Exact, "the logarithm, from which it differs by a e^(-14000)")
        .because("rounding of the sum")
        .why_not_tighter("rounding of the sum")
        .record();
    Ok(row("exp((mu0 + phi)/a) at a = 1e-4, friction coefficient", naive, found))
}

/// θ over thirty decades: from 1e-20 s, after 1e10 s at rest, then at 1 m/s.
fn decades(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let length = 1e-5;
    let law = Ageing::new(0.015, length, V_REF)?;
    let theta = |psi: f64| psi.exp() * length / V_REF;
    let start = (1e-20 * V_REF / length).ln();
    let rested = law.step(start, f64::MIN, 1e10).state;
    let slid = law.step(rested, 0.0, 2e-5).state;
    // θ = θ_0 e^-x + (L/V)(1 - e^-x), x = 2.
    let exact = [1e10, 1e10 * f64::exp(-2.0) + length * -f64::exp_m1(-2.0)];
    let error = [(theta(rested), exact[0]), (theta(slid), exact[1])]
        .iter()
        .map(|(a, b)| (a / b - 1.0).abs())
        .fold(0.0, f64::max);
    ledger
        .claim("theta from 1e-20 s through 1e10 s of rest and two L/V of slip at 1 m/s, relative error")
        .value(error)
        .at_most(1e-13)
        .evidence(Evidence::Exact, "theta_0 e^-x + (L/V)(1 - e^-x)")
        .because("ln theta of up to 50 at rounding")
        .why_not_tighter("the rounding of the logarithm")
        .record();
    let naive = 1e10 + 1e-6 * (1.0 - 1e10 / length);
    Ok(row(
        "theta after 1e10 s of rest and 1e-6 s at 1 m/s [s]",
        format!("{naive:.1e} (forward Euler)"),
        format!("{:.3e}", theta(law.step(rested, 0.0, 1e-6).state)),
    ))
}

/// Newton's method in V with an absolute stopping tolerance of 1e-12 m/s, at V = 1e-18 m/s.
fn stopping(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let (a, normal, damping, v) = (0.01, 5e6, 5e6, 1e-18);
    let form = Regularised(Parameters::new(0.6, a, V_REF)?);
    let traction = normal * form.at(f64::ln(v), 0.0).mu + damping * v;
    let mut naive: f64 = 1e-9;
    for _ in 0..50 {
        let s = form.at(naive.ln(), 0.0);
        let step = (traction - normal * s.mu - damping * naive) / (normal * s.d_log_rate / naive + damping);
        if step.abs() < 1e-12 {
            break;
        }
        naive = (naive + step).max(1e-13);
    }
    let law = RateLaw::new(form, Slip::new(0.0, 1e-5, V_REF)?, V_REF, None)?;
    let (mut rate, mut change) = ([0.0], [0.0]);
    let drives = Drives { traction: &[traction], normal: &[normal], damping, near: None };
    law.slip_rates(drives, &[0.0], &mut rate, &mut change)?;
    ledger
        .claim("V = 1e-18 m/s from its traction: error of ln V")
        .value((rate[0] / v).ln().abs())
        .at_most(1e-12)
        .evidence(Evidence::Exact, "the rate the traction was made of")
        .because("rounding of the traction over a f_n: 1e-16 times μ/a = 32, and of 60 in the exponent")
        .why_not_tighter("a few roundings")
        .record();
    Ok(row(
        "V from a traction made of 1e-18 m/s, stopping at 1e-12 m/s",
        format!("{naive:.1e} m/s"),
        format!("{:.15e} m/s", rate[0]),
    ))
}

/// Steps of a nanosecond at 1e9 s.
fn swallowed(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let (mut naive, mut clock) = (1e9, Clock::new(1e9, 0.0));
    let first = clock;
    for n in 0..1000 {
        naive += 1e-9;
        clock = clock.later(1e-9);
        // The local time is moved into the base from time to time, as at every event.
        if n % 100 == 99 {
            clock = clock.rebased();
        }
    }
    let passed = clock.since(&first);
    ledger
        .claim("a thousand steps of 1 ns at 1e9 s: time that has passed")
        .unit("s")
        .value(passed)
        .equals(1e-6)
        .relative(1e-12)
        .evidence(Evidence::Exact, "1000 times 1e-9 s")
        .because("a hundred additions of the local time at rounding")
        .why_not_tighter("a hundred roundings")
        .covers(&[Capability::Events])
        .record();
    Ok(row("a thousand steps of 1 ns at 1e9 s [s]", naive - 1e9, passed))
}

/// Events of the reference cycle last about 14 s; the tenth occurs at 2.7e9 s, where floating-point times are 5e-7 s apart.
fn durations(ledger: &mut Ledger) -> Result<Row, CaseError> {
    let mut plan = slider::REFERENCE.plan(Kind::Ageing, 1.5, 1e12)?;
    slider::events(&mut plan, 10);
    let (run, cost) = Cost::measure(|| slider::finish(&plan));
    let run = run?;
    let events = Entry::from_slider(&run, 0);
    let (third, tenth) = (&events[2], &events[9]);
    let (Some(a), Some(b)) = (third.duration, tenth.duration) else {
        return Err("an event has no end".into());
    };
    ledger
        .claim("duration of the tenth event, at 2.7e9 s, over that of the third")
        .value(b / a)
        .equals(1.0)
        .absolute(1e-10)
        .evidence(Evidence::Exact, "the cycle is periodic after its second event")
        .because("the cycle converges by a factor of 1e5 or more an event; durations are differences of local times")
        .why_not_tighter("a tolerance of 1e-13 over some hundred steps of an event")
        .covers(&[Capability::Events])
        .cost(&cost)
        .record();
    let naive = (tenth.onset + b) - tenth.onset;
    let mut plot = Plot::xy("Reference cycle", "time [s]", "V [m/s]").axes(Axis::Linear, Axis::Log);
    let mut curve = Vec::new();
    let mut look = |now: &SliderState<'_>| curve.push((now.at.seconds(), now.conditions[0].rate));
    plan.tolerance = cycles::DEFAULT_TOLERANCE;
    plan.most_events = Some(3);
    cycles::run(&plan, &mut look)?;
    plot = plot.series(Series::line("V", &curve));
    ledger.plot(plot.caption("Three of the ten events."));
    Ok(row(
        "duration of an event at 2.7e9 s [s]",
        format!("{naive:.10} (difference of times)"),
        format!("{b:.10}"),
    ))
}
