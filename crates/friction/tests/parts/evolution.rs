//! Properties of every evolution: derivatives, composition of steps, steady states, bounds.

use super::common::*;
use super::usual::usual;
use asperity_friction::each_evolution;
use asperity_friction::evolution::flash::Flash;
use asperity_friction::evolution::{
    Common, Evolution, Speed, TableEvolution, Variable, ageing::Ageing, nagata::Nagata, slip::Slip,
};

/// Calls a function with every evolution of the table, and with values of its state variable to start from.
macro_rules! with_every_evolution {
    ($check:ident, $of_log:expr, $of_phi:expr) => {
        each_evolution!(Law => {
            let states: &[f64] = match <Law as TableEvolution>::DEFINITION.variable {
                Variable::Logarithm { .. } => &$of_log,
                Variable::Contribution { .. } => &$of_phi,
            };
            let common = Common { mu0: 0.6, a: 0.01, v_ref: V_REF, b: B, length: LENGTH };
            $check(&usual::<Law>(common), states);
        });
        // Cases not reached by usual parameters.
        $check(&Ageing::new(B, LENGTH, V_REF).unwrap().with_cut_off(1e-2).unwrap(), &$of_log);
        $check(&Ageing::new(B, LENGTH, V_REF).unwrap().with_cut_off(1e-8).unwrap(), &$of_log);
        $check(&Flash::new(weakening(0.01), LENGTH).unwrap(), &$of_phi);
        $check(&Flash::new(weakening(0.02), LENGTH).unwrap(), &$of_phi);
    };
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
                    // The old state fades over δx = 1; flash heating sets in over an eighth of an e-fold.
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
        // Relaxation is linear in the state, and φ is linear in s where nothing cuts it off.
        if e.per_phi() != 1.0 {
            by_state.told(0.2);
        }
    }
    with_every_evolution!(check, [-5.0, 0.0, 3.0, 20.0], [-0.1, 0.0, 0.2]);
}

/// One step over Δt equals seven steps over Δt/7, at any rate.
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

#[test]
fn the_rate_of_the_state_is_the_slope_of_its_exact_step_in_time() {
    fn check<E: Evolution>(e: &E, states: &[f64]) {
        for &state in states {
            for v in [1e-12, 1e-8, 1e-6, 1e-3, 0.1, 3.0] {
                let z = f64::ln(v);
                let r = e.rate(state, Speed::from_log(z));
                // Of the order of the shortest time scale.
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
                let r = e.rate(state, Speed::from_log(z));
                let size = r.rate.abs() + r.d_log_rate.abs() + r.d_state.abs();
                let rounding = f64::EPSILON * size * (4.0 + z.abs() + state.abs());
                let what = || format!("{} from {state} at {v}: {r:?}", E::NAME);
                let at = |h: f64| e.rate(state, Speed::from_log(z + h)).rate;
                by_rate.add(taylor(at, r.d_log_rate, 0.005, rounding), what);
                let from = |h: f64| e.rate(state + h, Speed::from_log(z)).rate;
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
            let r = e.rate(steady, Speed::from_log(z)).rate;
            assert!(r.abs() <= rounding * v / LENGTH, "{} {v}: {r:e}", E::NAME);
            for dt in [1e-3, 1.0, 1e9] {
                let after = e.step(steady, z, dt).state;
                assert!((after - steady).abs() <= 1e-13 * steady.abs().max(1.0), "{} {v} {dt}", E::NAME);
            }
        }
    }
    with_every_evolution!(check, [], []);
}

/// A state that slips far also arrives there from any initial value.
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
                    // The bound is valid for all rates up to the given one.
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
                let r = e.rate(state, Speed::from_log(z));
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
    let nagata = Nagata::new(B, LENGTH, V_REF, 2.0).unwrap();
    approx::assert_relative_eq!(
        nagata.step(0.0, f64::MIN, 270.0).state,
        10f64.ln(),
        epsilon = 0.0,
        max_relative = 1e-14
    );
}
