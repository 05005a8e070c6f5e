//! No state: velocity-dependent friction.

use super::state::{Evolution, Rate, Speed, StateUpdate};

/// See the module. A law of this kind holds no component, so this evolution is never evaluated for a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stateless;

impl Evolution for Stateless {
    const STATES: usize = 0;
    const NAME: &'static str = "rate";
    type Start = ();

    fn phi(&self, _state: f64) -> f64 {
        0.0
    }

    fn phi_slopes(&self, _state: f64) -> (f64, f64) {
        (0.0, 0.0)
    }

    fn per_phi(&self) -> f64 {
        0.0
    }

    fn steady(&self, _log_rate: f64) -> f64 {
        0.0
    }

    fn rate(&self, _state: f64, _speed: Speed) -> Rate {
        Rate { rate: 0.0, d_log_rate: 0.0, d_state: 0.0 }
    }

    fn start(&self, _state: f64, _dt: f64) {}

    fn evolve(&self, _start: &(), _speed: Speed) -> StateUpdate {
        StateUpdate { state: 0.0, d_log_rate: 0.0, curvature: 0.0, d_state: 1.0 }
    }

    fn linear(&self, _state: f64, _log_rate: f64, _dt: f64) -> (f64, f64) {
        (0.0, 0.0)
    }

    fn weakening(&self, _state: f64, _log_rate: f64) -> f64 {
        0.0
    }

    fn length(&self) -> Option<f64> {
        None
    }
}
