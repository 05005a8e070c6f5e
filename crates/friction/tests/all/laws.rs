//! The point return and the rate form, over the whole admissible range.

use super::usual::usual;
use asperity_friction::component::Component;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::flash::{Flash, Weakening};
use asperity_friction::evolution::nagata::Nagata;
use asperity_friction::evolution::{
    Common, Evolution, TableEvolution, ageing::Ageing, slip::Slip, stateless::Stateless,
};
use asperity_friction::law::{Lag, Law, PresentStates, Rates, Regime, Responses, Trials};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::arrhenius::Arrhenius;
use asperity_friction::strength::cut_off::CutOff;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};
use asperity_friction::{Failure, each_evolution};
use proptest::prelude::*;

/// Answer for one point.
#[derive(Clone, Copy, Debug)]
struct PointAnswer {
    traction: f64,
    slip: f64,
    rate: f64,
    d_trial: f64,
    d_normal: f64,
}

fn respond(
    law: &dyn Law,
    normal: f64,
    trial: f64,
    stiffness: f64,
    dt: f64,
    lag: Option<(f64, f64)>,
) -> Result<PointAnswer, Failure> {
    let mut old = vec![0.0; law.states()];
    law.initial(&mut old);
    let (weight, offset) = ([lag.map_or(1.0, |l| l.0)], [lag.map_or(0.0, |l| l.1)]);
    let mut new = vec![0.0; law.states()];
    let (mut t, mut s, mut v, mut g, mut dt_, mut dn) = ([0.0], [0.0], [0.0], [Regime::Stick], [0.0], [0.0]);
    law.respond(
        Trials {
            points: &[0],
            normal: &[normal],
            trial: &[trial],
            stiffness,
            dt,
            damping: 0.0,
            lag: lag.map(|_| Lag { weight: &weight, offset: &offset }),
            near: None,
        },
        &old,
        Responses {
            traction: &mut t,
            slip: &mut s,
            rate: &mut v,
            regime: &mut g,
            d_trial: &mut dt_,
            d_normal: &mut dn,
            states: &mut new,
        },
    )?;
    Ok(PointAnswer { traction: t[0], slip: s[0], rate: v[0], d_trial: dt_[0], d_normal: dn[0] })
}

fn velocity_law(a: f64) -> RateLaw<Regularised, Stateless> {
    RateLaw::new(Regularised(Parameters::new(0.6, a, 1e-6).unwrap()), Stateless, 1e-6, None).unwrap()
}

fn state_law<E: Evolution>(evolution: E) -> RateLaw<Regularised, E> {
    RateLaw::new(Regularised(Parameters::new(0.6, 0.01, 1e-6).unwrap()), evolution, 1e-7, None).unwrap()
}

/// Order at which the remainder f(x + h) - f(x) - h f'(x) vanishes.
fn taylor_order(f: impl Fn(f64) -> f64, derivative: f64, h: f64) -> f64 {
    let remainder = |h: f64| (f(h) - f(0.0) - h * derivative).abs();
    (remainder(h) / remainder(0.5 * h)).log2()
}

#[test]
fn derivatives_of_the_point_return_are_consistent() {
    let laws: [Box<dyn Law>; 4] = [
        Box::new(velocity_law(0.01)),
        Box::new(state_law(Ageing::new(0.015, 1e-5, 1e-6).unwrap())),
        Box::new(state_law(Slip::new(0.015, 1e-5, 1e-6).unwrap())),
        Box::new(
            RateLaw::new(Bare(Parameters::new(0.6, 0.01, 1e-6).unwrap()), Stateless, 1e-6, None).unwrap(),
        ),
    ];
    let (normal, stiffness, dt) = (9e6, 3.5e12, 0.1);
    for law in &laws {
        for trial in [5.0e6, 5.6e6, 7e6] {
            let one = respond(law.as_ref(), normal, trial, stiffness, dt, None).unwrap();
            let by_trial =
                |h: f64| respond(law.as_ref(), normal, trial + h, stiffness, dt, None).unwrap().traction;
            let by_normal =
                |h: f64| respond(law.as_ref(), normal + h, trial, stiffness, dt, None).unwrap().traction;
            for (order, what) in [
                (taylor_order(by_trial, one.d_trial, 0.02 * trial), "trial"),
                (taylor_order(by_normal, one.d_normal, 0.02 * normal), "normal"),
            ] {
                assert!(
                    (order - 2.0).abs() < 0.35,
                    "{}: order {order} in the {what} traction at {trial}",
                    law.name()
                );
            }
        }
    }
}

/// Every kind of law with state, steady at 1e-7 m/s under 6 MPa, by name.
fn laws_with_state() -> Vec<(String, Box<dyn Law>)> {
    let mut laws: Vec<(String, Box<dyn Law>)> = Vec::new();
    fn add<E: Evolution + 'static>(laws: &mut Vec<(String, Box<dyn Law>)>, name: &str, parts: &[(E, f64)]) {
        let p = Parameters::new(0.6, 0.01, 1e-6).unwrap();
        let parts = || parts.iter().map(|(e, alpha)| Component::new(e.clone(), *alpha).unwrap()).collect();
        fn law<F: Form + 'static, E: Evolution + 'static>(form: F, parts: Vec<Component<E>>) -> Box<dyn Law> {
            Box::new(RateLaw::with_parts(form, parts, 1e-7, 6e6, None).unwrap())
        }
        let warm = Arrhenius::new(Regularised(p), 9e4, 293.0, 320.0).unwrap();
        laws.push((format!("{name}, regularised"), law(Regularised(p), parts())));
        laws.push((format!("{name}, bare"), law(Bare(p), parts())));
        laws.push((format!("{name}, cut-off"), law(CutOff::new(p, 1e-5).unwrap(), parts())));
        laws.push((format!("{name}, warm"), law(warm, parts())));
    }
    let ageing = |b, l| Ageing::new(b, l, 1e-6).unwrap();
    let cut = |b, l| ageing(b, l).with_cut_off(1e-6).unwrap();
    let slip = |b, l| Slip::new(b, l, 1e-6).unwrap();
    let flash = |mu_w, l| {
        Flash::new(Weakening { mu0: 0.6, a: 0.01, b: 0.015, v_ref: 1e-6, mu_w, v_w: 3e-6 }, l).unwrap()
    };
    for alpha in [0.0, 0.2] {
        let name = |kind: &str| format!("{kind}, alpha {alpha}");
        let common = Common { mu0: 0.6, a: 0.01, v_ref: 1e-6, b: 0.015, length: 1e-5 };
        each_evolution!(Law => {
            let law = <Law as TableEvolution>::DEFINITION.name;
            add(&mut laws, &name(law), &[(usual::<Law>(common), alpha)]);
            if <Law as TableEvolution>::DEFINITION.is_plain() {
                let part = |b, length| usual::<Law>(Common { b, length, ..common });
                let parts = [(part(0.01, 1e-5), alpha), (part(0.005, 1e-4), 0.0)];
                add(&mut laws, &name(&format!("two {law}")), &parts);
            }
        });
        add(&mut laws, &name("ageing with cut-off"), &[(cut(0.015, 1e-5), alpha)]);
        add(&mut laws, &name("flash from 3 um/s"), &[(flash(0.5, 1e-5), alpha)]);
        for c in [0.5, 3.0] {
            let nagata = Nagata::new(0.015, 1e-5, 1e-6, c).unwrap();
            add(&mut laws, &name(&format!("Nagata {c}")), &[(nagata, alpha)]);
        }
        add(&mut laws, &name("two cut-off"), &[(cut(0.01, 1e-5), alpha), (cut(0.005, 1e-4), 0.5 * alpha)]);
        add(&mut laws, &name("two slip"), &[(slip(0.01, 1e-5), alpha), (slip(0.005, 1e-4), 0.5 * alpha)]);
        add(&mut laws, &name("two flash"), &[(flash(0.5, 1e-5), alpha), (flash(0.58, 1e-4), 0.0)]);
    }
    laws
}

/// Behind stiff and soft springs, with slip from a fraction of L to many, and with memories of both tractions.
#[test]
fn every_law_with_state_balances_and_has_consistent_derivatives() {
    let mut shown = 0;
    for (name, law) in laws_with_state() {
        for (stiffness, dt) in [(3.5e12, 0.1), (2e11, 10.0), (1e11, 100.0)] {
            for (normal, trial) in [(9e6, 5.2e6), (9e6, 6.3e6), (9e6, 9e6), (5e6, 2.9e6), (5e6, 4.5e6)] {
                let what = format!("{name}: {normal} {trial} {stiffness} {dt}");
                let one = respond(law.as_ref(), normal, trial, stiffness, dt, None).expect(&what);
                let left = trial - stiffness * one.slip - one.traction;
                assert!(left.abs() <= 4.0 * f64::EPSILON * trial, "{what}: {left:e}");
                assert!((one.rate * dt - one.slip).abs() <= 4.0 * f64::EPSILON * one.slip, "{what}");
                let at = |normal: f64, trial: f64| {
                    respond(law.as_ref(), normal, trial, stiffness, dt, None).unwrap().traction
                };
                for (f, derivative, h, by) in [
                    (&(|h| at(normal, trial + h)) as &dyn Fn(f64) -> f64, one.d_trial, 2e-3 * trial, "trial"),
                    (&|h| at(normal + h, trial), one.d_normal, 2e-3 * normal, "normal"),
                ] {
                    // Central, since the terms of second and third order of one side may cancel.
                    let remainder = |h: f64| (f(h) - f(-h) - 2.0 * h * derivative).abs();
                    let (coarse, fine) = (remainder(h), remainder(0.5 * h));
                    // ln V is found to the rounding of the balance, divided by the slope of its weaker side.
                    let rounding = 1e-13 * trial;
                    let order = (coarse / fine).log2();
                    assert!(
                        coarse < rounding || fine < 10.0 * rounding || order > 2.7,
                        "{what}: order {order} in the {by} traction, {coarse:e} {fine:e}: {one:?}"
                    );
                    shown += usize::from(fine > 10.0 * rounding);
                }
            }
        }
    }
    assert!(shown > 2000, "{shown}");
}

#[test]
fn a_lagged_rate_keeps_the_derivative() {
    let law = velocity_law(0.01);
    let (normal, stiffness, dt, lag) = (9e6, 3.5e12, 0.1, Some((1.5, 4e-7)));
    let one = respond(&law, normal, 6e6, stiffness, dt, lag).unwrap();
    assert!((one.rate - (1.5 * one.slip / dt - 4e-7)).abs() < 1e-20);
    let by_trial = |h: f64| respond(&law, normal, 6e6 + h, stiffness, dt, lag).unwrap().traction;
    assert!((taylor_order(by_trial, one.d_trial, 1e5) - 2.0).abs() < 0.3);
}

#[test]
fn the_cap_holds_and_removes_the_normal_coupling() {
    let law =
        RateLaw::new(Regularised(Parameters::new(0.6, 0.01, 1e-6).unwrap()), Stateless, 1e-6, Some(2e6))
            .unwrap();
    let one = respond(&law, 9e6, 7e6, 3.5e12, 0.1, None).unwrap();
    assert_eq!((one.traction, one.d_trial, one.d_normal), (2e6, 0.0, 0.0));
    let coulomb = Coulomb::new(0.6, Some(2e6)).unwrap();
    let one = respond(&coulomb, 9e6, 7e6, 3.5e12, 0.1, None).unwrap();
    assert_eq!((one.traction, one.d_normal), (2e6, 0.0));
}

#[test]
fn the_bare_logarithm_refuses_rest() {
    let law = RateLaw::new(Bare(Parameters::new(0.6, 0.01, 1e-6).unwrap()), Stateless, 1e-6, None).unwrap();
    assert!(matches!(respond(&law, 1e6, 0.0, 1e12, 0.1, None), Err(Failure::BareLogAtRest { .. })));
    let mut mu = [0.0];
    assert!(matches!(law.coefficient(&[9e6], &[0.0], &[], &mut mu), Err(Failure::BareLogAtRest { .. })));
}

#[test]
fn both_forms_agree_where_the_logarithm_holds() {
    let p = Parameters::new(0.6, 0.01, 1e-6).unwrap();
    for decade in -12..5 {
        let z = 10f64.powi(decade).ln();
        let (bare, regularised) = (Bare(p).at(z, 0.0).mu, Regularised(p).at(z, 0.0).mu);
        // They differ by a e^(-2 mu/a)/... , far below rounding for mu/a > 20.
        if bare > 0.2 {
            assert!((bare - regularised).abs() <= 4.0 * f64::EPSILON, "{decade}: {bare} {regularised}");
        }
    }
}

/// Exact steps at constant V, compared with Runge-Kutta with many small steps on the defining equations.
#[test]
fn exact_steps_solve_their_equations() {
    let (b, l, v_ref) = (0.015, 1e-5, 1e-6);
    for v in [1e-9, 1e-6, 3e-4] {
        let dt = 2.0 * l / v;
        let n = 20_000;
        let h = dt / f64::from(n);
        let rk4 = |mut y: f64, f: &dyn Fn(f64) -> f64| {
            for _ in 0..n {
                let k1 = f(y);
                let k2 = f(y + 0.5 * h * k1);
                let k3 = f(y + 0.5 * h * k2);
                let k4 = f(y + h * k3);
                y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            }
            y
        };
        let phi0: f64 = 0.03;
        let slip = Slip::new(b, l, v_ref).unwrap().step(phi0, f64::ln(v), dt).state;
        let reference = rk4(phi0, &|phi| -(v / l) * (phi + b * f64::ln(v / v_ref)));
        assert!((slip - reference).abs() < 1e-11, "slip {v}: {slip} {reference}");
        let psi0: f64 = 1.7;
        let ageing = Ageing::new(b, l, v_ref).unwrap().step(psi0, f64::ln(v), dt).state;
        let theta = rk4(psi0.exp() * l / v_ref, &|theta| 1.0 - v * theta / l);
        assert!((ageing - (theta * v_ref / l).ln()).abs() < 1e-9, "ageing {v}");
    }
}

#[test]
fn the_steady_state_does_not_move() {
    let (b, l, v_ref) = (0.015, 1e-5, 1e-6);
    for decade in -30..4 {
        let z = 10f64.powi(decade).ln();
        let ageing = Ageing::new(b, l, v_ref).unwrap();
        let slip = Slip::new(b, l, v_ref).unwrap();
        for dt in [1e-3, 1.0, 1e9] {
            let (s, t) = (ageing.steady(z), slip.steady(z));
            assert!((ageing.step(s, z, dt).state - s).abs() <= 1e-13 * s.abs().max(1.0), "{decade} {dt}");
            assert!((slip.step(t, z, dt).state - t).abs() <= 1e-13 * t.abs().max(1.0), "{decade} {dt}");
        }
    }
}

/// With μ held at the previous slip rate, a point on a spring is unstable for steps below 2 a σ/(k V). The error obeys e' = -r
/// (e - e_old), r = a σ/(k V Δt), whose roots leave the unit circle at r = 1/2.
#[test]
fn a_lagged_coefficient_is_unstable_for_small_steps() {
    let (a, sigma, k, v) = (0.01, 1e7, 1e10, 1e-6);
    let growth = |factor: f64| {
        let dt = factor * a * sigma / (k * v);
        let (mut slip, mut last): (f64, f64) = (0.0, -v * dt * (1.0 + 1e-6));
        let mut deviations = Vec::new();
        for n in 1..4000 {
            // Quasi-static spring: k (V t - slip) = σ (μ0 + a ln(V_old/V)), V_old of the step before.
            let rate = (slip - last) / dt;
            let next = v * dt * f64::from(n) - sigma * a * (rate / v).ln() / k;
            last = slip;
            slip = next;
            deviations.push(((slip - last) / (v * dt) - 1.0).abs());
            if !slip.is_finite() || deviations[deviations.len() - 1] > 0.5 {
                return true;
            }
        }
        deviations[3990] > deviations[10]
    };
    assert!(growth(1.98), "1.98 must grow");
    assert!(!growth(2.02), "2.02 must decay");
}

#[test]
fn the_rate_form_is_the_linear_part_of_the_point_return_at_steady_slip() {
    let law = velocity_law(0.01);
    let (normal, stiffness, dt, v) = (9e6, 3.5e12, 0.01, 2e-7);
    let mut mu = [0.0];
    law.coefficient(&[9e6], &[v], &[], &mut mu).unwrap();
    let traction = normal * mu[0];
    let (mut along, mut coupling, mut constant) = ([0.0], [0.0], [0.0]);
    law.rates(
        PresentStates {
            points: &[0],
            normal: &[normal],
            traction: &[traction],
            rate: &[v],
            regime: &[Regime::Slip],
            states: &[],
            stiffness,
            dt,
            rate_floor: 1e-18,
        },
        Rates { along: &mut along, coupling: &mut coupling, constant: &mut constant },
    )
    .unwrap();
    // A displacement increment V Δt keeps the point sliding at V: no change of traction, in either form.
    let trial = traction + stiffness * v * dt;
    let steady = along[0] * stiffness * v * dt + constant[0];
    assert!(steady.abs() < 1e-9 * traction, "{steady}");
    let exact = respond(&law, normal, trial, stiffness, dt, None).unwrap();
    assert!((exact.traction - traction).abs() < 1e-9 * traction);
    // And both have the same derivatives there.
    assert!((along[0] - exact.d_trial).abs() < 1e-9);
    assert!((coupling[0] - exact.d_normal).abs() < 1e-9);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Never NaN, balanced to rounding, dissipating, and with derivatives in their bounds.
    #[test]
    fn the_point_return_balances_over_the_whole_range(
        log_a in -4.0f64..-1.0,
        log_normal in 0.0f64..9.0,
        share in 1e-6f64..3.0,
        log_stiffness in 6.0f64..15.0,
        log_dt in -9.0f64..9.0,
    ) {
        let law = velocity_law(10f64.powf(log_a));
        let (normal, stiffness, dt) = (10f64.powf(log_normal), 10f64.powf(log_stiffness), 10f64.powf(log_dt));
        let trial = share * normal;
        let one = respond(&law, normal, trial, stiffness, dt, None).unwrap();
        let balance = trial - stiffness * one.slip - one.traction;
        prop_assert!(balance.abs() <= 1e-12 * trial, "balance {balance} of {trial}: {one:?}");
        prop_assert!(one.slip >= 0.0 && one.traction >= 0.0 && one.rate >= 0.0);
        prop_assert!((0.0..=1.0).contains(&one.d_trial), "{one:?}");
        prop_assert!(one.d_normal >= 0.0 && one.d_normal.is_finite());
    }
}

#[test]
fn an_open_or_unloaded_point_answers_exactly() {
    let law = velocity_law(0.01);
    let free = respond(&law, 0.0, 3e5, 1e12, 0.1, None).unwrap();
    assert_eq!(free.traction, 0.0);
    assert!((free.slip - 3e-7).abs() < 1e-21);
    let still = respond(&law, 1e6, 0.0, 1e12, 0.1, None).unwrap();
    assert_eq!((still.traction, still.slip, still.rate), (0.0, 0.0, 0.0));
}
