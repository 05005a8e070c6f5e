//! Settings of the integration of faults.

use asperity_ode::Method;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Slip rates that begin and end an event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Thresholds {
    /// Slip rate above which an event begins \[m/s\].
    pub on: f64,
    /// Slip rate below which it ends \[m/s\]. It is lower than `on`, so that an event is not counted twice.
    pub off: f64,
}

/// Settings of the integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Explicit method.
    pub method: Method,
    /// Error of ln V allowed per step.
    pub tolerance: f64,
    /// End of the run \[s\].
    pub end: f64,
    /// Slip rates at which events begin and end.
    pub thresholds: Thresholds,
    /// Slip rate at which a point has ruptured \[m/s\].
    pub rupture_rate: f64,
    /// Number of events after which the run ends.
    pub most_events: Option<usize>,
    /// Number of accepted steps after which the run gives up.
    pub most_steps: usize,
    /// Slip rate beyond which no state is meaningful and the run ends, that of shear waves in the rock \[m/s\].
    pub fastest: f64,
}
