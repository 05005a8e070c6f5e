//! Strengths and evolutions by themselves: values, derivatives and closed forms over the whole range of rates.
#![allow(clippy::unwrap_used)]

use asperity_friction::Failure;
use asperity_friction::component::Component;
use asperity_friction::evolution::flash::{Flash, Weakening};
use asperity_friction::evolution::{Evolution, Speed, ageing::Ageing, nagata::Nagata, prz::Prz, slip::Slip};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::arrhenius::{Arrhenius, GAS_CONSTANT};
use asperity_friction::strength::cut_off::CutOff;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};

const V_REF: f64 = 1e-6;
const LENGTH: f64 = 1e-5;
const B: f64 = 0.015;

/// Weakening from 0.6 to 0.2 above 0.1 m/s, with a direct effect of `a`.
fn weakening(a: f64) -> Weakening {
    Weakening { mu0: 0.6, a, b: B, v_ref: V_REF, mu_w: 0.2, v_w: 0.1 }
}

/// Calls a function with every evolution of one state variable and with values of φ/b to start from.
macro_rules! with_every_evolution {
    ($check:ident, $of_log:expr, $of_phi:expr) => {
        $check(&Ageing::new(B, LENGTH, V_REF).unwrap(), &$of_log);
        $check(&Ageing::new(B, LENGTH, V_REF).unwrap().with_cut_off(1e-2).unwrap(), &$of_log);
        $check(&Ageing::new(B, LENGTH, V_REF).unwrap().with_cut_off(1e-8).unwrap(), &$of_log);
        $check(&Prz::new(B, LENGTH, V_REF).unwrap(), &$of_log);
        $check(&Nagata::new(B, LENGTH, V_REF, 2.0).unwrap(), &$of_log);
        $check(&Slip::new(B, LENGTH, V_REF).unwrap(), &$of_phi);
        $check(&Flash::new(weakening(0.01), LENGTH).unwrap(), &$of_phi);
        $check(&Flash::new(weakening(0.02), LENGTH).unwrap(), &$of_phi);
    };
}

/// Whether the remainder f(h) - f(0) - h f' vanishes at second order or faster, down to `rounding`; the second answer tells
/// whether it was large enough to show an order.
fn taylor(f: impl Fn(f64) -> f64, derivative: f64, h: f64, rounding: f64) -> (bool, bool) {
    let remainder = |h: f64| (f(h) - f(0.0) - h * derivative).abs();
    let (coarse, fine) = (remainder(h), remainder(0.5 * h));
    let shows = fine > 30.0 * rounding;
    ((!shows && coarse < 1000.0 * rounding) || (coarse / fine).log2() > 1.7, shows)
}

/// Counts Taylor tests that showed an order, and fails with the first that is wrong.
#[derive(Default)]
struct Tally {
    all: usize,
    shown: usize,
}

impl Tally {
    fn add(&mut self, (holds, shows): (bool, bool), what: impl FnOnce() -> String) {
        assert!(holds, "{}", what());
        self.all += 1;
        self.shown += usize::from(shows);
    }

    /// At least this share of the tests must have had something to show.
    fn told(&self, share: f64) {
        assert!(self.shown as f64 >= share * self.all as f64, "{} of {}", self.shown, self.all);
    }
}

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
        approx::assert_relative_eq!(
            form.at(v.ln(), 0.0).mu,
            a * v.asinh(),
            epsilon = 0.0,
            max_relative = 1e-13
        );
        approx::assert_relative_eq!(
            form.d_rate(v.ln(), 0.0),
            a / v.hypot(1.0),
            epsilon = 0.0,
            max_relative = 1e-13
        );
    }
    assert_eq!(form.rest_slope(0.0), Some(a));
    // Where the factor of V exceeds the range of numbers the slope does not.
    let stiff = Regularised(Parameters::new(0.6, 1e-4, V_REF).unwrap());
    approx::assert_relative_eq!(stiff.d_rate(1e-6f64.ln(), 0.2), 100.0, epsilon = 0.0, max_relative = 1e-12);
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
    approx::assert_relative_eq!(
        bare.d_rate(3e-7f64.ln(), 0.1),
        0.01 / 3e-7,
        epsilon = 0.0,
        max_relative = 1e-14
    );
}

/// Calls a function with every strength form, of μ0 = 0.6 and a = 0.005.
macro_rules! with_every_form {
    ($check:ident) => {
        let p = Parameters::new(0.6, 0.005, V_REF).unwrap();
        $check(&Regularised(p), "regularised");
        $check(&Bare(p), "bare");
        $check(&CutOff::new(p, 1e-5).unwrap(), "cut-off");
        let warm = |t: f64| Arrhenius::new(Regularised(p), 9e4, 293.0, t).unwrap();
        $check(&warm(400.0), "warm");
        $check(&warm(280.0), "cold");
        $check(&Arrhenius::new(Bare(p), 9e4, 293.0, 400.0).unwrap(), "warm bare");
        $check(&Arrhenius::new(CutOff::new(p, 1e-5).unwrap(), 9e4, 293.0, 350.0).unwrap(), "warm cut-off");
    };
}

#[test]
fn derivatives_of_every_strength_are_its_derivatives() {
    fn check<F: Form>(form: &F, name: &str) {
        let a = form.scale();
        let [mut first, mut second] = [(); 2].map(|()| Tally::default());
        // Down to where the regularised strength is linear in V.
        for n in -160..=6 {
            let z = 0.5 * f64::from(n) * f64::ln(10.0);
            for phi in [-0.05, 0.0, 0.1] {
                let s = form.at(z, phi);
                let what = || format!("{name} at ln V {z}, φ {phi}: {s:?}");
                let size = 0.7 + a * z.abs();
                let (h, rounding) = (0.02, 2.0 * f64::EPSILON * size);
                first.add(taylor(|h| form.at(z + h, phi).mu, s.d_log_rate, h, rounding), what);
                first.add(taylor(|h| form.at(z, phi + h * a).mu, s.d_phi * a, h, rounding), what);
                let slope = |h: f64| form.at(z + h, phi).d_log_rate;
                second.add(taylor(slope, s.curvature, h, rounding), what);
                // ∂μ/∂V by V.
                let relative = |h: f64| form.at(z + h.ln_1p(), phi).mu;
                first.add(taylor(relative, form.d_rate(z, phi) * z.exp(), h, rounding), what);
                // The direct effect bounds the ratio of the derivatives at this rate and below.
                let below = form.at(z - 3.0, phi);
                for s in [s, below] {
                    assert!(form.direct_effect(z) * s.d_phi <= s.d_log_rate * (1.0 + 1e-13), "{}", what());
                }
            }
        }
        assert!(first.shown > 20 && (second.shown > 20 || name.contains("bare")), "{name}");
    }
    with_every_form!(check);
}

#[test]
fn the_slip_rate_is_the_inverse_of_every_strength() {
    fn check<F: Form>(form: &F, name: &str) {
        let a = form.scale();
        let mut tally = Tally::default();
        // The last is an e-fold of 1 + V1/V below the saturation of the least φ.
        for m in [1e-3, 0.1, 0.99, 1.01, 3.0, 15.0, 19.9, 20.1, 60.0, 100.0, 109.0] {
            for sign in if form.regular_at_rest() { vec![1.0, -1.0] } else { vec![1.0] } {
                for phi in [-0.05, 0.0, 0.1] {
                    let what = || format!("{name} m {m}, φ {phi}, sign {sign}");
                    let s = form.slip_rate(sign * m, phi);
                    assert!(s.rate.signum() == sign && s.rate.is_finite(), "{}", what());
                    approx::assert_relative_eq!(
                        s.rate.abs(),
                        s.log.exp(),
                        epsilon = 0.0,
                        max_relative = 1e-13
                    );
                    let mu = form.at(s.log, phi).mu;
                    assert!((mu - a * m).abs() <= 1e-15 + 4e-16 * a * s.log.abs(), "{}: {mu}", what());
                    approx::assert_abs_diff_eq!(form.log_rate(a * m, phi), s.log, epsilon = 1e-12);
                    // V is a power over one of m, and linear in m below.
                    let (h, rounding) = (0.02 * m.min(1.0), f64::EPSILON * (100.0 + s.log.abs()));
                    let at = |dm: f64, dp: f64| form.slip_rate(sign * m + dm, phi + dp * a);
                    let (by_m, by_phi) = (s.d_m.abs(), (s.d_phi * a).abs());
                    for (tested, size) in [
                        (taylor(|h| at(h, 0.0).rate, s.d_m, h, rounding * s.rate.abs()), "m"),
                        (taylor(|h| at(0.0, h).rate, s.d_phi * a, 0.02, rounding * s.rate.abs()), "φ"),
                        (taylor(|h| at(h, 0.0).d_m, s.d_mm, h, rounding * by_m), "mm"),
                        (taylor(|h| at(0.0, h).d_m, s.d_m_phi * a, 0.02, rounding * by_m), "mφ"),
                        (taylor(|h| at(h, 0.0).d_phi * a, s.d_m_phi * a, h, rounding * by_phi), "φm"),
                        (
                            taylor(|h| at(0.0, h).d_phi * a, s.d_phi_phi * a * a, 0.02, rounding * by_phi),
                            "φφ",
                        ),
                    ] {
                        tally.add(tested, || format!("{} by {size}: {s:?}", what()));
                    }
                }
            }
        }
        tally.told(0.8);
        if form.regular_at_rest() {
            let rest = form.slip_rate(0.0, 0.1);
            assert_eq!((rest.rate, rest.log), (0.0, f64::NEG_INFINITY));
            approx::assert_relative_eq!(
                rest.d_m,
                a / form.rest_slope(0.1).unwrap(),
                epsilon = 0.0,
                max_relative = 1e-13
            );
        }
    }
    with_every_form!(check);
    // Above all its strengths the form with a cut-off has no rate.
    let cut = CutOff::new(Parameters::new(0.6, 0.005, V_REF).unwrap(), 1e-5).unwrap();
    assert_eq!(cut.slip_rate(121.0, 0.0).rate, f64::INFINITY);
    assert_eq!(cut.log_rate(0.605, 0.0), f64::INFINITY);
}

/// μ = μ0 + φ - a ln(1 + V1/V).
#[test]
fn the_cut_off_saturates_the_direct_effect() {
    let (a, v1) = (0.01, 1e-5);
    let form = CutOff::new(Parameters::new(0.6, a, V_REF).unwrap(), v1).unwrap();
    for v in rates() {
        let expected = 0.6 + 0.1 - a * (v1 / v).ln_1p();
        approx::assert_abs_diff_eq!(form.at(v.ln(), 0.1).mu, expected, epsilon = 1e-15);
        approx::assert_relative_eq!(
            form.d_rate(v.ln(), 0.1),
            a / v * (v1 / (v + v1)),
            epsilon = 0.0,
            max_relative = 1e-13
        );
    }
    // Above V1 nothing is gained: less than a V1/V is left.
    assert!((form.at(1e4f64.ln(), 0.0).mu - 0.6).abs() <= a * 1.001e-9);
    // Below, it is the bare logarithm with V1 for a reference.
    let bare = Bare(Parameters::new(0.6, a, v1).unwrap());
    approx::assert_abs_diff_eq!(form.at(-60.0, 0.0).mu, bare.at(-60.0, 0.0).mu, epsilon = 1e-15);
    assert!(!form.regular_at_rest());
}

#[test]
fn temperature_shifts_the_strength_by_its_arrhenius_factor() {
    let (q, reference, a) = (9e4, 293.0, 0.01);
    let p = Parameters::new(0.6, a, V_REF).unwrap();
    for t in [250.0, 292.999, 293.0, 293.001, 350.0, 900.0] {
        let factor: f64 = q / GAS_CONSTANT * (1.0 / t - 1.0 / reference);
        let bare = Arrhenius::new(Bare(p), q, reference, t).unwrap();
        let regularised = Arrhenius::new(Regularised(p), q, reference, t).unwrap();
        for v in rates() {
            let (z, expected) = (v.ln(), Bare(p).at(v.ln(), 0.05).mu + a * factor);
            approx::assert_abs_diff_eq!(bare.at(z, 0.05).mu, expected, epsilon = 1e-13);
            let expected = a * (v * factor.exp() / (2.0 * V_REF) * (0.65f64 / a).exp()).asinh();
            approx::assert_relative_eq!(
                regularised.at(z, 0.05).mu,
                expected,
                epsilon = 0.0,
                max_relative = 1e-12
            );
            let at = |t: f64| Arrhenius::new(Regularised(p), q, reference, t).unwrap().at(z, 0.05).mu;
            let d = regularised.d_temperature(z, 0.05);
            let (holds, shows) = taylor(|h| at(t + h), d, 1e-3 * t, 1e-16 * (1.0 + a * z.abs()));
            assert!(holds && shows, "{t} {v}");
            approx::assert_relative_eq!(
                bare.d_temperature(z, 0.0),
                -a * q / (GAS_CONSTANT * t * t),
                epsilon = 0.0,
                max_relative = 1e-14
            );
        }
    }
    // At the reference, or without activation, nothing happens; warm rock is weaker.
    let z = f64::ln(3e-7);
    let same = Arrhenius::new(Regularised(p), q, reference, reference).unwrap();
    assert_eq!(same.at(z, 0.1), Regularised(p).at(z, 0.1));
    let idle = Arrhenius::new(Regularised(p), 0.0, reference, 900.0).unwrap();
    assert_eq!((idle.at(z, 0.1), idle.d_temperature(z, 0.1)), (Regularised(p).at(z, 0.1), 0.0));
    let warm = Arrhenius::new(Regularised(p), q, reference, 350.0).unwrap();
    assert!(warm.at(z, 0.1).mu < same.at(z, 0.1).mu);
}

#[test]
fn derivatives_of_the_exact_steps_are_their_derivatives() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        let [mut first, mut second, mut by_state, mut by_phi] = [(); 4].map(|()| Tally::default());
        for &state in states {
            for v in [1e-10, 1e-8, 1e-6, 1e-4, 0.05, 0.1, 1.0] {
                for x in [1e-6, 1e-3, 0.019, 0.021, 0.5, 3.0, 39.0, 41.0] {
                    let (z, dt) = (f64::ln(v), x * LENGTH / v);
                    let what = || format!("{} state {state} v {v} x {x}", E::NAME);
                    let s = e.step(state, z, dt);
                    // The old state fades over δx = 1, flash heating sets in over an eighth of an e-fold.
                    let h = 2e-3 / (1.0 + x);
                    let rounding = f64::EPSILON * (4.0 + 4.0 * state.abs() + s.state.abs() + z.abs());
                    let after = |h: f64| e.step(state, z + h, dt);
                    first.add(taylor(|h| after(h).state, s.d_log_rate, h, rounding), what);
                    second.add(taylor(|h| after(h).d_log_rate, s.curvature, h, rounding * (1.0 + x)), what);
                    let from = |h: f64| e.step(state + h, z, dt).state;
                    by_state.add(taylor(from, s.d_state, 0.02, rounding), what);
                    let (slope, bend) = e.phi_slopes(s.state);
                    let rounding = 4.0 * f64::EPSILON * (B + e.phi(s.state).abs() + B * s.state.abs());
                    by_phi.add(taylor(|h| e.phi(s.state + h), slope, 0.02, rounding), what);
                    by_phi.add(taylor(|h| e.phi_slopes(s.state + h).0, bend, 0.02, rounding), what);
                }
            }
        }
        first.told(0.5);
        second.told(0.3);
        // Relaxation is linear in the state, and φ in s where nothing cuts it off.
        if e.per_phi() != 1.0 {
            by_state.told(0.2);
        }
    }
    with_every_evolution!(check, [-5.0, 0.0, 3.0, 20.0], [-0.1, 0.0, 0.2]);
}

/// The step over Δt is the step over Δt/7 seven times, at any rate.
#[test]
fn exact_steps_compose() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for v in rates() {
                for dt in [1e-6, 1e-2, 1e3, 1e9] {
                    let whole = e.step(state, v.ln(), dt);
                    let (mut parts, mut d_state) = (state, 1.0);
                    for _ in 0..7 {
                        let step = e.step(parts, v.ln(), dt / 7.0);
                        (parts, d_state) = (step.state, d_state * step.d_state);
                    }
                    let rounding = 1e-13 * (1.0 + whole.state.abs());
                    let what = format!("{} from {state} at {v} over {dt}", E::NAME);
                    assert!((whole.state - parts).abs() <= rounding, "{what}: {} {parts}", whole.state);
                    assert!((whole.d_state - d_state).abs() <= 1e-12, "{what}: {} {d_state}", whole.d_state);
                }
            }
        }
    }
    with_every_evolution!(check, [-20.0, 0.0, 30.0], [-0.2, 0.0, 0.3]);
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
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for v in [1e-12, 1e-8, 1e-6, 1e-3, 0.1, 3.0] {
                let z = f64::ln(v);
                let r = e.rate(state, Speed::of_log(z));
                // Of the order of the shortest time in play.
                let dt = 1e-3 / (v / LENGTH + r.rate.abs() + r.d_state.abs());
                let rounding = 4.0 * f64::EPSILON * (1.0 + state.abs());
                let (holds, _) = taylor(|h| e.step(state, z, h).state, r.rate, dt, rounding);
                assert!(holds, "{} from {state} at {v}", E::NAME);
            }
        }
    }
    with_every_evolution!(check, [1.0, -2.0, 8.0], [0.6, 0.0, -0.3]);
}

#[test]
fn derivatives_of_the_rate_of_the_state_are_its_derivatives() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        let (mut by_rate, mut by_state) = (Tally::default(), Tally::default());
        for &state in states {
            for v in rates() {
                let z = v.ln();
                let r = e.rate(state, Speed::of_log(z));
                let size = r.rate.abs() + r.d_log_rate.abs() + r.d_state.abs();
                let rounding = f64::EPSILON * size * (4.0 + z.abs() + state.abs());
                let what = || format!("{} from {state} at {v}: {r:?}", E::NAME);
                let at = |h: f64| e.rate(state, Speed::of_log(z + h)).rate;
                by_rate.add(taylor(at, r.d_log_rate, 0.005, rounding), what);
                let from = |h: f64| e.rate(state + h, Speed::of_log(z)).rate;
                by_state.add(taylor(from, r.d_state, 0.01, rounding), what);
            }
        }
        by_rate.told(0.3);
        if e.per_phi() != 1.0 {
            by_state.told(0.3);
        }
    }
    with_every_evolution!(check, [-20.0, -1.0, 0.0, 2.0, 30.0], [-0.2, 0.0, 0.3]);
}

#[test]
fn steady_states_do_not_move() {
    fn check<E: Evolution>(e: &E, _: &[f64]) {
        for v in rates() {
            let z = v.ln();
            let steady = e.steady(z);
            // To rounding of the logarithms.
            let rounding = 8.0 * f64::EPSILON * (2.0 + z.abs());
            let r = e.rate(steady, Speed::of_log(z)).rate;
            assert!(r.abs() <= rounding * v / LENGTH, "{} {v}: {r:e}", E::NAME);
            for dt in [1e-3, 1.0, 1e9] {
                let after = e.step(steady, z, dt).state;
                assert!((after - steady).abs() <= 1e-13 * steady.abs().max(1.0), "{} {v} {dt}", E::NAME);
            }
        }
    }
    with_every_evolution!(check, [], []);
}

/// And from wherever it starts, a state that slips far arrives there.
#[test]
fn states_arrive_at_their_steady_state() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for v in rates() {
                let end = e.step(state, v.ln(), 400.0 * LENGTH / v);
                let steady = e.steady(v.ln());
                assert!((end.state - steady).abs() <= 1e-13 * (1.0 + steady.abs()), "{} {v}", E::NAME);
                assert!(end.d_state < 1e-13, "{} {v}", E::NAME);
            }
        }
    }
    with_every_evolution!(check, [-20.0, 0.0, 30.0], [-0.2, 0.0, 0.3]);
}

#[test]
fn no_step_weakens_more_than_its_bound() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for v in rates().chain((0..100).map(|n| 0.03 * 1.04f64.powi(n))) {
                for x in [1e-9, 1e-3, 0.1, 1.0, 10.0, 1e3] {
                    let step = e.step(state, v.ln(), x * LENGTH / v);
                    let weakening = -e.phi_slopes(step.state).0 * step.d_log_rate;
                    // The bound is one for all rates up to the one it is asked for.
                    for factor in [1.0, 3.0, 1e4] {
                        let bound = e.weakening(state, (factor * v).ln()) * x * LENGTH;
                        assert!(weakening <= bound * (1.0 + 1e-9), "{} {state} {v} {x} {factor}", E::NAME);
                    }
                }
            }
        }
    }
    with_every_evolution!(check, [-30.0, -1.0, 0.0, 5.0, 60.0], [-0.5, 0.0, 0.1, 1.0]);
}

#[test]
fn extreme_rates_and_rest_leave_numbers() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for z in [f64::MIN, -1e4, -700.0, 0.0, 600.0, 690.0, 700.0, 709.0, 1e4] {
                for dt in [1e-300, 1e-9, 1.0, 1e20] {
                    let s = e.step(state, z, dt);
                    for number in [s.state, s.d_log_rate, s.curvature, s.d_state] {
                        assert!(number.is_finite(), "{} from {state} at {z} over {dt}: {s:?}", E::NAME);
                    }
                    let (slope, bend) = e.phi_slopes(s.state);
                    assert!(e.phi(s.state).is_finite() && slope.is_finite() && bend.is_finite());
                }
                let r = e.rate(state, Speed::of_log(z));
                assert!(!(r.rate.is_nan() || r.d_log_rate.is_nan() || r.d_state.is_nan()), "{} {z}", E::NAME);
            }
        }
    }
    with_every_evolution!(check, [-300.0, 0.1, 300.0], [-1.0, 0.1, 3.0]);
    // At rest the slip laws keep their state, and θ grows with time.
    let (slip, ageing) = (Slip::new(B, LENGTH, V_REF).unwrap(), Ageing::new(B, LENGTH, V_REF).unwrap());
    let flash = Flash::new(weakening(0.01), LENGTH).unwrap();
    assert_eq!(slip.step(0.1, f64::MIN, 1e9).state, 0.1);
    assert_eq!(flash.step(0.1, f64::MIN, 1e9).state, 0.1);
    approx::assert_relative_eq!(
        ageing.step(0.0, f64::MIN, 90.0).state,
        10f64.ln(),
        epsilon = 0.0,
        max_relative = 1e-14
    );
    // θ_0 = 2L/Vref = 20 s.
    let prz = Prz::new(B, LENGTH, V_REF).unwrap();
    approx::assert_relative_eq!(
        prz.step(0.0, f64::MIN, 180.0).state,
        10f64.ln(),
        epsilon = 0.0,
        max_relative = 1e-14
    );
    let nagata = Nagata::new(B, LENGTH, V_REF, 2.0).unwrap();
    approx::assert_relative_eq!(
        nagata.step(0.0, f64::MIN, 270.0).state,
        10f64.ln(),
        epsilon = 0.0,
        max_relative = 1e-14
    );
}

/// u = V θ/2L obeys du/dx = 1 - u² over x = V t/2L: tanh below its steady state of 1 and coth above.
#[test]
fn the_prz_law_follows_its_hyperbolic_functions() {
    let prz = Prz::new(B, LENGTH, V_REF).unwrap();
    let check = |v: f64, u0: f64, x: f64| {
        let state = |u: f64| (u * V_REF / v).ln();
        let u = if u0 < 1.0 { (x + u0.atanh()).tanh() } else { 1.0 / (x + (1.0 / u0).atanh()).tanh() };
        let found = prz.step(state(u0), v.ln(), 2.0 * LENGTH * x / v).state;
        let rounding = 8.0 * f64::EPSILON * (2.0 + state(u0).abs() + state(u).abs());
        assert!((found - state(u)).abs() <= rounding, "{v} {u0} {x}: {found} {}", state(u));
    };
    for v in [1e-12, 1e-6, 1e-2] {
        for u0 in [1e-9, 1e-3, 0.1, 0.5, 0.9, 1.1, 2.0, 1e3, 1e9] {
            for x in [1e-8, 1e-4, 5e-3, 9.9e-3, 0.0101, 0.1, 1.0, 5.0, 19.9, 20.1, 50.0] {
                check(v, u0, x);
            }
        }
        // A step of the rate from V_1 starts at u_0 = V/V_1.
        for v1 in [1e-9, 1e-7, 1e-4] {
            for n in 1..20 {
                check(v, v / v1, 0.1 * f64::from(n));
            }
        }
    }
}

/// Small steps keep the derivative to rounding, too: x/(sinh x cosh x) - 1 from a long series.
#[test]
fn small_steps_of_the_prz_law_have_exact_derivatives() {
    let prz = Prz::new(B, LENGTH, V_REF).unwrap();
    for x in [1e-6, 1e-4, 1e-3, 5e-3, 9.9e-3, 0.0101, 0.02] {
        // From θ = 0, ψ = ln(tanh x) - ln V + constant, ∂ψ/∂ln V = 2x/sinh 2x - 1.
        let found = prz.step(-700.0, 0.0, 2.0 * LENGTH * x).d_log_rate;
        let (mut expected, y) = (0.0, 4.0 * x * x);
        for c in [-73.0 / 3_421_440.0, 127.0 / 604_800.0, -31.0 / 15_120.0, 7.0 / 360.0, -1.0 / 6.0] {
            expected = (expected + c) * y;
        }
        approx::assert_abs_diff_eq!(found, expected, epsilon = 4e-16 + 1e-14 * expected.abs());
    }
}

/// φ_ss and the exponential approach to it over slip.
#[test]
fn flash_heating_relaxes_towards_its_steady_state() {
    for a in [0.01, 0.02] {
        let flash = Flash::new(weakening(a), LENGTH).unwrap();
        let coefficient = |v: f64| {
            let low = 0.6 + (a - B) * (v / V_REF).ln();
            0.2 + (low - 0.2) / (1.0 + (v / 0.1).powi(8)).powf(0.125)
        };
        let steady = |v: f64| coefficient(v) - 0.6 - a * (v / V_REF).ln();
        for v in [1e-12, 1e-6, 1e-3, 0.05, 0.09, 0.1, 0.11, 0.3, 1.0, 30.0] {
            let z = f64::ln(v);
            approx::assert_abs_diff_eq!(flash.steady_coefficient(z), coefficient(v), epsilon = 4e-15);
            approx::assert_abs_diff_eq!(flash.steady(z), steady(v), epsilon = 4e-15);
            for slip in [1e-3, 0.1, 1.0, 5.0] {
                let found = flash.step(0.07, z, slip * LENGTH / v).state;
                let expected = steady(v) + (0.07 - steady(v)) * f64::exp(-slip);
                approx::assert_abs_diff_eq!(found, expected, epsilon = 4e-15);
            }
        }
    }
    // Far below V_w the slip law is what remains.
    let (flash, slip) = (Flash::new(weakening(0.01), LENGTH).unwrap(), Slip::new(B, LENGTH, V_REF).unwrap());
    let (one, other) = (flash.step(0.07, 1e-5f64.ln(), 0.7), slip.step(0.07, 1e-5f64.ln(), 0.7));
    approx::assert_abs_diff_eq!(one.state, other.state, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(one.d_log_rate, other.d_log_rate, epsilon = 1e-15);
}

/// φ = b ln(1 + V2 θ/L) with θ of the ageing law.
#[test]
fn a_cut_off_bounds_the_state_effect() {
    let v2 = 1e-4;
    let plain = Ageing::new(B, LENGTH, V_REF).unwrap();
    let cut = plain.with_cut_off(v2).unwrap();
    let expected = |theta: f64| B * (v2 * theta / LENGTH).ln_1p();
    for (v1, v) in [(1e-9, 1e-6), (1e-6, 1e-3), (1e-2, 1e-5), (1e-3, 1.0)] {
        let state = cut.steady(f64::ln(v1));
        approx::assert_relative_eq!(
            cut.phi(state),
            expected(LENGTH / v1),
            epsilon = 0.0,
            max_relative = 1e-13
        );
        for slip in [1e-3, 0.1, 1.0, 5.0] {
            let after = cut.step(state, f64::ln(v), slip * LENGTH / v);
            assert_eq!(after, plain.step(state, f64::ln(v), slip * LENGTH / v));
            let theta = LENGTH / v + (LENGTH / v1 - LENGTH / v) * f64::exp(-slip);
            approx::assert_relative_eq!(
                cut.phi(after.state),
                expected(theta),
                epsilon = 0.0,
                max_relative = 1e-13
            );
        }
    }
    // Nothing is left of it at V ≫ V2; at V ≪ V2 it is the plain law with another reference.
    assert!(cut.phi(cut.steady(f64::ln(1e12))) <= 1.01e-16 * B);
    for state in [30.0, 39.0 - f64::ln(100.0), 41.0 - f64::ln(100.0), 80.0] {
        approx::assert_relative_eq!(
            cut.phi(state),
            plain.phi(state) + B * f64::ln(100.0),
            epsilon = 0.0,
            max_relative = 1e-14
        );
    }
}

/// (1 + c) dφ/dt = b (1/θ - V/L) at constant V.
#[test]
fn the_nagata_law_ages_on_a_slower_clock() {
    let ageing = Ageing::new(B, LENGTH, V_REF).unwrap();
    for c in [0.0, 0.5, 2.0, 30.0] {
        let nagata = Nagata::new(B, LENGTH, V_REF, c).unwrap();
        assert_eq!(nagata.shear_memory(), c);
        for state in [-5.0, 0.0, 10.0] {
            for v in rates() {
                for dt in [1e-3, 1.0, 1e5] {
                    let (slow, fast) =
                        (nagata.step(state, v.ln(), dt), ageing.step(state, v.ln(), dt / (1.0 + c)));
                    let rounding = 8.0 * f64::EPSILON * (1.0 + fast.state.abs());
                    assert!((slow.state - fast.state).abs() <= rounding, "{c} {state} {v} {dt}");
                }
            }
        }
    }
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

#[test]
fn parameters_of_the_other_laws_are_refused_by_name() {
    fn refused<T: std::fmt::Debug>(result: Result<T, Failure>, expected: &str) {
        match result {
            Err(Failure::Parameter { name, .. }) => assert_eq!(name, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
    let p = Parameters::new(0.6, 0.01, 1e-6).unwrap();
    let w = weakening(0.01);
    for bad in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        refused(Prz::new(B, bad, V_REF), "l");
        refused(Prz::new(B, LENGTH, bad), "v_ref");
        refused(Nagata::new(bad, LENGTH, V_REF, 2.0), "b");
        refused(Nagata::new(B, bad, V_REF, 2.0), "l");
        refused(Nagata::new(B, LENGTH, bad, 2.0), "v_ref");
        refused(Flash::new(w, bad), "l");
        refused(Flash::new(Weakening { v_ref: bad, ..w }, LENGTH), "v_ref");
        refused(Flash::new(Weakening { v_w: bad, ..w }, LENGTH), "v_w");
        refused(Ageing::new(B, LENGTH, V_REF).unwrap().with_cut_off(bad), "v_cut_state");
        refused(CutOff::new(p, bad), "v_cut");
        refused(Arrhenius::new(Bare(p), 9e4, bad, 300.0), "t_ref");
        refused(Arrhenius::new(Bare(p), 9e4, 300.0, bad), "temperature");
        let part = Component::new(Ageing::new(B, LENGTH, V_REF).unwrap(), 0.2).unwrap();
        refused(RateLaw::with_parts(Bare(p), vec![part], 1e-6, bad, None), "normal_initial");
    }
    for bad in [-0.01, f64::NAN, f64::INFINITY] {
        refused(Nagata::new(B, LENGTH, V_REF, bad), "c");
        refused(Arrhenius::new(Bare(p), bad, 293.0, 300.0), "activation");
        refused(Component::new(Slip::new(B, LENGTH, V_REF).unwrap(), bad), "alpha");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        refused(Prz::new(bad, LENGTH, V_REF), "b");
        refused(Flash::new(Weakening { mu0: bad, ..w }, LENGTH), "mu0");
        refused(Flash::new(Weakening { a: bad, ..w }, LENGTH), "a");
        refused(Flash::new(Weakening { b: bad, ..w }, LENGTH), "b");
    }
    for bad in [-0.1, 0.6, 0.7, f64::NAN] {
        refused(Flash::new(Weakening { mu_w: bad, ..w }, LENGTH), "mu_w");
    }
    // A memory of μ has nothing to act on where b = 0.
    refused(Component::new(Ageing::new(0.0, LENGTH, V_REF).unwrap(), 0.2), "alpha");
    assert!(Component::new(Ageing::new(0.0, LENGTH, V_REF).unwrap(), 0.0).is_ok());
    let nagata = Component::new(Nagata::new(B, LENGTH, V_REF, 2.0).unwrap(), 0.0).unwrap();
    refused(RateLaw::with_parts(Bare(p), vec![nagata.clone(), nagata], 1e-6, 1e6, None), "states");
}
