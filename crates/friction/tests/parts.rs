//! Strengths and evolutions by themselves: values, derivatives and closed forms over the whole range of rates.
#![allow(clippy::unwrap_used)]

use asperity_friction::Failure;
use asperity_friction::evolution::{Evolution, Speed, ageing::Ageing, slip::Slip};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};

const V_REF: f64 = 1e-6;
const LENGTH: f64 = 1e-5;
const B: f64 = 0.015;

fn rates() -> impl Iterator<Item = f64> {
    (-60..=8).map(|n| 10f64.powf(0.5 * f64::from(n)))
}

#[test]
fn the_regularised_strength_and_its_inverse_hold_over_34_decades() {
    for a in [1e-4, 1e-3, 0.01, 0.1] {
        let form = Regularised(Parameters::new(0.6, a, V_REF).unwrap());
        for v in rates() {
            for phi in [-0.3, 0.0, 0.2] {
                let s = form.at(v.ln(), phi);
                assert!(s.mu > 0.0 && s.mu.is_finite() && s.d_log_rate > 0.0 && s.d_phi > 0.0, "{a} {v}");
                // ln V is a sum of terms of the size of (μ0 + φ)/a, each rounded.
                let rounding = 8.0 * f64::EPSILON * ((0.9 + s.mu) / a + v.ln().abs());
                assert!((form.log_rate(s.mu, phi) - v.ln()).abs() <= rounding, "{a} {v} {phi}");
            }
        }
    }
}

/// Below asinh's turn the strength is linear, above it logarithmic; in between it is asinh as the standard library has it.
#[test]
fn the_regularised_strength_has_its_limits() {
    let a = 0.02;
    let form = Regularised(Parameters::new(0.0, a, 0.5).unwrap());
    for v in rates() {
        approx::assert_relative_eq!(form.at(v.ln(), 0.0).mu, a * v.asinh(), max_relative = 1e-13);
        approx::assert_relative_eq!(form.d_rate(v.ln(), 0.0), a / v.hypot(1.0), max_relative = 1e-13);
    }
    assert_eq!(form.rest_slope(0.0), Some(a));
    // Where the factor of V exceeds the range of numbers the slope does not.
    let stiff = Regularised(Parameters::new(0.6, 1e-4, V_REF).unwrap());
    approx::assert_relative_eq!(stiff.d_rate(1e-6f64.ln(), 0.2), 100.0, max_relative = 1e-12);
    assert_eq!(stiff.rest_slope(0.0), Some(f64::INFINITY));
}

/// Order at which f(h) - f(0) - h f' vanishes.
fn order(f: impl Fn(f64) -> f64, derivative: f64, h: f64) -> f64 {
    let remainder = |h: f64| (f(h) - f(0.0) - h * derivative).abs();
    (remainder(h) / remainder(0.5 * h)).log2()
}

#[test]
fn derivatives_of_the_strength_are_its_derivatives() {
    let a = 0.05;
    let form = Regularised(Parameters::new(0.1, a, V_REF).unwrap());
    // Around the turn, where the second derivative is not rounding.
    for v in [1e-9, 1e-8, 1e-7, 1e-6] {
        let s = form.at(f64::ln(v), 0.0);
        let found = [
            order(|h| form.at(f64::ln(v) + h, 0.0).mu, s.d_log_rate, 0.02),
            order(|h| form.at(f64::ln(v), h).mu, s.d_phi, 0.02 * a),
            order(|h| form.at(f64::ln(v * (1.0 + h)), 0.0).mu, v * form.d_rate(f64::ln(v), 0.0), 0.02),
        ];
        assert!(found.iter().all(|o| (o - 2.0).abs() < 0.1), "{v}: {found:?}");
    }
    let bare = Bare(Parameters::new(0.6, 0.01, V_REF).unwrap());
    approx::assert_relative_eq!(bare.d_rate(3e-7f64.ln(), 0.1), 0.01 / 3e-7, max_relative = 1e-14);
}

#[test]
fn derivatives_of_the_exact_steps_are_their_derivatives() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for v in [1e-10, 1e-8, 1e-6, 1e-4] {
                for x in [1e-6, 1e-3, 0.019, 0.021, 0.5, 3.0, 39.0, 41.0] {
                    let (z, dt) = (f64::ln(v), x * LENGTH / v);
                    let phi = |h: f64| e.phi(e.step(state, z + h, dt).state);
                    let step = e.step(state, z, dt);
                    let d = e.phi_slopes(step.state).0 * step.d_log_rate;
                    let remainder = |h: f64| (phi(h) - phi(0.0) - h * d).abs();
                    // The old state fades over δx = 1.
                    let h = 2e-3 / (1.0 + x);
                    let (coarse, fine) = (remainder(h), remainder(0.5 * h));
                    // Where the step is linear in ln V there is nothing but rounding.
                    let rounding = 1e-15 * (1.0 + e.phi(state).abs());
                    assert!(
                        coarse < rounding
                            || ((coarse / fine).log2() - 2.0).abs() < 0.3
                            || fine < 100.0 * rounding,
                        "{} state {state} v {v} x {x}: {coarse:e} {fine:e}",
                        E::NAME
                    );
                }
            }
        }
    }
    check(&Ageing::new(B, LENGTH, V_REF).unwrap(), &[-5.0, 0.0, 3.0, 20.0]);
    check(&Slip::new(B, LENGTH, V_REF).unwrap(), &[-0.1, 0.0, 0.2]);
}

/// The step over Δt is the step over Δt/7 seven times, at any rate.
#[test]
fn exact_steps_compose() {
    fn check<E: Evolution>(e: &E, state: f64) {
        for v in rates() {
            for dt in [1e-6, 1e-2, 1e3, 1e9] {
                let whole = e.step(state, v.ln(), dt).state;
                let parts = (0..7).fold(state, |s, _| e.step(s, v.ln(), dt / 7.0).state);
                assert!(
                    (whole - parts).abs() <= 1e-13 * (1.0 + whole.abs()),
                    "{} {v} {dt}: {whole} {parts}",
                    E::NAME
                );
            }
        }
    }
    for psi in [-20.0, 0.0, 30.0] {
        check(&Ageing::new(B, LENGTH, V_REF).unwrap(), psi);
        check(&Slip::new(B, LENGTH, V_REF).unwrap(), 0.01 * psi);
    }
}

/// After a step of the rate from V_1 to V_2, with slip δ: slip law μ - μ_ss = b ln(V_2/V_1) e^(-δ/L); ageing law
/// θ = L/V_2 + (L/V_1 - L/V_2) e^(-δ/L).
#[test]
fn velocity_steps_follow_their_closed_forms() {
    let (slip, ageing) = (Slip::new(B, LENGTH, V_REF).unwrap(), Ageing::new(B, LENGTH, V_REF).unwrap());
    for (v1, v2) in [(1e-7, 1e-6), (1e-6, 1e-7), (1e-9, 1e-3)] {
        let (z1, z2) = (f64::ln(v1), f64::ln(v2));
        let steps = 40;
        let dt = 4.0 * LENGTH / v2 / f64::from(steps);
        let (mut phi, mut psi) = (slip.steady(z1), ageing.steady(z1));
        for n in 1..=steps {
            phi = slip.step(phi, z2, dt).state;
            psi = ageing.step(psi, z2, dt).state;
            let decay = (-f64::from(n) * dt * v2 / LENGTH).exp();
            approx::assert_abs_diff_eq!(phi - slip.steady(z2), B * (v2 / v1).ln() * decay, epsilon = 1e-15);
            let theta = LENGTH / v2 + (LENGTH / v1 - LENGTH / v2) * decay;
            approx::assert_abs_diff_eq!(psi, (V_REF * theta / LENGTH).ln(), epsilon = 1e-13);
        }
    }
}

#[test]
fn the_rate_of_the_state_is_the_slope_of_its_exact_step_in_time() {
    fn check<E: Evolution>(e: &E, state: f64) {
        for v in [1e-12, 1e-8, 1e-6, 1e-3] {
            let z = f64::ln(v);
            let rate = e.rate(state, Speed::of_log(z)).rate;
            // Of the order of the shortest time in play.
            let dt = 1e-4 / (v / LENGTH + rate.abs());
            let found = order(|h| e.step(state, z, h).state, rate, dt);
            assert!((found - 2.0).abs() < 0.1, "{} {v}: {found}", E::NAME);
        }
    }
    check(&Ageing::new(B, LENGTH, V_REF).unwrap(), 1.0);
    check(&Ageing::new(B, LENGTH, V_REF).unwrap(), -2.0);
    check(&Slip::new(B, LENGTH, V_REF).unwrap(), 0.6);
    let ageing = Ageing::new(B, LENGTH, V_REF).unwrap();
    for v in rates() {
        // A steady state does not move, to rounding of its logarithm.
        let rounding = 8.0 * f64::EPSILON * (1.0 + v.ln().abs()) * v / LENGTH;
        assert!(ageing.rate(ageing.steady(v.ln()), Speed::of_log(v.ln())).rate.abs() <= rounding);
    }
}

#[test]
fn no_step_weakens_more_than_its_bound() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for v in rates() {
                for x in [1e-9, 1e-3, 0.1, 1.0, 10.0, 1e3] {
                    let step = e.step(state, v.ln(), x * LENGTH / v);
                    let weakening = -e.phi_slopes(step.state).0 * step.d_log_rate;
                    let bound = e.weakening(state, v.ln()) * x * LENGTH;
                    assert!(weakening <= bound * (1.0 + 1e-12), "{} {state} {v} {x}", E::NAME);
                }
            }
        }
    }
    check(&Ageing::new(B, LENGTH, V_REF).unwrap(), &[-30.0, -1.0, 0.0, 5.0, 60.0]);
    check(&Slip::new(B, LENGTH, V_REF).unwrap(), &[-0.5, 0.0, 0.1, 1.0]);
}

#[test]
fn extreme_rates_and_rest_leave_numbers() {
    let (slip, ageing) = (Slip::new(B, LENGTH, V_REF).unwrap(), Ageing::new(B, LENGTH, V_REF).unwrap());
    for z in [f64::MIN, -1e4, -700.0, 0.0, 700.0, 1e4] {
        for dt in [1e-300, 1e-9, 1.0, 1e20] {
            let (s, a) = (slip.step(0.1, z, dt), ageing.step(0.1, z, dt));
            for number in
                [s.state, s.d_log_rate, s.curvature, s.d_state, a.state, a.d_log_rate, a.curvature, a.d_state]
            {
                assert!(number.is_finite(), "{z} {dt}: {s:?} {a:?}");
            }
        }
    }
    // At rest the slip law keeps its state, and θ grows with time.
    assert_eq!(slip.step(0.1, f64::MIN, 1e9).state, 0.1);
    approx::assert_relative_eq!(ageing.step(0.0, f64::MIN, 90.0).state, 10f64.ln(), max_relative = 1e-14);
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let refused = |result: Result<(), Failure>, expected: &str| match result {
        Err(Failure::Parameter { name, .. }) => assert_eq!(name, expected),
        other => panic!("{expected}: {other:?}"),
    };
    for bad in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        refused(Parameters::new(0.6, bad, 1e-6).map(drop), "a");
        refused(Parameters::new(0.6, 0.01, bad).map(drop), "v_ref");
        refused(Ageing::new(0.01, bad, 1e-6).map(drop), "l");
        refused(Slip::new(0.01, bad, 1e-6).map(drop), "l");
        refused(Slip::new(0.01, 1e-5, bad).map(drop), "v_ref");
        let form = Regularised(Parameters::new(0.6, 0.01, 1e-6).unwrap());
        refused(
            RateLaw::new(form.clone(), Slip::new(0.01, 1e-5, 1e-6).unwrap(), bad, None).map(drop),
            "v_initial",
        );
        let capped = RateLaw::velocity(Parameters::new(0.6, 0.01, 1e-6).unwrap(), Some(bad));
        refused(capped.map(drop), "f_limit");
    }
    refused(Parameters::new(f64::NAN, 0.01, 1e-6).map(drop), "mu0");
    refused(Ageing::new(f64::NAN, 1e-5, 1e-6).map(drop), "b");
    assert!(
        !RateLaw::velocity(Parameters::new(0.6, 0.01, 1e-6).unwrap(), None)
            .unwrap()
            .rate_weakening_without_state()
    );
}
