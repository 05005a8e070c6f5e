//! Two-step differences in slip under laws with states: order, derivatives, and the estimated error of a step.

use super::usual::usual;
use asperity_friction::each_evolution;
use asperity_friction::evolution::flash::{Flash, Weakening};
use asperity_friction::evolution::{Common, Evolution, TableEvolution, slip::Slip};
use asperity_friction::law::{Lag, Law, Regime, Responses, StepOutcome, Trials};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Parameters, regularised::Regularised};

const V_REF: f64 = 1e-6;
const L: f64 = 1e-5;
const NORMAL: f64 = 1e7;
/// About four times the critical stiffness for a and b.
const STIFFNESS: f64 = 2e10;
const A: f64 = 0.01;
const B: f64 = 0.015;

fn law<E: Evolution>(evolution: E) -> RateLaw<Regularised, E> {
    RateLaw::new(Regularised(Parameters::new(0.6, A, V_REF).unwrap()), evolution, V_REF, None).unwrap()
}

/// Laws, beginning with ageing and slip.
fn laws() -> Vec<Box<dyn Law>> {
    let weakening = Weakening { mu0: 0.6, a: A, b: B, v_ref: V_REF, mu_w: 0.2, v_w: 1e-2 };
    let common = Common { mu0: 0.6, a: A, v_ref: V_REF, b: B, length: L };
    let mut laws: Vec<Box<dyn Law>> = Vec::new();
    each_evolution!(Kind => {
        // A state that remembers shear traction jumps at the start of each step, which is of first order: plans warn of it.
        if <Kind as TableEvolution>::DEFINITION.memory.is_none() {
            laws.push(Box::new(law(usual::<Kind>(common))));
        }
    });
    laws.push(Box::new(law(Flash::new(weakening, L).unwrap())));
    laws
}

/// Answer for one point.
struct PointAnswer {
    traction: f64,
    slip: f64,
    rate: f64,
    d_trial: f64,
    d_normal: f64,
    states: Vec<f64>,
}

fn respond(law: &dyn Law, normal: f64, trial: f64, dt: f64, lag: (f64, f64), old: &[f64]) -> PointAnswer {
    let mut states = vec![0.0; law.states()];
    let [mut traction, mut slip, mut rate, mut d_trial, mut d_normal] = [[0.0]; 5];
    law.respond(
        Trials {
            points: &[0],
            normal: &[normal],
            trial: &[trial],
            stiffness: STIFFNESS,
            dt,
            damping: 0.0,
            lag: Some(Lag { weight: &[lag.0], offset: &[lag.1] }),
            near: None,
        },
        old,
        Responses {
            traction: &mut traction,
            slip: &mut slip,
            rate: &mut rate,
            regime: &mut [Regime::Stick],
            d_trial: &mut d_trial,
            d_normal: &mut d_normal,
            states: &mut states,
        },
    )
    .unwrap();
    PointAnswer {
        traction: traction[0],
        slip: slip[0],
        rate: rate[0],
        d_trial: d_trial[0],
        d_normal: d_normal[0],
        states,
    }
}

/// A slider on a spring, with a step of the load to three times its rate. Returns the traction at some multiples of the longest
/// step, and the largest estimated error after the first tenth of the time.
fn march(law: &dyn Law, steps: usize) -> (Vec<f64>, f64) {
    let (load, end) = (3.0 * V_REF, 20.0);
    let dt = end / steps as f64;
    let mut states = vec![0.0; law.states()];
    law.initial(&mut states);
    let mut mu = [0.0];
    law.coefficient(&[NORMAL], &[V_REF], &states, &mut mu).unwrap();
    let (mut traction, mut before, mut past, mut largest) = (mu[0] * NORMAL, V_REF, None, 0.0f64);
    let mut shown = Vec::new();
    for step in 1..=steps {
        let lag = past.map_or((1.0, 0.0), |slip: f64| (1.5, 0.5 * slip / dt));
        let one = respond(law, NORMAL, traction + STIFFNESS * load * dt, dt, lag, &states);
        let mut error = [f64::NAN];
        let outcome = StepOutcome {
            points: &[0],
            normal: &[NORMAL],
            before: &[before],
            rate: &[one.rate],
            slip: &[one.slip],
            dt,
            old: &states,
            new: &one.states,
        };
        law.error(outcome, &mut error);
        // The rate of the load jumps at the start, and V with it.
        if 10 * step > steps {
            largest = largest.max(error[0]);
        }
        (traction, before, past, states) = (one.traction, one.rate, Some(one.slip), one.states);
        if step % (steps / 20) == 0 {
            shown.push(traction / NORMAL);
        }
    }
    (shown, largest)
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn steps_are_of_second_order_with_every_state() {
    for law in laws() {
        let runs = [400, 800, 1600].map(|steps| march(law.as_ref(), steps).0);
        let order = (difference(&runs[0], &runs[1]) / difference(&runs[1], &runs[2])).log2();
        assert!((order - 2.0).abs() < 0.15, "{}: {order}", law.name());
    }
}

/// As plans warn: a step is of first order, and its error is twenty times its estimate.
#[test]
fn steps_with_a_memory_of_shear_traction_are_of_first_order() {
    each_evolution!(Kind => {
        if <Kind as TableEvolution>::DEFINITION.memory.is_some() {
            let law = law(usual::<Kind>(Common { mu0: 0.6, a: A, v_ref: V_REF, b: B, length: L }));
            let runs = [400, 800, 1600].map(|steps| march(&law, steps).0);
            let order = (difference(&runs[0], &runs[1]) / difference(&runs[1], &runs[2])).log2();
            assert!((order - 1.0).abs() < 0.15, "{}: {order}", law.name());
            let (limit, estimated) = (march(&law, 12800).0, march(&law, 400).1);
            let ratio = difference(&runs[0], &limit) / estimated;
            assert!((10.0..50.0).contains(&ratio), "{}: {ratio}", law.name());
        }
    });
}

#[test]
fn the_estimate_is_of_the_size_of_the_error_and_of_its_order() {
    for law in laws() {
        let limit = march(law.as_ref(), 12800).0;
        let [(coarse, estimated), (_, finer)] = [400, 800].map(|steps| march(law.as_ref(), steps));
        let order = (estimated / finer).log2();
        assert!((order - 2.0).abs() < 0.3, "{}: {order}", law.name());
        // The residual of a step relaxes while the load moves by a f_n/k, here over a hundred steps.
        let ratio = difference(&coarse, &limit) / estimated;
        assert!((0.1..10.0).contains(&ratio), "{}: {ratio}", law.name());
    }
}

#[test]
fn nothing_is_missed_in_steady_sliding() {
    for law in laws() {
        let mut states = vec![0.0; law.states()];
        law.initial(&mut states);
        for dt in [0.1, 10.0, 1e4] {
            let mut error = [f64::NAN];
            let slip = [V_REF * dt];
            let rates = [V_REF];
            let outcome = StepOutcome {
                points: &[0],
                normal: &[NORMAL],
                before: &rates,
                rate: &rates,
                slip: &slip,
                dt,
                old: &states,
                new: &states,
            };
            law.error(outcome, &mut error);
            assert!(error[0] < 1e-12, "{} over {dt} s: {}", law.name(), error[0]);
        }
    }
}

#[test]
fn a_state_that_has_forgotten_its_past_follows_the_rate_at_the_end() {
    // V doubles over a step of a thousand L.
    let law = law(Slip::new(0.005, L, V_REF).unwrap());
    let mut old = [0.0];
    law.initial(&mut old);
    let (dt, end) = (1e4, 2.0 * V_REF);
    // V = 3/2 mean - V_REF/2: the step before had V_REF.
    let mean = (end + 0.5 * V_REF) / 1.5;
    let steady = -0.005 * (end / V_REF).ln();
    let mut mu = [0.0];
    law.coefficient(&[NORMAL], &[end], &[steady], &mut mu).unwrap();
    let trial = mu[0] * NORMAL + STIFFNESS * mean * dt;
    let one = respond(&law, NORMAL, trial, dt, (1.5, 0.5 * V_REF), &old);
    assert!((one.states[0] - steady).abs() < 3e-3 * 0.005, "{} {steady}", one.states[0]);
}

#[test]
fn derivatives_follow_states_at_the_mean_rate() {
    for law in laws() {
        let mut old = vec![0.0; law.states()];
        law.initial(&mut old);
        for (dt, trial) in [(0.5, 6.02e6), (2.0, 6.06e6), (10.0, 6.2e6)] {
            let at =
                |normal: f64, trial: f64| respond(law.as_ref(), normal, trial, dt, (1.6, 0.7 * V_REF), &old);
            let one = at(NORMAL, trial);
            for (derivative, by) in [
                (one.d_trial, &(|h: f64| at(NORMAL, trial + h).traction) as &dyn Fn(f64) -> f64),
                (one.d_normal, &|h: f64| at(NORMAL + h, trial).traction),
            ] {
                // Rounding of tractions over h is about 1e-8; the third derivative adds about (h/(a f_n))^2 = 1e-6.
                let h = 100.0;
                let found = (by(h) - by(-h)) / (2.0 * h);
                assert!(
                    (found - derivative).abs() < 1e-5,
                    "{} {dt} {trial}: {found} {derivative}",
                    law.name()
                );
            }
        }
    }
}
