//! A fault with vector slip, solved for slip and state: a slider on an isotropic spring, or points coupled by an operator.

use crate::CaseError;
use asperity_cycles::operator::Operator;
use asperity_ode::{Clock, Control, Method, Occurrence, Options, Outcome, Problem, Sink, Step, integrate};
use asperity_plan::faults::Plan;

/// Friction of the scene: f0, a, b, L \[m\] and V0 \[m/s\].
const F0: f64 = 0.6;
const A: f64 = 0.01;
const B: f64 = 0.015;
const L: f64 = 8e-3;
const V0: f64 = 1e-6;
/// f_n \[Pa\], initial slip rate, and the rate at which the initial state is steady \[m/s\].
const NORMAL: f64 = 50e6;
const START: f64 = 1.1e-9;
const STEADY: f64 = 1e-9;
/// G \[Pa\] and the distance between the driven faces \[m\].
const MODULUS: f64 = 32e9;
const WIDE: f64 = 2e3;
const DENSITY: f64 = 2670.0;

/// Tolerance of the integration.
const EXACT: f64 = 1e-11;
/// Maximum of Newton steps; a few suffice from the previous rate.
const MOST: usize = 100;

/// Tractions caused by slip.
enum Elastic<'a> {
    /// A spring of stiffness G/W in both directions, driven at these rates \[m/s\].
    Spring([f64; 2]),
    /// The operator of a plan, and the traction rates of its loads, component by component \[Pa/s\].
    Body(&'a dyn Operator, Vec<f64>),
}

/// Problem with the unknowns slip of all points along the initial traction, then across it \[m\], then ln(V0 theta/L).
pub struct Fault<'a> {
    elastic: Elastic<'a>,
    /// a of each point.
    a: Vec<f64>,
    /// Initial traction of each point, along the first axis \[Pa\].
    first: Vec<f64>,
    /// Damping coefficient \[Pa s/m\].
    damping: f64,
    /// Thresholds of an event \[m/s\].
    thresholds: [f64; 2],
}

/// An event.
pub struct SlipEvent {
    /// Onset \[s\].
    pub onset: f64,
    /// Slip of all points, along the first axis and then across it \[m\].
    pub slip: Vec<f64>,
    /// Times at which the fastest point rises above the rate of onset or falls below it, in turn \[s\].
    pub passed: Vec<f64>,
}

impl SlipEvent {
    /// Time during which the fastest point is above the rate of onset \[s\].
    pub fn above(&self) -> f64 {
        self.passed.as_chunks::<2>().0.iter().map(|[up, down]| down - up).sum()
    }
}

/// f at a, ln V and the state, and its derivative with respect to ln V.
fn friction(a: f64, log: f64, psi: f64) -> (f64, f64) {
    // Argument x of asinh from ln x, for large and small x.
    let x = (log - (2.0 * V0).ln() + (F0 + B * psi) / a).exp();
    (a * x.asinh(), a * x / x.hypot(1.0))
}

impl<'a> Fault<'a> {
    /// One point on a spring, driven at this angle from the initial slip \[rad\] and this rate \[m/s\], with the thresholds of a
    /// plan.
    pub fn slider(plan: &Plan, angle: f64, rate: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self::new(plan, Elastic::Spring([rate * cosine, rate * sine]), vec![A])
    }

    /// The points of a plan with its operator, loads and thresholds; `a` gives a of each point.
    pub fn from_plan(plan: &'a Plan, a: impl Fn(usize) -> f64) -> Self {
        let n = plan.points.len();
        let pull = plan.problem.loading.rates(1.0, n, false).0;
        Self::new(plan, Elastic::Body(plan.problem.fault.operator.as_ref(), pull), (0..n).map(a).collect())
    }

    fn new(plan: &Plan, elastic: Elastic<'a>, a: Vec<f64>) -> Self {
        let damping = 0.5 * (MODULUS * DENSITY).sqrt();
        // The steady state is V0 theta/L = V0/V.
        let first = |a: &f64| NORMAL * friction(*a, START.ln(), (V0 / STEADY).ln()).0 + damping * START;
        let thresholds = [plan.problem.settings.thresholds.on, plan.problem.settings.thresholds.off];
        Self { elastic, first: a.iter().map(first).collect(), a, damping, thresholds }
    }

    /// Tractions of all points, along the first axis and then across it \[Pa\].
    fn tractions(&self, time: f64, slip: &[f64]) -> Vec<f64> {
        let n = self.a.len();
        let mut tractions = vec![0.0; 2 * n];
        match &self.elastic {
            Elastic::Spring(drawn) => {
                for ((t, slip), drawn) in tractions.iter_mut().zip(slip).zip(drawn) {
                    *t = MODULUS / WIDE * (drawn * time - slip);
                }
            }
            Elastic::Body(operator, pull) => {
                tractions = operator.shear_of(slip);
                tractions.iter_mut().zip(pull).for_each(|(t, pull)| *t += pull * time);
            }
        }
        tractions.iter_mut().zip(&self.first).for_each(|(t, first)| *t += first);
        tractions
    }

    /// ln V of a point whose traction has this magnitude.
    fn log_rate(&self, point: usize, size: f64, psi: f64) -> f64 {
        // |t| - f_n f - eta V decreases with ln V: the root is bracketed, and a Newton step is taken where it stays within.
        let (mut low, mut high) = (-80.0, 5.0);
        let mut log = START.ln();
        for _ in 0..MOST {
            let (f, slope) = friction(self.a[point], log, psi);
            let off = size - NORMAL * f - self.damping * log.exp();
            if off > 0.0 {
                low = log
            } else {
                high = log
            }
            let step = off / (NORMAL * slope + self.damping * log.exp());
            let next = log + step;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - log).abs() <= 2.0 * f64::EPSILON * log.abs() {
                return next;
            }
            log = next;
        }
        log
    }

    /// The first `most` events.
    ///
    /// # Errors
    /// If there are fewer events.
    pub fn events(&self, most: usize) -> Result<Vec<SlipEvent>, CaseError> {
        let n = self.a.len();
        let options = Options {
            method: Method::Dop853,
            rtol: EXACT,
            // Absolute tolerances for slip of the size of L and a state of order one.
            atol: [vec![EXACT * L; 2 * n], vec![EXACT; n]].concat(),
            first_step: None,
            begin_stiff: false,
            largest_step: None,
            most_steps: 10_000_000,
        };
        let mut found = EventRecorder { most, points: n, open: None, events: Vec::new() };
        let start = [vec![0.0; 2 * n], vec![(V0 / STEADY).ln(); n]].concat();
        let end = 1e4 * crate::cases::seas::YEAR;
        let out = integrate(self, Clock::new(0.0, 0.0), &start, end, &options, &mut found);
        if out.outcome != Outcome::Stopped {
            return Err(
                format!("the reference found {} events: {:?}", found.events.len(), out.outcome).into()
            );
        }
        Ok(found.events)
    }
}

impl Problem for Fault<'_> {
    fn size(&self) -> usize {
        3 * self.a.len()
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        let n = self.a.len();
        let t = self.tractions(at.seconds(), &y[..2 * n]);
        for p in 0..n {
            let size = t[p].hypot(t[n + p]);
            let v = self.log_rate(p, size, y[2 * n + p]).exp();
            dy[p] = v * t[p] / size;
            dy[n + p] = v * t[n + p] / size;
            // theta' = 1 - V theta/L.
            dy[2 * n + p] = V0 / L * (-y[2 * n + p]).exp() - v / L;
        }
    }

    fn jacobian(&self, _at: Clock, _y: &[f64], jac: &mut [f64]) {
        jac.fill(f64::NAN);
    }

    fn events(&self) -> usize {
        2
    }

    fn event(&self, at: Clock, y: &[f64], g: &mut [f64]) {
        let n = self.a.len();
        let t = self.tractions(at.seconds(), &y[..2 * n]);
        let log = |p: usize| self.log_rate(p, t[p].hypot(t[n + p]), y[2 * n + p]);
        let fastest = (0..n).map(log).fold(f64::NEG_INFINITY, f64::max);
        g.iter_mut().zip(&self.thresholds).for_each(|(g, threshold)| *g = fastest - threshold.ln());
    }
}

struct EventRecorder {
    most: usize,
    points: usize,
    /// Slip at onset \[m\] of an event in progress, and the times at which it passed the rate of onset \[s\].
    open: Option<(Vec<f64>, Vec<f64>)>,
    events: Vec<SlipEvent>,
}

impl Sink for EventRecorder {
    fn accepted(&mut self, _: &Step<'_>) -> Control {
        Control::Go
    }

    fn occurred(&mut self, occurrence: &Occurrence) -> Control {
        let slip = occurrence.state[..2 * self.points].to_vec();
        let now = occurrence.at.seconds();
        match (occurrence.event, occurrence.rising, self.open.take()) {
            (0, true, None) => self.open = Some((slip, vec![now])),
            (0, _, Some((before, mut passed))) => {
                passed.push(now);
                self.open = Some((before, passed));
            }
            (1, false, Some((before, passed))) => {
                let onset = passed.first().copied().unwrap_or(f64::NAN);
                let slip = slip.iter().zip(before).map(|(s, b)| s - b).collect();
                self.events.push(SlipEvent { onset, slip, passed });
            }
            (_, _, open) => self.open = open,
        }
        if self.events.len() >= self.most { Control::Stop } else { Control::Go }
    }
}
