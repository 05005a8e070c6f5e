//! State of a run of bodies between two trials of a step.

use crate::report::{ForceResult, InterfaceResult, PointResult};
use crate::warning::Warning;
use asperity_mechanics::timing::StepLengthState;
use asperity_mechanics::{Counts, SystemState};
use asperity_output::view::StepRecord;
use serde::{Deserialize, Serialize};

/// See the module.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stand {
    /// Number of the stage, from 0.
    pub(super) stage: usize,
    pub(super) system: SystemState,
    pub(super) length: StepLengthState,
    /// Trials thrown away since the last accepted step.
    pub(super) rejected: usize,
    /// A motion that the first of them found free, in words.
    pub(super) free: Option<String>,
    pub(super) work: Work,
    pub(super) found: Found,
}

/// Work of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Work {
    pub counts: Counts,
    /// Rejected trials.
    pub rejected: usize,
    pub steps: Vec<StepRecord>,
}

/// Findings of a run in the stages it has completed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Found {
    pub results: Vec<InterfaceResult>,
    pub points: Vec<PointResult>,
    pub forces: Vec<ForceResult>,
    pub warnings: Vec<Said>,
}

/// A warning about a run as a whole, which has no place in the scene file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Said {
    message: String,
    help: Option<String>,
}

impl From<Warning> for Said {
    fn from(warning: Warning) -> Self {
        Self { message: warning.message, help: warning.help }
    }
}

impl From<Said> for Warning {
    fn from(said: Said) -> Self {
        Self { message: said.message, help: said.help, place: None, span: 0..0 }
    }
}

impl Stand {
    /// Accepted steps.
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
