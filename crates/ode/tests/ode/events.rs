//! Events: order, position, direction, start and end, and continuation from one.

use super::common::*;
use asperity_ode::{Method, Outcome, integrate};
use std::f64::consts::PI;

#[test]
fn every_method_finds_a_hundred_crossings_where_they_are() {
    for method in Method::ALL {
        let tolerance = if method == Method::TrBdf2 { 1e-6 } else { 1e-8 };
        let mut record = Record::new();
        let finished = integrate(
            &oscillator(),
            START,
            &[0.0, 1.0],
            100.5 * PI,
            &options(method, tolerance, 2),
            &mut record,
        );
        completed(&finished);
        assert_eq!(record.occurrences.len(), 100, "{}", method.name());
        let mut largest = 0.0_f64;
        for (k, o) in record.occurrences.iter().enumerate() {
            let error = (o.at.seconds() - (k + 1) as f64 * PI).abs();
            assert_eq!(o.rising, k % 2 == 1, "{} crossing {k}", method.name());
            assert!(o.state[0].abs() < 1e-9, "{}: state {} at crossing {k}", method.name(), o.state[0]);
            largest = largest.max(error);
        }
        // Errors of a hundred half turns add up.
        let allowed = if method == Method::Bdf { 2e4 } else { 5e3 };
        assert!(largest < allowed * tolerance, "{}: {largest:e}", method.name());
    }
}

#[test]
fn an_event_that_holds_at_the_start_does_not_fire() {
    for method in Method::ALL {
        let mut record = Record::new();
        completed(&integrate(&oscillator(), START, &[0.0, 1.0], 3.0, &options(method, 1e-6, 2), &mut record));
        assert!(record.occurrences.is_empty(), "{}: {:?}", method.name(), record.occurrences);
    }
}

#[test]
fn events_in_one_step_are_found_in_order_of_time() {
    for method in Method::ALL {
        let mut record = Record::new();
        let mut given = options(method, 1e-3, 2);
        given.first_step = Some(1.0);
        completed(&integrate(&ramp(), START, &[0.0, 0.0], 1.0, &given, &mut record));
        let found: Vec<(usize, bool)> = record.occurrences.iter().map(|o| (o.event, o.rising)).collect();
        assert_eq!(found, [(1, true), (2, false), (4, true), (0, true), (3, true)], "{}", method.name());
        let times = [0.3, 0.3 + 1e-9, 0.35, 0.6, 0.6];
        for (o, time) in record.occurrences.iter().zip(times) {
            assert!((o.at.seconds() - time).abs() < 1e-13, "{} {o:?}", method.name());
            assert!((o.state[1] + 2.0 * time).abs() < 1e-12, "{} {o:?}", method.name());
        }
    }
}

#[test]
fn two_changes_of_one_function_within_a_step_are_found() {
    let dip = TestProblem { event: |t, _, g| g[0] = (t - 0.52) * (t - 0.52) - 1e-4, events: 1, ..ramp() };
    for method in Method::ALL {
        let mut record = Record::new();
        let mut given = options(method, 1e-3, 2);
        given.first_step = Some(1.0);
        completed(&integrate(&dip, START, &[0.0, 0.0], 1.0, &given, &mut record));
        let found: Vec<bool> = record.occurrences.iter().map(|o| o.rising).collect();
        assert_eq!(found, [false, true], "{}", method.name());
        assert!((record.occurrences[0].at.seconds() - 0.51).abs() < 1e-12, "{}", method.name());
        assert!((record.occurrences[1].at.seconds() - 0.53).abs() < 1e-12, "{}", method.name());
    }
}

#[test]
fn the_sink_stops_the_integration_at_an_event() {
    for method in Method::ALL {
        let mut record = Record::new();
        record.stop_at_event = true;
        let finished =
            integrate(&oscillator(), START, &[0.0, 1.0], 100.0, &options(method, 1e-9, 2), &mut record);
        assert_eq!(finished.outcome, Outcome::Stopped);
        assert!((finished.at.seconds() - PI).abs() < 1e-5, "{}: {finished:?}", method.name());
        assert_eq!(finished.state, record.occurrences[0].state);
        assert_eq!(finished.at.since(&record.occurrences[0].at), 0.0);
    }
}

#[test]
fn an_integration_goes_on_from_an_event_without_finding_it_again() {
    for method in Method::ALL {
        let given = options(method, 1e-7, 2);
        let (mut at, mut state) = (START, vec![0.3, 1.0]);
        for k in 0..6 {
            let mut record = Record::new();
            record.stop_at_event = true;
            let finished = integrate(&oscillator(), at, &state, 10.0, &given, &mut record);
            assert_eq!(finished.outcome, Outcome::Stopped);
            let time = finished.at.since(&at);
            assert!(k == 0 || (time - PI).abs() < 1e-3, "{} after {time} s", method.name());
            (at, state) = (finished.at, finished.state);
        }
    }
}

/// y0' = 1 and y1' = 0.
fn unit_ramp() -> TestProblem {
    TestProblem { rates: |_, _, dy| (dy[0], dy[1]) = (1.0, 0.0), ..ramp() }
}

#[test]
fn an_event_at_the_end_or_just_before_it_is_found() {
    for method in Method::ALL {
        for place in [1.0, 1.0 - 1e-9, 1e-9] {
            let given = TestProblem { events: 1, event: |t, y, g| g[0] = t - y[1], ..unit_ramp() };
            let mut record = Record::new();
            completed(&integrate(&given, START, &[0.0, place], 1.0, &options(method, 1e-6, 2), &mut record));
            assert_eq!(record.occurrences.len(), 1, "{} at {place}", method.name());
            assert!(
                (record.occurrences[0].at.seconds() - place).abs() < 1e-13,
                "{} at {place}",
                method.name()
            );
            assert_eq!(record.last.map(|at| at.seconds()), Some(1.0), "{} at {place}", method.name());
        }
    }
}
