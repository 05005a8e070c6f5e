//! No state: velocity-dependent friction.

use super::{Evolution, Evolved};

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stateless;

impl Evolution for Stateless {
    const STATES: usize = 0;
    const NAME: &'static str = "rate";

    fn phi(&self, _state: f64) -> f64 {
        0.0
    }

    fn steady(&self, _log_rate: f64) -> f64 {
        0.0
    }

    fn rate(&self, _state: f64, _log_rate: f64) -> f64 {
        0.0
    }

    fn step(&self, _state: f64, _log_rate: f64, _dt: f64) -> Evolved {
        Evolved { state: 0.0, d_phi: 0.0 }
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
