//! The problem to integrate: faults in their surroundings, their loads, the start, and the settings.

use super::equations::Fault;
use super::error::RunError;
use super::loading::Loading;
use super::run::{self, Faults, Run, Settings};
use asperity_ode::Observer;

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
    ///
    /// # Errors
    /// If the observer cannot go on.
    pub fn run(&self, settings: &Settings, observer: &mut dyn Observer<Faults>) -> Result<Run, RunError> {
        run::run(&self.fault, &self.loading, self.start.clone(), settings, observer)
    }
}
