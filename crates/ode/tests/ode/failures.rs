//! Rates that are not finite, too many steps, and invalid requests.

use super::common::*;
use asperity_ode::{Counts, Failure, Method, Options, Outcome, integrate};

#[test]
fn rates_that_are_not_finite_shorten_the_step() {
    for method in Method::ALL {
        let mut given = options(method, 1e-6, 1);
        given.first_step = Some(1.9);
        given.atol = vec![1e-9];
        let mut record = Record::new();
        let finished = integrate(&draining(), START, &[1.0], 1.9, &given, &mut record);
        completed(&finished);
        assert!((finished.state[0] - 0.0025).abs() < 1e-4, "{} {finished:?}", method.name());
    }
}

#[test]
fn where_no_step_has_finite_rates_the_last_good_state_is_returned() {
    let wall = TestProblem {
        rates: |_, y, dy| dy[0] = if y[0] > 0.25 { -1.0 } else { f64::NAN },
        jacobian: |_, _, j| j[0] = 0.0,
        ..draining()
    };
    for method in Method::ALL {
        let mut given = options(method, 1e-6, 1);
        given.most_steps = 10_000;
        let mut record = Record::new();
        let finished = integrate(&wall, START, &[1.0], 3.0, &given, &mut record);
        assert!(matches!(finished.outcome, Outcome::Failed { .. }), "{} {finished:?}", method.name());
        assert!(finished.state[0] >= 0.25 && finished.state[0] < 0.26, "{} {finished:?}", method.name());
        assert!(
            (finished.at.seconds() + finished.state[0] - 1.0).abs() < 1e-9,
            "{} {finished:?}",
            method.name()
        );
    }
}

#[test]
fn a_start_without_finite_rates_is_refused() {
    for method in Method::ALL {
        let finished =
            integrate(&draining(), START, &[-1.0], 1.0, &options(method, 1e-6, 1), &mut Record::new());
        assert_eq!(finished.outcome, Outcome::Failed { reason: Failure::NotFinite }, "{}", method.name());
        assert_eq!(finished.state, [-1.0]);
    }
}

#[test]
fn too_many_steps_end_with_the_last_good_state() {
    for method in Method::ALL {
        let mut given = options(method, 1e-8, 2);
        given.most_steps = 10;
        let mut record = Record::new();
        let finished = integrate(&oscillator(), START, &[0.0, 1.0], 1000.0, &given, &mut record);
        assert_eq!(finished.outcome, Outcome::Failed { reason: Failure::TooManySteps { most: 10 } });
        assert_eq!(finished.counts.steps, 10);
        assert_eq!(record.ends.last(), Some(&finished.at));
        assert!(
            (finished.state[0] - finished.at.seconds().sin()).abs() < 1e-4,
            "{} {finished:?}",
            method.name()
        );
    }
}

#[test]
fn sizes_and_tolerances_without_sense_are_refused() {
    let refused = |given: &Options, state: &[f64], until: f64| {
        let finished = integrate(&oscillator(), START, state, until, given, &mut Record::new());
        assert!(matches!(finished.outcome, Outcome::Failed { reason: Failure::Unfit(_) }), "{finished:?}");
        assert_eq!(finished.counts, Counts::default());
    };
    let good = options(Method::Tsit5, 1e-6, 2);
    refused(&good, &[1.0], 1.0);
    refused(&good, &[1.0, 0.0], -1.0);
    refused(&Options { atol: vec![1e-6], ..good.clone() }, &[1.0, 0.0], 1.0);
    refused(&Options { rtol: 0.0, ..good.clone() }, &[1.0, 0.0], 1.0);
    refused(&Options { largest_step: Some(0.0), ..good }, &[1.0, 0.0], 1.0);
}
