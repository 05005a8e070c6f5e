//! Strength forms: values, derivatives, inverses, limits, temperature.

use super::common::*;
use asperity_friction::strength::arrhenius::{Arrhenius, GAS_CONSTANT};
use asperity_friction::strength::cut_off::CutOff;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};

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

/// At low rates the strength is linear, at high rates logarithmic, and in between the asinh of the standard library.
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
    // The slope remains in the range of numbers where the factor of V exceeds it.
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
        // The last is an e-fold of 1 + V1/V below the saturation of the smallest φ.
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
                    // V is exponential in m above one, and linear in m below.
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
    // Above all its strengths, the form with a cut-off has no rate.
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
    // Above V1 there is no further gain: less than a V1/V remains.
    assert!((form.at(1e4f64.ln(), 0.0).mu - 0.6).abs() <= a * 1.001e-9);
    // Below, it is the bare logarithm with V1 as its reference.
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
    // At the reference, or without activation, there is no effect; warm rock is weaker.
    let z = f64::ln(3e-7);
    let same = Arrhenius::new(Regularised(p), q, reference, reference).unwrap();
    assert_eq!(same.at(z, 0.1), Regularised(p).at(z, 0.1));
    let idle = Arrhenius::new(Regularised(p), 0.0, reference, 900.0).unwrap();
    assert_eq!((idle.at(z, 0.1), idle.d_temperature(z, 0.1)), (Regularised(p).at(z, 0.1), 0.0));
    let warm = Arrhenius::new(Regularised(p), q, reference, 350.0).unwrap();
    assert!(warm.at(z, 0.1).mu < same.at(z, 0.1).mu);
}
