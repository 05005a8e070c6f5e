//! Long waits and short events on one clock.

use super::common::*;
use asperity_ode::{Clock, Method, Problem, integrate};
use std::f64::consts::PI;

#[test]
fn a_clock_loses_nothing_when_its_zero_moves() {
    let mut clock = Clock::new(1e9, 0.0);
    let start = clock;
    for _ in 0..1_000_000 {
        clock = clock.later(1e-9).rebased();
    }
    assert!((clock.since(&start) - 1e-3).abs() < 1e-17, "{:e}", clock.since(&start) - 1e-3);
    let ahead = Clock::new(2.0, 1e9);
    assert_eq!(ahead.since(&Clock::new(1e9, 1.0)), 1.0);
}

#[test]
fn events_a_microsecond_apart_are_resolved_after_thirty_years() {
    let late = Clock::new(1e9, 0.0);
    let fast = TestProblem {
        zero: late,
        size: 2,
        events: 1,
        rates: |_, y, dy| (dy[0], dy[1]) = (PI * 1e6 * y[1], -PI * 1e6 * y[0]),
        jacobian: |_, _, j| j.copy_from_slice(&[0.0, -PI * 1e6, PI * 1e6, 0.0]),
        event: |_, y, g| g[0] = y[0],
    };
    for method in Method::ALL {
        let tolerance = if method == Method::TrBdf2 { 1e-6 } else { 1e-8 };
        let mut record = Record::new();
        let finished =
            integrate(&fast, late, &[0.0, 1.0], 20.5e-6, &options(method, tolerance, 2), &mut record);
        completed(&finished);
        assert_eq!(record.occurrences.len(), 20, "{}", method.name());
        for (k, o) in record.occurrences.iter().enumerate() {
            let error = (o.at.since(&late) - (k + 1) as f64 * 1e-6).abs();
            assert!(error < 1e4 * tolerance * 1e-6, "{}: {error:e} s", method.name());
        }
        assert!((finished.at.since(&late) - 20.5e-6).abs() < 1e-20, "{}", method.name());
    }
}

/// A state at rest, with events at 1e9 s and 1e-6 s later.
struct Wait;

impl Problem for Wait {
    fn size(&self) -> usize {
        1
    }
    fn rates(&self, _: Clock, _: &[f64], dy: &mut [f64]) {
        dy[0] = 0.0;
    }
    fn jacobian(&self, _: Clock, _: &[f64], jac: &mut [f64]) {
        jac[0] = 0.0;
    }
    fn events(&self) -> usize {
        2
    }
    fn event(&self, at: Clock, _: &[f64], g: &mut [f64]) {
        g[0] = at.since(&Clock::new(1e9, 0.0));
        g[1] = at.since(&Clock::new(1e9, 1e-6));
    }
}

#[test]
fn a_short_event_after_a_long_wait_keeps_its_length() {
    for method in Method::ALL {
        let mut record = Record::new();
        completed(&integrate(&Wait, START, &[0.0], 1.5e9, &options(method, 1e-6, 1), &mut record));
        assert_eq!(record.occurrences.len(), 2, "{}", method.name());
        let apart = record.occurrences[1].at.since(&record.occurrences[0].at);
        // The first event is found on the clock of the long wait, whose resolution there is 1e-7 s.
        assert!((apart - 1e-6).abs() < 3e-7, "{}: {apart:e}", method.name());
    }
}
