//! Integration of small systems: orders, events, time, stiffness and failures.
#![allow(clippy::unwrap_used)]

use asperity_driver::ode::{
    Clock, Control, Counts, Failure, Finished, Method, Occurrence, Options, Outcome, Problem, Sink, Step,
    integrate,
};
use std::f64::consts::PI;

type Rates = fn(f64, &[f64], &mut [f64]);
type Jacobian = fn(f64, &[f64], &mut [f64]);
type Events = fn(f64, &[f64], &mut [f64]);

/// A problem of functions of the time since `zero`.
struct Given {
    zero: Clock,
    size: usize,
    events: usize,
    rates: Rates,
    jacobian: Jacobian,
    event: Events,
}

impl Problem for Given {
    fn size(&self) -> usize {
        self.size
    }
    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        (self.rates)(at.since(&self.zero), y, dy);
    }
    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]) {
        (self.jacobian)(at.since(&self.zero), y, jac);
    }
    fn events(&self) -> usize {
        self.events
    }
    fn event(&self, at: Clock, y: &[f64], g: &mut [f64]) {
        (self.event)(at.since(&self.zero), y, g);
    }
}

const START: Clock = Clock::new(0.0, 0.0);

/// Records everything and checks that it makes sense.
struct Record {
    ends: Vec<Clock>,
    lengths: Vec<f64>,
    occurrences: Vec<Occurrence>,
    last: Option<Clock>,
    /// Largest error of dense output against this solution of the time since the start.
    exact: Option<fn(f64) -> f64>,
    dense_error: f64,
    /// The same at the ends of steps.
    end_error: f64,
    stop_at_event: bool,
}

impl Record {
    fn new() -> Self {
        Self {
            ends: vec![],
            lengths: vec![],
            occurrences: vec![],
            last: None,
            exact: None,
            dense_error: 0.0,
            end_error: 0.0,
            stop_at_event: false,
        }
    }
}

impl Sink for Record {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        assert!(step.state.iter().all(|v| v.is_finite()), "a state that is not finite was accepted");
        assert!(step.length() > 0.0, "a step of no length");
        if let Some(last) = self.last {
            assert_eq!(step.start.since(&last), 0.0, "a gap between steps");
        }
        let mut y = vec![0.0; step.state.len()];
        step.at(1.0, &mut y);
        for (a, b) in y.iter().zip(step.state) {
            assert!((a - b).abs() <= 1e-5 * (1.0 + b.abs()), "dense output ends at {a}, the step at {b}");
        }
        if let Some(exact) = self.exact {
            self.end_error = self.end_error.max((step.state[0] - exact(step.end.seconds())).abs());
            for fraction in [0.25, 0.5, 0.75] {
                step.at(fraction, &mut y);
                let t = step.start.seconds() + fraction * step.length();
                self.dense_error = self.dense_error.max((y[0] - exact(t)).abs());
            }
        }
        self.last = Some(step.end);
        self.ends.push(step.end);
        self.lengths.push(step.length());
        Control::Go
    }
    fn occurred(&mut self, occurrence: &Occurrence) -> Control {
        self.occurrences.push(occurrence.clone());
        if self.stop_at_event { Control::Stop } else { Control::Go }
    }
}

fn options(method: Method, tolerance: f64, n: usize) -> Options {
    Options {
        method,
        rtol: tolerance,
        atol: vec![tolerance; n],
        first_step: None,
        largest_step: None,
        most_steps: 1_000_000,
    }
}

fn no_events(_: f64, _: &[f64], _: &mut [f64]) {}

fn oscillator() -> Given {
    Given {
        zero: START,
        size: 2,
        events: 1,
        rates: |_, y, dy| (dy[0], dy[1]) = (y[1], -y[0]),
        jacobian: |_, _, j| j.copy_from_slice(&[0.0, -1.0, 1.0, 0.0]),
        event: |_, y, g| g[0] = y[0],
    }
}

/// y0' = y0 y1, y1' = -2 t y1^2 with y0 = exp(arctan t), y1 = 1/(1 + t^2).
fn bell() -> Given {
    Given {
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

fn completed(finished: &Finished) {
    assert_eq!(finished.outcome, Outcome::Completed, "{finished:?}");
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

/// Largest error at the ends of steps, and the largest of dense output, with `steps` equal steps.
fn with_equal_steps(method: Method, steps: usize) -> (f64, f64) {
    let h = 2.0 / steps as f64;
    let mut record = Record::new();
    record.exact = Some(bell_exact);
    // The tolerance accepts every length; the stages of radau5 are solved to a share of it that is tight enough.
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

/// y' = 1 with three thresholds: two next to each other and a pair at one time.
fn ramp() -> Given {
    Given {
        zero: START,
        size: 2,
        events: 5,
        rates: |_, _, dy| (dy[0], dy[1]) = (1.0, -2.0),
        jacobian: |_, _, j| j.fill(0.0),
        event: |t, y, g| {
            g[0] = y[0] - 0.6;
            g[1] = y[0] - 0.3;
            g[2] = 0.3 + 1e-9 - y[0];
            g[3] = 2.0 * (y[0] - 0.6);
            g[4] = t - 0.35;
        },
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
    let dip = Given { event: |t, _, g| g[0] = (t - 0.52) * (t - 0.52) - 1e-4, events: 1, ..ramp() };
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

/// y' = -sqrt(y): y = (1 - t/2)^2, and no rates beyond t = 2.
fn draining() -> Given {
    Given {
        zero: START,
        size: 1,
        events: 0,
        rates: |_, y, dy| dy[0] = -y[0].sqrt(),
        jacobian: |_, y, j| j[0] = -0.5 / y[0].sqrt(),
        event: no_events,
    }
}

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
    let wall = Given {
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
fn implicit_methods_pass_a_fast_relaxation_in_few_steps() {
    // y' = -1e6 (y - cos t) - sin t with y = cos t after the start.
    let relaxation = Given {
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
    let stiff = Given {
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
    // E. Hairer and G. Wanner's test set: y(2000) for mu = 1000.
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
fn events_a_microsecond_apart_are_resolved_after_thirty_years() {
    let late = Clock::new(1e9, 0.0);
    let fast = Given {
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

/// Nothing moves; events at 1e9 s and 1e-6 s later.
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
        // The first is found on the clock of the long wait, whose resolution there is 1e-7 s.
        assert!((apart - 1e-6).abs() < 3e-7, "{}: {apart:e}", method.name());
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

#[test]
fn methods_are_known_by_their_names() {
    for method in Method::ALL {
        assert_eq!(method.name().parse::<Method>(), Ok(method));
    }
    assert!("euler".parse::<Method>().is_err());
}

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

/// A spring slider without inertia but with radiation damping: y = (ln V/V0, ln theta V0/D), regularised by neither; stiffness
/// 0.7 of the critical one, so that it sticks and slips from 1e-13 to 1 m/s. Events: V crosses 1 mm/s.
struct Slider;

impl Slider {
    const A: f64 = 0.010e8;
    const B: f64 = 0.015e8;
    const LENGTH: f64 = 0.01;
    const REFERENCE: f64 = 1e-6;
    const LOAD: f64 = 1e-9;
    const DAMPING: f64 = 5e6;
    const STIFFNESS: f64 = 0.7 * (Self::B - Self::A) / Self::LENGTH;
}

impl Problem for Slider {
    fn size(&self) -> usize {
        2
    }
    fn rates(&self, _: Clock, y: &[f64], dy: &mut [f64]) {
        let v = Self::REFERENCE * y[0].exp();
        let ageing = Self::REFERENCE / Self::LENGTH * (-y[1]).exp() - v / Self::LENGTH;
        dy[1] = ageing;
        dy[0] = (Self::STIFFNESS * (Self::LOAD - v) - Self::B * ageing) / (Self::A + Self::DAMPING * v);
    }
    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]) {
        let v = Self::REFERENCE * y[0].exp();
        let healing = Self::REFERENCE / Self::LENGTH * (-y[1]).exp();
        let mut dy = [0.0; 2];
        self.rates(at, y, &mut dy);
        let mass = Self::A + Self::DAMPING * v;
        jac[1] = -v / Self::LENGTH;
        jac[3] = -healing;
        jac[0] = (-Self::STIFFNESS * v - Self::B * jac[1] - dy[0] * Self::DAMPING * v) / mass;
        jac[2] = -Self::B * jac[3] / mass;
    }
    fn events(&self) -> usize {
        1
    }
    fn event(&self, _: Clock, y: &[f64], g: &mut [f64]) {
        g[0] = y[0] - 1000.0_f64.ln();
    }
}

#[test]
fn every_method_finds_the_same_earthquakes() {
    let onsets = |method, tolerance| {
        let mut record = Record::new();
        let finished =
            integrate(&Slider, START, &[-6.0, 6.0], 1e10, &options(method, tolerance, 2), &mut record);
        completed(&finished);
        let onsets: Vec<Clock> = record.occurrences.iter().filter(|o| o.rising).map(|o| o.at).collect();
        let ends: Vec<Clock> = record.occurrences.iter().filter(|o| !o.rising).map(|o| o.at).collect();
        assert!(
            onsets.len() >= 3 && onsets.len().abs_diff(ends.len()) <= 1,
            "{} {finished:?}",
            method.name()
        );
        (onsets, ends)
    };
    let reference = onsets(Method::Dop853, 1e-12);
    let recurrence = reference.0[2].since(&reference.0[1]);
    let duration = reference.1[2].since(&reference.0[2]);
    for (method, tolerance) in [
        (Method::Tsit5, 1e-9),
        (Method::Tsit45, 1e-9),
        (Method::Dop853, 1e-9),
        (Method::Radau5, 1e-8),
        (Method::Bdf, 1e-8),
        (Method::Esdirk34, 1e-8),
        (Method::TrBdf2, 1e-6),
    ] {
        let (starts, ends) = onsets(method, tolerance);
        let error = (starts[2].since(&starts[1]) / recurrence - 1.0).abs();
        let shape = (ends[2].since(&starts[2]) / duration - 1.0).abs();
        assert!(error < 1e3 * tolerance, "{}: recurrence {error:e}", method.name());
        assert!(shape < 1e4 * tolerance, "{}: duration {shape:e}", method.name());
    }
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

#[test]
fn an_event_at_the_end_or_just_before_it_is_found() {
    for method in Method::ALL {
        for place in [1.0, 1.0 - 1e-9, 1e-9] {
            let given = Given { events: 1, event: |t, y, g| g[0] = t - y[1], ..unit_ramp() };
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

/// y0' = 1 and y1' = 0.
fn unit_ramp() -> Given {
    Given { rates: |_, _, dy| (dy[0], dy[1]) = (1.0, 0.0), ..ramp() }
}

#[test]
fn many_unknowns_are_integrated_like_two() {
    // Decays of ten rates.
    let decays = Given {
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
