//! What is integrated: faults in their surroundings, what loads them, where they start, and how.

use super::equations::Fault;
use super::loading::Loading;
use super::run::{self, Run, Settings, Watcher};

/// See the module.
#[derive(Debug)]
pub struct Problem {
    /// Friction and bodies.
    pub fault: Fault,
    /// Tributary areas of the points \[m²; m per metre of thickness\].
    pub areas: Vec<f64>,
    /// Loads.
    pub loading: Loading,
    /// Unknowns at the start.
    pub start: Vec<f64>,
    /// Integration.
    pub settings: Settings,
}

impl Problem {
    /// Integrates it from its start, with its own settings or others. An integration that fails is no error: the outcome says so.
    pub fn run(&self, settings: &Settings, watcher: &mut dyn Watcher) -> Run {
        run::run(&self.fault, &self.loading, self.start.clone(), settings, watcher)
    }
}
