//! The problem to integrate and its settings.

use super::rows::Rows;
use crate::catalogue::Thresholds;
use asperity_friction::slider::System;
use asperity_ode::{Method, Options};

/// Method of scenes that name none: in the cycles of the case `slider_work_precision` no other needs fewer right-hand sides by
/// more than what the case can tell, and explicit methods alone need many times more where inertia or a soft spring makes the
/// equations stiff.
pub const DEFAULT_METHOD: Method = Method::Switching;

/// Tolerance of scenes that give none: in the work-precision case it leaves event times with an error of some 1e-9 of the
/// recurrence, below what any parameter is known to, for a few milliseconds a cycle.
pub const DEFAULT_TOLERANCE: f64 = 1e-8;

/// Share of the absolute tolerance the relative one is: the unknowns are logarithms and friction over a, of which absolute
/// changes matter; a relative part of that size lets rounding of large unknowns pass.
const RELATIVE: f64 = 1e-3;

/// Steps after which a run is given up, where the scene says nothing: a thousand cycles of the hardest case.
pub const MOST_STEPS: usize = 20_000_000;

/// Accepted steps after which the integration restarts, which is where it can be interrupted. Methods with a memory lose some twenty steps
/// by that.
pub const RESTART: u64 = 4096;

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
    /// Error allowed in ln V, and in what is worth as much of each state, per step \[-\].
    pub tolerance: f64,
    /// First step \[s\].
    pub first_step: Option<f64>,
    /// Largest step \[s\].
    pub largest_step: Option<f64>,
    /// Steps after which to give up.
    pub most_steps: usize,
    /// Accepted steps after which the integration restarts, which is where it can be interrupted.
    pub restart: u64,
    /// End \[s\].
    pub end: f64,
    /// Events, where they are wanted.
    pub events: Option<Thresholds>,
    /// Events of the first slider after which to stop.
    pub most_events: Option<usize>,
    /// True if extremes of the slip rate are found.
    pub peaks: bool,
    /// Which rows are written.
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
            largest_step: self.largest_step,
            most_steps: self.most_steps,
        }
    }

    /// Dynamics in words.
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
