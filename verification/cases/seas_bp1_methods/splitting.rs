//! A splitting for comparison: states advance exactly at a mean slip rate, m and slip by Heun's method.
//!
//! A step first uses the slip rate at its start, then the mean of those at both ends, as codes for spectral and
//! boundary elements do. The difference of the two is the error estimate.

use super::{ABOVE, EVENTS, Setting};
use crate::cases::seas::YEAR;
use asperity_cycles::Equations;
use asperity_ode::{Clock, Problem};
use asperity_plan::faults::Plan;
use std::time::Instant;

/// Vref and L of BP1 \[m/s\], \[m\].
const V_REF: f64 = 1e-6;
const LENGTH: f64 = 8e-3;
/// Safety factor on the optimal step, and the strongest reduction of a step.
const SAFETY: f64 = 0.9;
const SHRINK: f64 = 0.2;
const GROWTH: f64 = 3.0;
/// Steps after which a setting has failed.
const MOST_STEPS: u64 = 400_000;

/// State s after `dt` at a constant slip rate: `θ exp(-x) + L/V (1 - exp(-x))` with `x = V dt/L`, θ = L/Vref exp(s).
fn aged(state: f64, rate: f64, dt: f64) -> f64 {
    let (rate, x) = (rate.abs(), rate.abs() * dt / LENGTH);
    let gained = if x > 0.0 { V_REF / rate * -(-x).exp_m1() } else { V_REF * dt / LENGTH };
    (state.exp() * (-x).exp() + gained).ln()
}

/// A step by the splitting: slip and m by Heun's method, the states by the exact solution at a constant slip rate.
struct Step<'a, 'b> {
    equations: &'a Equations<'b>,
    /// State and its rates at the start.
    y: Vec<f64>,
    f: Vec<f64>,
    /// Ends of first and of second order.
    first: Vec<f64>,
    second: Vec<f64>,
    /// Rates at an end.
    g: Vec<f64>,
}

impl<'a, 'b> Step<'a, 'b> {
    fn new(equations: &'a Equations<'b>, start: &[f64]) -> Self {
        let zeros = || vec![0.0; start.len()];
        let mut f = zeros();
        equations.rates(at(), start, &mut f);
        Self { equations, y: start.to_vec(), f, first: zeros(), second: zeros(), g: zeros() }
    }

    /// Computes both ends of a step of length `dt`.
    fn advance(&mut self, dt: f64) {
        let layout = self.equations.layout();
        let (m, states, slip) = (layout.m(), layout.states(), layout.slip());
        let Self { equations, y, f, first, second, g } = self;
        for k in m.clone().chain(slip.clone()) {
            first[k] = y[k] + dt * f[k];
        }
        for p in 0..slip.len() {
            first[states.start + p] = aged(y[states.start + p], f[slip.start + p], dt);
        }
        equations.rates(at(), first, g);
        for k in m.chain(slip.clone()) {
            second[k] = y[k] + 0.5 * dt * (f[k] + g[k]);
        }
        for p in 0..slip.len() {
            let mean = 0.5 * (f[slip.start + p] + g[slip.start + p]);
            second[states.start + p] = aged(y[states.start + p], mean, dt);
        }
    }

    /// Root of the mean square of the differences of both ends, over tolerances.
    fn error(&self, scale: &[f64]) -> f64 {
        let off = self.first.iter().zip(&self.second).zip(scale).map(|((a, b), s)| ((a - b) / s).powi(2));
        (off.sum::<f64>() / self.y.len() as f64).sqrt()
    }

    /// Makes the end of second order the start of the next step. Returns the largest slip rate there \[m/s\].
    fn accept(&mut self) -> f64 {
        self.equations.rates(at(), &self.second, &mut self.g);
        std::mem::swap(&mut self.y, &mut self.second);
        std::mem::swap(&mut self.f, &mut self.g);
        self.f[self.equations.layout().slip()].iter().fold(0.0_f64, |l, v| l.max(v.abs()))
    }
}

/// Time at which the equations are evaluated, on which they do not depend.
fn at() -> Clock {
    Clock::new(0.0, 0.0)
}

/// Events of a run.
struct Events {
    found: Setting,
    /// Largest slip rate at the end of the last step \[m/s\].
    before: f64,
    /// True during an event.
    during: bool,
    /// Number of events that have ended.
    ended: usize,
}

impl Events {
    /// Notes the largest slip rate at the end of a step of length `dt` from `t`.
    fn see(&mut self, t: f64, dt: f64, largest: f64) {
        // ln V is nearly linear within a step.
        let share = |threshold: f64| (threshold / self.before).ln() / (largest / self.before).ln();
        if self.during && self.ended + 1 == EVENTS {
            self.found.peak = self.found.peak.max(largest);
        }
        if !self.during && largest >= ABOVE {
            self.found.onsets.push((t + dt * share(ABOVE)) / YEAR);
            self.during = true;
        } else if self.during && largest < ABOVE {
            self.during = false;
            self.ended += 1;
        }
        self.before = largest;
    }
}

/// Runs BP1 by this splitting to the end of the last event.
pub(super) fn setting(plan: &Plan, tolerance: f64) -> Result<Setting, String> {
    let clock = Instant::now();
    let (shear, normal) = plan.problem.loading.rates(1.0, plan.points.len(), false);
    let equations = Equations::new(&plan.problem.fault, shear, normal);
    let scale = equations.tolerances(tolerance);
    let mut step = Step::new(&equations, &plan.problem.start);
    let found =
        Setting { tolerance, onsets: Vec::new(), peak: 0.0, wall: 0.0, steps: 0, rejected: 0, rates: 1 };
    let mut events = Events { found, before: 0.0, during: false, ended: 0 };
    // The first step of 1 s is far below any time scale of the solution.
    let (mut t, mut dt) = (0.0, 1.0);
    while events.ended < EVENTS {
        if events.found.steps + events.found.rejected > MOST_STEPS {
            return Err(format!("not at the end in {MOST_STEPS} steps, {:.1} yr", t / YEAR));
        }
        step.advance(dt);
        events.found.rates += 1;
        let error = step.error(&scale);
        let share = (SAFETY / error.max(f64::MIN_POSITIVE).sqrt()).clamp(SHRINK, GROWTH);
        if error <= 1.0 {
            let largest = step.accept();
            events.found.rates += 1;
            events.found.steps += 1;
            events.see(t, dt, largest);
            t += dt;
            dt *= share;
        } else {
            events.found.rejected += 1;
            dt *= if error.is_finite() { share } else { SHRINK };
        }
    }
    events.found.wall = clock.elapsed().as_secs_f64();
    Ok(events.found)
}
