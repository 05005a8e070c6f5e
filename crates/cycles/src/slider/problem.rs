//! The problem to integrate and its settings.

use super::rows::Rows;
use crate::problem::Thresholds;
use asperity_friction::slider::System;
use asperity_ode::{Method, Options};

/// Default method. In the cycles of the case `slider_work_precision` no other method needs significantly fewer
/// right-hand sides. Explicit methods alone need many times more where inertia or a soft spring makes the equations
/// stiff.
pub const DEFAULT_METHOD: Method = Method::Switching;

/// Default tolerance. In the work-precision case, event times have an error of about 1e-9 of the recurrence, smaller
/// than the uncertainty of any parameter, at a cost of a few milliseconds a cycle.
pub const DEFAULT_TOLERANCE: f64 = 1e-8;

/// Ratio of the relative to the absolute tolerance. The unknowns are logarithms and friction divided by a, whose
/// absolute changes matter; a relative part of this size admits the rounding of large unknowns.
const RELATIVE: f64 = 1e-3;

/// Speed of shear waves that no rock of the crust or the upper mantle exceeds \[m/s\]: 4.7 km/s at a depth of 200 km in PREM
/// (Dziewonski & Anderson 1981). A slider that is faster ends the run: no rock slips so, and sliders have no modulus and no density.
pub const ANY_ROCK: f64 = 5e3;

/// Default number of steps after which a run gives up: a thousand cycles of the hardest case.
pub const MOST_STEPS: usize = 20_000_000;

/// Number of accepted steps after which the integration restarts, and can be interrupted. Multistep methods lose about
/// twenty steps at a restart.
pub const RESTART: u64 = 4096;

/// Number of rows at intervals within a step that shortens steps to that many rows. The rows of a step are in memory until its end.
const ROWS_A_STEP: f64 = 1000.0;

/// The problem to integrate.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Title.
    pub title: String,
    /// Names of the sliders.
    pub names: Vec<String>,
    /// Sliders, springs and load.
    pub system: System,
    /// Unknowns at time 0.
    pub start: Vec<f64>,
    /// Method.
    pub method: Method,
    /// Error of ln V allowed in a step, and the equivalent error of each state \[-\].
    pub tolerance: f64,
    /// First step \[s\].
    pub first_step: Option<f64>,
    /// Largest step \[s\].
    pub largest_step: Option<f64>,
    /// Number of steps after which the run gives up.
    pub most_steps: usize,
    /// Slip rate beyond which the run ends \[m/s\], see [`ANY_ROCK`].
    pub fastest: f64,
    /// Number of accepted steps after which the integration restarts, and can be interrupted.
    pub restart: u64,
    /// End \[s\].
    pub end: f64,
    /// Thresholds of events, if events are detected.
    pub events: Option<Thresholds>,
    /// Number of events of the first slider after which the run stops.
    pub most_events: Option<usize>,
    /// True if extremes of the slip rate are found.
    pub peaks: bool,
    /// Rows to be written.
    pub output: Rows,
}

impl Problem {
    /// A problem with the defaults of a scene.
    #[must_use]
    pub fn new(system: System, start: Vec<f64>, end: f64) -> Self {
        Self {
            title: "spring-slider".into(),
            names: (1..=system.sliders().len()).map(|i| format!("slider {i}")).collect(),
            system,
            start,
            method: DEFAULT_METHOD,
            tolerance: DEFAULT_TOLERANCE,
            first_step: None,
            largest_step: None,
            most_steps: MOST_STEPS,
            fastest: ANY_ROCK,
            restart: RESTART,
            end,
            events: None,
            most_events: None,
            peaks: false,
            output: Rows::default(),
        }
    }

    /// Options of the integrator.
    #[must_use]
    pub fn options(&self) -> Options {
        Options {
            method: self.method,
            rtol: RELATIVE * self.tolerance,
            atol: self.system.scales().iter().map(|s| s * self.tolerance).collect(),
            first_step: self.first_step,
            begin_stiff: false,
            largest_step: self.resolved_step(),
            most_steps: self.most_steps,
        }
    }

    /// Largest step \[s\] with regard to the rows within it.
    fn resolved_step(&self) -> Option<f64> {
        let rows = self.output.interval.map(|interval| ROWS_A_STEP * interval);
        [self.largest_step, rows].into_iter().flatten().min_by(f64::total_cmp)
    }

    /// Description of the dynamics.
    #[must_use]
    pub fn dynamics(&self) -> &'static str {
        let sliders = self.system.sliders();
        if sliders.iter().any(|s| s.mass.is_some()) {
            "inertial"
        } else if sliders.iter().any(|s| s.damping > 0.0) {
            "quasi-static with radiation damping"
        } else {
            "quasi-static"
        }
    }
}
