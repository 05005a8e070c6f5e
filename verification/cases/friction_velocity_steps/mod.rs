//! Velocity steps under rigid loading, and slide-hold-slide.

use super::slider::{self, Independent, Kind, Set, V_REF};
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_friction::evolution::{Evolution, Speed, ageing::Ageing, prz::Prz, slip::Slip};
use asperity_friction::slider::History;
use asperity_ode::{Clock, Control, Method, Occurrence, Options, Outcome, Problem, Sink, Step};

/// See the README.
pub const CASE: Case = Case {
    name: "friction_velocity_steps",
    readme: include_str!("README.md"),
    covers: &[Capability::AgeingLaw, Capability::SlipLaw, Capability::Integrators],
    quick: true,
    run,
};

const LENGTH: f64 = 1e-5;
const B: f64 = 0.015;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (slip, ageing) = (Slip::new(B, LENGTH, V_REF)?, Ageing::new(B, LENGTH, V_REF)?);
    let prz = Prz::new(B, LENGTH, V_REF)?;
    let mut plot = Plot::xy(
        "Step of the slip rate from 1e-7 to 1e-5 m/s",
        "slip over L [-]",
        "state part of friction [-]",
    );
    for (v1, v2) in [(1e-7, 1e-5), (1e-5, 1e-7), (1e-12, 1e-2)] {
        let closed = |x: f64| slip.steady(f64::ln(v2)) + B * f64::ln(v2 / v1) * (-x).exp();
        let a =
            stepped(ledger, "slip law", &slip, (v1, v2), closed, "phi - phi_ss = b ln(V2/V1) e^(-V2 t/L)")?;
        let closed =
            |x: f64| B * (V_REF / LENGTH * (LENGTH / v2 + (LENGTH / v1 - LENGTH / v2) * (-x).exp())).ln();
        let b = stepped(
            ledger,
            "ageing law",
            &ageing,
            (v1, v2),
            closed,
            "theta = L/V2 + (L/V1 - L/V2) e^(-V2 t/L)",
        )?;
        let closed = |x: f64| {
            // u = V2 θ/2L from u_0 = V2/V1: tanh or coth of x/2 + atanh of u_0 or its inverse.
            let u0: f64 = v2 / v1;
            let u = if u0 < 1.0 {
                (0.5 * x + u0.atanh()).tanh()
            } else {
                1.0 / (0.5 * x + (1.0 / u0).atanh()).tanh()
            };
            B * (V_REF / v2 * u).ln()
        };
        let c = stepped(
            ledger,
            "PRZ law",
            &prz,
            (v1, v2),
            closed,
            "V2 theta/2L = tanh or coth of V2 t/2L + const",
        )?;
        if v2 == 1e-5 {
            plot = plot
                .series(Series::line("slip law", &a))
                .series(Series::line("ageing law", &b))
                .series(Series::line("PRZ law", &c));
        }
    }
    ledger.plot(plot.caption("From the integrator."));
    slide_hold_slide(ledger)
}

/// The state at constant slip rate, as a problem for the integrator.
struct State<'a, E> {
    evolution: &'a E,
    speed: Speed,
}

impl<E: Evolution> Problem for State<'_, E> {
    fn size(&self) -> usize {
        1
    }

    fn rates(&self, _: Clock, y: &[f64], dy: &mut [f64]) {
        dy[0] = self.evolution.rate(y[0], self.speed).rate;
    }

    fn jacobian(&self, _: Clock, y: &[f64], jac: &mut [f64]) {
        jac[0] = self.evolution.rate(y[0], self.speed).d_state;
    }
}

/// Records the solution at the ends of steps.
struct Keep(Vec<(f64, f64)>);

impl Sink for Keep {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        self.0.push((step.end.seconds(), step.state[0]));
        Control::Go
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}

/// A velocity step: by the exact update of the law, in one step and in many, and by the integrator.
fn stepped<E: Evolution>(
    ledger: &mut Ledger,
    name: &str,
    e: &E,
    (v1, v2): (f64, f64),
    closed: impl Fn(f64) -> f64,
    formula: &str,
) -> Result<Vec<(f64, f64)>, CaseError> {
    let (start, speed) = (e.steady(f64::ln(v1)), Speed::from_log(f64::ln(v2)));
    let xs: Vec<f64> = (1..=60).map(|n| 0.1 * f64::from(n)).collect();
    let mut walking = start;
    let mut error: f64 = 0.0;
    for &x in &xs {
        let at_once = e.step(start, speed.log, x * LENGTH / v2).state;
        walking = e.step(walking, speed.log, 0.1 * LENGTH / v2).state;
        error = error.max((e.phi(at_once) - closed(x)).abs()).max((e.phi(walking) - closed(x)).abs());
    }
    ledger
        .claim(format!("{name}, V from {v1:e} to {v2:e} m/s: exact step, in one go and in sixty"))
        .value(error)
        .at_most(1e-14)
        .evidence(Evidence::Exact, formula)
        .because("logarithms up to 30 times b = 0.015 at rounding, sixty times")
        .why_not_tighter("rounding of the largest logarithm")
        .covers(&[Capability::AgeingLaw, Capability::SlipLaw, Capability::LawFamily])
        .record();
    let problem = State { evolution: e, speed };
    let tolerance = 1e-12;
    let options = Options {
        method: Method::Dop853,
        rtol: tolerance,
        atol: vec![tolerance],
        first_step: None,
        begin_stiff: false,
        largest_step: None,
        most_steps: 100_000,
    };
    let mut keep = Keep(Vec::new());
    let (end, cost) = Cost::measure(|| {
        asperity_ode::integrate(
            &problem,
            Clock::new(0.0, 0.0),
            &[start],
            6.0 * LENGTH / v2,
            &options,
            &mut keep,
        )
    });
    if end.outcome != Outcome::Completed {
        return Err(format!("{name}: {:?}", end.outcome).into());
    }
    let x = |t: f64| t * v2 / LENGTH;
    let error = keep.0.iter().map(|(t, s)| (e.phi(*s) - closed(x(*t))).abs()).fold(0.0, f64::max);
    ledger
        .claim(format!("{name}, V from {v1:e} to {v2:e} m/s: integrated, at all steps"))
        .value(error)
        .at_most(1e-11)
        .evidence(Evidence::Exact, formula)
        .because("a tolerance of 1e-12 a step relative to the state of up to 25, over a hundred steps, contracted as e^(-x)")
        .why_not_tighter("the tolerance is that of a step, the error is what is left of all")
        .cost(&cost.count("right-hand sides", end.counts.rates as f64).count("steps", end.counts.steps as f64))
        .record();
    Ok(keep.0.iter().map(|(t, s)| (x(*t), e.phi(*s))).collect())
}

fn slide_hold_slide(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Independent::read()?;
    let set = slider::MILD.at(5.0);
    let mut plot =
        Plot::xy("Healing", "hold time [s]", "peak friction above steady [-]").axes(Axis::Log, Axis::Linear);
    for (name, kind) in [("slide_hold_slide_ageing", Kind::Ageing), ("slide_hold_slide_slip", Kind::Slip)] {
        let holds = reference.numbers(name, "hold_s")?;
        let expected = reference.numbers(name, "peak_minus_steady_mu")?;
        let (found, cost) =
            Cost::measure(|| holds.iter().map(|&t| healing(&set, kind, t)).collect::<Result<Vec<_>, _>>());
        let found = found?;
        let law = if kind == Kind::Ageing { "ageing law" } else { "slip law" };
        ledger
            .claim(format!("slide-hold-slide, {law}: peak friction above steady after holds of 1 s to 1e4 s"))
            .values(&found)
            .equals_each(&expected)
            .absolute(1e-11)
            .evidence(Evidence::OtherCode, slider::SOURCE)
            .because("a tolerance of 1e-13 a step on mu/a, times a, over a hundred steps; the peak is found to second order")
            .why_not_tighter("reference and steps are known to that")
            .cost(&cost)
            .record();
        let points: Vec<(f64, f64)> = holds.into_iter().zip(found).collect();
        plot = plot.series(Series::marked(law, &points));
    }
    ledger
        .plot(plot.caption("k = 5 k_c; the ageing law heals by b a factor e of time, the slip law by less."));
    // Under rigid loading the ageing law heals by b ln(1 + V t/L): the limit of stiff springs.
    let hold = 1000.0;
    let expected = B * (1.0 + slider::MILD.load * hold / LENGTH).ln();
    let mut levels = Vec::new();
    for ratio in [250.0, 1000.0, 4000.0] {
        let set = Set { damping: 0.0, ..slider::MILD }.at(ratio);
        levels.push((1.0 / ratio, (healing(&set, Kind::Ageing, hold)? - expected).abs()));
    }
    ledger
        .order("slide-hold-slide, ageing law: healing against rigid loading, in the compliance of the spring")
        .levels(&levels)
        .expected(1.0)
        .within(0.35)
        .finest(5e-4, "the slider relaxes by a ln of the hold time over the stiffness; slip of that size heals less, by b over L")
        .evidence(Evidence::Exact, "b ln(1 + V t/L) under rigid loading")
        .because("first order with a logarithm of the compliance, from the relaxation during the hold")
        .record();
    Ok(())
}

/// Peak friction above steady state after a hold of the load point.
fn healing(set: &Set, kind: Kind, hold: f64) -> Result<f64, CaseError> {
    let begin = 1.0;
    let (stop, go) = (begin, begin + hold);
    let load = History::table(vec![[stop, set.load], [stop, 0.0], [go, 0.0], [go, set.load]])?;
    let plan = slider::plan(set.slider(set.law(kind)?), load, set.load, 1.0, go + 200.0)?;
    Ok(slider::largest_friction(&plan, go)? - slider::MU0)
}
