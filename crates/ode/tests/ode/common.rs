//! Problems, and a sink that records the solution and checks its consistency.

use asperity_ode::{Clock, Control, Method, Occurrence, Options, Outcome, Problem, Sink, Solution, Step};

type Rates = fn(f64, &[f64], &mut [f64]);
type Jacobian = fn(f64, &[f64], &mut [f64]);
type Events = fn(f64, &[f64], &mut [f64]);

/// A problem of functions of the time since `zero`.
pub struct TestProblem {
    pub zero: Clock,
    pub size: usize,
    pub events: usize,
    pub rates: Rates,
    pub jacobian: Jacobian,
    pub event: Events,
}

impl Problem for TestProblem {
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

pub const START: Clock = Clock::new(0.0, 0.0);

/// Sink that records the solution and checks its consistency.
pub struct Record {
    pub ends: Vec<Clock>,
    pub lengths: Vec<f64>,
    pub occurrences: Vec<Occurrence>,
    pub last: Option<Clock>,
    /// Exact solution as a function of the time since the start, for the error of dense output.
    pub exact: Option<fn(f64) -> f64>,
    pub dense_error: f64,
    /// Largest error at the ends of steps.
    pub end_error: f64,
    pub stop_at_event: bool,
}

impl Record {
    pub fn new() -> Self {
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

pub fn options(method: Method, tolerance: f64, n: usize) -> Options {
    Options {
        method,
        rtol: tolerance,
        atol: vec![tolerance; n],
        first_step: None,
        begin_stiff: false,
        largest_step: None,
        most_steps: 1_000_000,
    }
}

pub fn no_events(_: f64, _: &[f64], _: &mut [f64]) {}

pub fn oscillator() -> TestProblem {
    TestProblem {
        zero: START,
        size: 2,
        events: 1,
        rates: |_, y, dy| (dy[0], dy[1]) = (y[1], -y[0]),
        jacobian: |_, _, j| j.copy_from_slice(&[0.0, -1.0, 1.0, 0.0]),
        event: |_, y, g| g[0] = y[0],
    }
}

/// y' = 1 with three thresholds: two close together, and two at the same time.
pub fn ramp() -> TestProblem {
    TestProblem {
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

/// y' = -sqrt(y): y = (1 - t/2)^2, and no rates beyond t = 2.
pub fn draining() -> TestProblem {
    TestProblem {
        zero: START,
        size: 1,
        events: 0,
        rates: |_, y, dy| dy[0] = -y[0].sqrt(),
        jacobian: |_, y, j| j[0] = -0.5 / y[0].sqrt(),
        event: no_events,
    }
}

pub fn completed(finished: &Solution) {
    assert_eq!(finished.outcome, Outcome::Completed, "{finished:?}");
}
