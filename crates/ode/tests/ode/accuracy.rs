//! Orders of methods, errors relative to the tolerance, stiffness, and numbers of unknowns.

use super::common::*;
use asperity_ode::{Method, integrate};

/// y0' = y0 y1, y1' = -2 t y1^2 with y0 = exp(arctan t), y1 = 1/(1 + t^2).
fn bell() -> TestProblem {
    TestProblem {
        zero: START,
        size: 2,
        events: 0,
        rates: |t, y, dy| (dy[0], dy[1]) = (y[0] * y[1], -2.0 * t * y[1] * y[1]),
        jacobian: |t, y, j| j.copy_from_slice(&[y[1], 0.0, y[0], -4.0 * t * y[1]]),
        event: no_events,
    }
}

fn bell_exact(t: f64) -> f64 {
    t.atan().exp()
}

#[test]
fn the_error_decreases_with_the_tolerance_for_every_method() {
    for method in Method::ALL {
        let tolerances: &[f64] =
            if method == Method::TrBdf2 { &[1e-4, 1e-6, 1e-8] } else { &[1e-5, 1e-7, 1e-9] };
        let mut before = f64::INFINITY;
        for &tolerance in tolerances {
            let mut record = Record::new();
            record.exact = Some(bell_exact);
            let finished =
                integrate(&bell(), START, &[1.0, 1.0], 3.0, &options(method, tolerance, 2), &mut record);
            completed(&finished);
            assert_eq!(finished.at.seconds(), 3.0);
            let error = (finished.state[0] - bell_exact(3.0)).abs();
            let allowed = if method == Method::Bdf { 1000.0 } else { 100.0 };
            assert!(error < allowed * tolerance, "{} at {tolerance:e}: {error:e}", method.name());
            assert!(error < before, "{} at {tolerance:e}: {error:e} after {before:e}", method.name());
            assert!(
                record.dense_error < allowed * tolerance,
                "{} dense {:e}",
                method.name(),
                record.dense_error
            );
            before = error;
        }
    }
}

/// Largest error at the ends of steps and largest error of dense output, with `steps` equal steps.
fn with_equal_steps(method: Method, steps: usize) -> (f64, f64) {
    let h = 2.0 / steps as f64;
    let mut record = Record::new();
    record.exact = Some(bell_exact);
    // The tolerance accepts every length; the stages of radau5 are solved to a sufficiently tight fraction of it.
    let mut options = options(method, 1.0, 2);
    if method == Method::Radau5 {
        options.rtol = 1e-9;
        options.atol = vec![1e3, 1e3];
    } else {
        options.atol = vec![1e9; 2];
    }
    (options.first_step, options.largest_step) = (Some(h), Some(h));
    let finished = integrate(&bell(), START, &[1.0, 1.0], 2.0, &options, &mut record);
    completed(&finished);
    assert_eq!(record.lengths.len(), steps);
    (record.end_error, record.dense_error)
}

#[test]
fn dop853_is_of_order_eight_with_dense_output_of_order_seven() {
    let (coarse, fine) = (with_equal_steps(Method::Dop853, 8), with_equal_steps(Method::Dop853, 16));
    let (order, dense) = ((coarse.0 / fine.0).log2(), (coarse.1 / fine.1).log2());
    assert!(order > 7.5, "order {order} from {coarse:?} and {fine:?}");
    assert!(dense > 6.7, "order {dense} of dense output from {coarse:?} and {fine:?}");
}

#[test]
fn tsit5_is_of_order_five_with_dense_output_of_order_four() {
    let (coarse, fine) = (with_equal_steps(Method::Tsit5, 32), with_equal_steps(Method::Tsit5, 64));
    let (order, dense) = ((coarse.0 / fine.0).log2(), (coarse.1 / fine.1).log2());
    assert!(order > 4.7 && order < 6.5, "order {order} from {coarse:?} and {fine:?}");
    assert!(dense > 3.7, "order {dense} of dense output from {coarse:?} and {fine:?}");
}

#[test]
fn radau5_is_of_order_five_with_dense_output_of_order_three() {
    let (coarse, fine) = (with_equal_steps(Method::Radau5, 16), with_equal_steps(Method::Radau5, 32));
    let (order, dense) = ((coarse.0 / fine.0).log2(), (coarse.1 / fine.1).log2());
    assert!(order > 4.5, "order {order} from {coarse:?} and {fine:?}");
    assert!(dense > 2.8, "order {dense} of dense output from {coarse:?} and {fine:?}");
}

#[test]
fn implicit_methods_pass_a_fast_relaxation_in_few_steps() {
    // y' = -1e6 (y - cos t) - sin t with y = cos t after the start.
    let relaxation = TestProblem {
        rates: |t, y, dy| dy[0] = -1e6 * (y[0] - t.cos()) - t.sin(),
        jacobian: |_, _, j| j[0] = -1e6,
        ..draining()
    };
    for method in Method::ALL.into_iter().filter(|m| m.implicit()) {
        let finished =
            integrate(&relaxation, START, &[2.0], 10.0, &options(method, 1e-6, 1), &mut Record::new());
        completed(&finished);
        assert!((finished.state[0] - 10.0_f64.cos()).abs() < 1e-5, "{} {finished:?}", method.name());
        assert!(finished.counts.steps < 5000, "{} {:?}", method.name(), finished.counts);
    }
}

#[test]
fn implicit_methods_follow_a_stiff_van_der_pol_oscillator() {
    let stiff = TestProblem {
        size: 2,
        rates: |_, y, dy| (dy[0], dy[1]) = (y[1], 1000.0 * (1.0 - y[0] * y[0]) * y[1] - y[0]),
        jacobian: |_, y, j| {
            j.copy_from_slice(&[0.0, -2000.0 * y[0] * y[1] - 1.0, 1.0, 1000.0 * (1.0 - y[0] * y[0])]);
        },
        ..draining()
    };
    let run = |method, tolerance: f64| {
        let mut given = options(method, tolerance, 2);
        given.atol = vec![tolerance, tolerance];
        let finished = integrate(&stiff, START, &[2.0, 0.0], 2000.0, &given, &mut Record::new());
        completed(&finished);
        finished
    };
    // Test set of E. Hairer and G. Wanner: y(2000) for mu = 1000.
    let (y, speed) = (1.706_167_732_170_483, -8.928_097_010_247_975e-4);
    for (method, tolerance, allowed) in
        [(Method::Radau5, 1e-8, 1e-5), (Method::Bdf, 1e-8, 1e-3), (Method::Esdirk34, 1e-8, 1e-3)]
    {
        let finished = run(method, tolerance);
        assert!((finished.state[0] - y).abs() < allowed, "{} {finished:?}", method.name());
        assert!((finished.state[1] - speed).abs() < allowed, "{} {finished:?}", method.name());
        assert!(finished.counts.steps < 60_000, "{} {:?}", method.name(), finished.counts);
    }
}

#[test]
fn no_step_exceeds_the_largest() {
    for method in Method::ALL {
        let mut given = options(method, 1e-3, 2);
        given.largest_step = Some(0.01);
        let mut record = Record::new();
        completed(&integrate(&oscillator(), START, &[0.5, 1.0], 1.0, &given, &mut record));
        assert!(record.lengths.iter().all(|&h| h <= 0.01 * (1.0 + 1e-12)), "{}", method.name());
    }
}

#[test]
fn methods_are_known_by_their_names() {
    for method in Method::ALL {
        assert_eq!(method.name().parse::<Method>(), Ok(method));
    }
    assert!("euler".parse::<Method>().is_err());
}

#[test]
fn nothing_happens_in_no_time() {
    for method in Method::ALL {
        let mut record = Record::new();
        let finished =
            integrate(&oscillator(), START, &[0.5, 1.0], 0.0, &options(method, 1e-6, 2), &mut record);
        completed(&finished);
        assert_eq!(
            (finished.state.as_slice(), record.ends.len()),
            ([0.5, 1.0].as_slice(), 0),
            "{}",
            method.name()
        );
    }
}

#[test]
fn many_unknowns_are_integrated_like_two() {
    // Decays at ten rates.
    let decays = TestProblem {
        zero: START,
        size: 10,
        events: 0,
        rates: |_, y, dy| {
            for (i, (rate, value)) in dy.iter_mut().zip(y).enumerate() {
                *rate = -0.1 * (i + 1) as f64 * value;
            }
        },
        jacobian: |_, _, j| {
            j.fill(0.0);
            for i in 0..10 {
                j[11 * i] = -0.1 * (i + 1) as f64;
            }
        },
        event: no_events,
    };
    for method in Method::ALL {
        let finished =
            integrate(&decays, START, &[1.0; 10], 2.0, &options(method, 1e-7, 10), &mut Record::new());
        completed(&finished);
        for (i, value) in finished.state.iter().enumerate() {
            assert!((value - (-0.2 * (i + 1) as f64).exp()).abs() < 1e-5, "{} {i}: {value}", method.name());
        }
    }
}
