//! Radiation damping in the point return: `t^e - E_t Δλ = f_n μ(V, states) + η V`.

use super::usual::usual;
use asperity_friction::each_evolution;
use asperity_friction::evolution::{Common, Evolution, stateless::Stateless};
use asperity_friction::law::{Drives, Lag, Law, RateDependent, Regime, Responses, Trials};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Parameters, regularised::Regularised};

/// A function of an increment, its derivative, and the increment.
type Check<'f> = (&'f dyn Fn(f64) -> f64, f64, f64);

const V_REF: f64 = 1e-6;
const A: f64 = 0.01;
const COMMON: Common = Common { mu0: 0.6, a: A, v_ref: V_REF, b: 0.015, length: 1e-5 };
/// About √(G ρ)/2 of granite \[Pa s/m\].
const ETA: f64 = 4.6e6;

fn law<E: Evolution>(evolution: E, limit: Option<f64>) -> RateLaw<Regularised, E> {
    let strength = Regularised(Parameters::new(0.6, A, V_REF).unwrap());
    RateLaw::new(strength, evolution, V_REF, limit).unwrap()
}

fn laws() -> Vec<Box<dyn Law>> {
    let mut laws: Vec<Box<dyn Law>> = vec![Box::new(law(Stateless, None))];
    each_evolution!(Kind => {
        laws.push(Box::new(law(usual::<Kind>(COMMON), None)));
    });
    laws
}

/// A step of a point: its load, and the two-step difference.
#[derive(Clone, Copy, Debug)]
struct Trial {
    normal: f64,
    trial: f64,
    stiffness: f64,
    dt: f64,
    damping: f64,
    lag: (f64, f64),
}

/// τ, Δλ, V, ∂τ/∂|t^e|, ∂τ/∂f_n, and the states.
type Answer = ([f64; 5], Vec<f64>);

fn respond(law: &dyn Law, t: Trial) -> Answer {
    let (mut old, mut states) = (vec![0.0; law.states()], vec![0.0; law.states()]);
    law.initial(&mut old);
    let [mut traction, mut slip, mut rate, mut d_trial, mut d_normal] = [[0.0]; 5];
    let out = Responses {
        traction: &mut traction,
        slip: &mut slip,
        rate: &mut rate,
        regime: &mut [Regime::Stick],
        d_trial: &mut d_trial,
        d_normal: &mut d_normal,
        states: &mut states,
    };
    let lag = Some(Lag { weight: &[t.lag.0], offset: &[t.lag.1] });
    let Trial { normal, trial, stiffness, dt, damping, .. } = t;
    let trials =
        Trials { points: &[0], normal: &[normal], trial: &[trial], stiffness, dt, damping, lag, near: None };
    law.respond(trials, &old, out).unwrap();
    ([traction[0], slip[0], rate[0], d_trial[0], d_normal[0]], states)
}

/// Trials from creep to rates at which most of the traction is radiated, by backward Euler and by two-step differences.
fn trials() -> Vec<Trial> {
    let mut all = Vec::new();
    // Springs so stiff that slip within the step is far below L, and the answer is the only one.
    for (trial, stiffness, dt) in
        [(5.6e6, 1e15, 1e-1), (7e6, 1e15, 1e-5), (2e7, 1e15, 1e-9), (6e6, 1e15, 1e-7)]
    {
        for (normal, lag) in [(9e6, (1.0, 0.0)), (9e6, (1.5, 3e-7)), (4e6, (1.4, 1e-2))] {
            all.push(Trial { normal, trial, stiffness, dt, damping: ETA, lag });
        }
    }
    all
}

#[test]
fn traction_is_strength_and_radiation() {
    for law in laws() {
        let mut radiated = 0.0_f64;
        for t in trials() {
            let ([traction, slip, rate, ..], states) = respond(law.as_ref(), t);
            let mut mu = [0.0];
            law.coefficient(&[t.normal], &[rate], &states, &mut mu).unwrap();
            let balance = [t.trial - t.stiffness * slip, t.normal * mu[0] + t.damping * rate];
            for side in balance {
                assert!(
                    (traction - side).abs() < 1e-9 * t.trial,
                    "{}: {t:?} {traction} {balance:?}",
                    law.name()
                );
            }
            let difference = t.lag.0 * slip / t.dt - t.lag.1;
            assert!(
                (rate - difference).abs() < 1e-9 * (rate.abs() + t.lag.1),
                "{}: {t:?} {rate}",
                law.name()
            );
            radiated = radiated.max(t.damping * rate / traction);
        }
        assert!(radiated > 0.5, "{}: trials radiate {radiated} at most", law.name());
    }
}

#[test]
fn derivatives_with_damping_are_consistent() {
    for law in laws() {
        for t in trials() {
            let ([_, _, _, d_trial, d_normal], _) = respond(law.as_ref(), t);
            let by_trial = |h: f64| respond(law.as_ref(), Trial { trial: t.trial + h, ..t }).0[0];
            let by_normal = |h: f64| respond(law.as_ref(), Trial { normal: t.normal + h, ..t }).0[0];
            let checks: [Check<'_>; 2] =
                [(&by_trial, d_trial, 0.005 * t.trial), (&by_normal, d_normal, 0.005 * t.normal)];
            for (f, derivative, h) in checks {
                let remainder = |h: f64| (f(h) - f(-h) - 2.0 * h * derivative).abs();
                let (coarse, fine) = (remainder(h), remainder(0.5 * h));
                // Third order, unless the remainder is rounding of the traction already.
                let rounding = 1e-9 * t.trial;
                assert!(
                    fine < 0.2 * coarse || coarse < rounding,
                    "{}: {t:?} {derivative} {coarse} {fine}",
                    law.name()
                );
            }
        }
    }
}

/// A rigid spring leaves the balance of a point of a fault under the same traction.
#[test]
fn the_rate_is_that_of_a_fault_under_the_same_traction() {
    let law = law(Stateless, None);
    for t in trials() {
        let ([traction, _, rate, ..], _) = respond(&law, t);
        let mut found = [0.0];
        let drives = Drives { traction: &[traction], normal: &[t.normal], damping: t.damping, near: None };
        law.slip_rates(drives, &[], &mut found, &mut []).unwrap();
        assert!((found[0] / rate - 1.0).abs() < 1e-8, "{t:?}: {rate} {}", found[0]);
    }
}

#[test]
fn a_point_without_normal_traction_or_at_its_limit_still_radiates() {
    let t = Trial { normal: 0.0, trial: 2e6, stiffness: 1e13, dt: 1e-7, damping: ETA, lag: (1.0, 0.0) };
    let ([traction, slip, rate, d_trial, _], _) = respond(&law(Stateless, None), t);
    assert!(
        (traction - ETA * rate).abs() < 1e-9 * t.trial
            && (traction + t.stiffness * slip - t.trial).abs() < 1e-9 * t.trial
    );
    assert!((d_trial * t.trial - traction).abs() < 1e-9 * t.trial);
    let limit = 1e6;
    let ([traction, _, rate, d_trial, d_normal], _) =
        respond(&law(Stateless, Some(limit)), Trial { normal: 9e6, ..t });
    assert!((traction - limit - ETA * rate).abs() < 1e-9 * t.trial && rate > 0.0);
    assert!((d_trial * (t.trial - limit) - (traction - limit)).abs() < 1e-9 * t.trial && d_normal == 0.0);
}
