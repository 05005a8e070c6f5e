//! Evolutions against their closed forms.

use super::common::*;
use asperity_friction::evolution::flash::Flash;
use asperity_friction::evolution::{Evolution, ageing::Ageing, nagata::Nagata, slip::Slip};

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
    // Far below V_w the slip law remains.
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
    // Its effect vanishes at V ≫ V2; at V ≪ V2 it is the plain law with another reference.
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
