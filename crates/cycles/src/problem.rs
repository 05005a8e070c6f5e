//! The problem to integrate: faults and their medium, loads, initial values, and settings.

use super::cycle::{Settings, run};
use super::equations::Fault;
use super::error::RunError;
use super::fault_run::FaultRun;
use super::loading::Loading;
use super::moment::Faults;
use asperity_ode::Observer;

/// Faults in their medium, with all that a run needs.
#[derive(Debug)]
pub struct Problem {
    /// Friction and the medium.
    pub fault: Fault,
    /// Tributary areas of the points \[m²; m per metre of thickness\].
    pub areas: Vec<f64>,
    /// Loads.
    pub loading: Loading,
    /// Initial unknowns.
    pub start: Vec<f64>,
    /// Settings of the integration.
    pub settings: Settings,
}

impl Problem {
    /// A run at its start, with one catalogue of all faults together.
    #[must_use]
    pub fn begin(&self) -> FaultRun {
        let points = 0..self.fault.law.points();
        FaultRun::new(self.start.clone(), std::slice::from_ref(&points), self.settings.thresholds)
    }

    /// Integrates the problem from its start, with its own settings or others. A failed integration is not an error; it
    /// is reported as the outcome.
    ///
    /// # Errors
    /// If the observer fails.
    pub fn run(
        &self,
        settings: &Settings,
        observer: &mut dyn Observer<Faults>,
    ) -> Result<FaultRun, RunError> {
        run(&self.fault, &self.loading, self.start.clone(), settings, observer)
    }
}
