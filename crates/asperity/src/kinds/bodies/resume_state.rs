//! State of a run of bodies between two trials of steps.

use super::events::Events;
use super::report::InterfaceResult;
use crate::kinds::worst::Worst;
use crate::report::{ForceResult, PointResult, SpringResult};
use asperity_mechanics::SystemState;
use asperity_mechanics::timing::StepLengthState;
use asperity_output::bodies::view::StepRecord;
use asperity_run::{Closure, Operations, Warning};
use serde::{Deserialize, Serialize};

/// State of a run of bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResumeState {
    /// Number of the stage, from 0.
    pub(super) stage: usize,
    pub(super) system: SystemState,
    pub(super) length: StepLengthState,
    /// Number of rejected trials since the last accepted step.
    pub(super) rejected: usize,
    /// Description of an unrestrained motion found in the first of these trials.
    pub(super) free: Option<String>,
    pub(super) work: Work,
    pub(super) found: StageResults,
    /// Events of interfaces, if the scene asks for them.
    pub(super) events: Option<Events>,
}

/// Work of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Work {
    pub counts: Operations,
    /// Rejected trials.
    pub rejected: usize,
    pub steps: Vec<StepRecord>,
    /// Closure of the energy budget.
    #[serde(default)]
    pub energy: Closure,
}

/// Results of the completed stages.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct StageResults {
    pub results: Vec<InterfaceResult>,
    pub points: Vec<PointResult>,
    pub forces: Vec<ForceResult>,
    pub springs: Vec<SpringResult>,
    pub warnings: Vec<RunWarning>,
    /// The worst states of the stage that runs.
    #[serde(default)]
    pub worst: Worst,
}

/// A warning about a run as a whole, without position in the scene file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct RunWarning {
    message: String,
    help: Option<String>,
}

impl From<Warning> for RunWarning {
    fn from(warning: Warning) -> Self {
        Self { message: warning.message, help: warning.help }
    }
}

impl From<RunWarning> for Warning {
    fn from(said: RunWarning) -> Self {
        Self { message: said.message, help: said.help, place: None, span: 0..0 }
    }
}

impl ResumeState {
    /// Number of accepted steps.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.work.steps.len()
    }

    /// Time \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.system.time()
    }
}
