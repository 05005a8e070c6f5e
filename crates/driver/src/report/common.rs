//! Part common to every `report.json`: version, outcome and provenance.

use crate::setup::Kept;
use crate::warning::Warning;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Version of the format of `report.json`. It increases if a key is removed or changes its meaning, not if one is
/// added.
pub const SCHEMA: u32 = 2;

/// Kind of run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Bodies with interfaces, in stages.
    Bodies,
    /// Faults over earthquake cycles.
    Faults,
    /// Spring-sliders.
    Sliders,
    /// Bodies with mass, whose faults radiate waves.
    Dynamics,
}

/// End of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The run reached its end, or the requested number of events.
    #[default]
    Completed,
    /// The run could not continue; everything before `time` is valid.
    Stopped {
        /// Stage, if the scene has several.
        #[serde(skip_serializing_if = "Option::is_none")]
        stage: Option<String>,
        /// Time of the last valid state \[s\].
        time: f64,
        /// Reason.
        reason: String,
        /// Kind of failure.
        kind: Stop,
    },
    /// A signal or the limit of wall time ended the run; everything before `time` is valid.
    Interrupted {
        /// Stage, if the scene has several.
        #[serde(skip_serializing_if = "Option::is_none")]
        stage: Option<String>,
        /// Time of the last state \[s\].
        time: f64,
        /// Reason.
        reason: String,
    },
}

impl Outcome {
    /// Status of the run.
    #[must_use]
    pub fn status(&self) -> Status {
        match self {
            Self::Completed => Status::Completed,
            Self::Stopped { .. } => Status::Stopped,
            Self::Interrupted { .. } => Status::Interrupted,
        }
    }

    /// Reason why the run ended early, if it did.
    #[must_use]
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Completed => None,
            Self::Stopped { reason, .. } | Self::Interrupted { reason, .. } => Some(reason),
        }
    }
}

/// Reason why a run could not continue.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// No solution was found with steps of any length.
    NotConverged,
    /// The requested accuracy needs steps below the smallest allowed.
    SmallestStep,
    /// Bodies with mass hold more energy than was put in: the steps are unstable.
    EnergyGrowth,
    /// The rates cannot be integrated beyond this time, or not within the allowed number of steps.
    Integration,
    /// A point slipped faster than shear waves in the next state, which was not kept.
    Outrun {
        /// Fault, interface or slider.
        surface: String,
        /// Position of the point \[m\]; zeros for a slider.
        position: [f64; 3],
        /// Slip rate there in the state that was not kept \[m/s\].
        slip_rate: f64,
    },
    /// A point was about to slide where the length over which a slip front loses strength holds less than one point.
    UnderResolved {
        /// Interface.
        interface: String,
        /// Position of the point \[m\].
        position: [f64; 3],
    },
    /// There is no quasi-static state after the last one.
    Instability {
        /// Interface.
        interface: String,
        /// Position of the point at which the instability was detected \[m\].
        position: [f64; 3],
        /// Slip rate there in the rejected state \[m/s\].
        slip_rate: f64,
    },
}

/// Status of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// The run is in progress, or was killed.
    Running,
    /// The run ended as requested.
    Completed,
    /// The run could not continue.
    Stopped,
    /// A signal or the limit of wall time ended the run.
    Interrupted,
}

/// Input of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Origin {
    /// Path of the scene file.
    pub scene: String,
    /// Time at which the run was begun or resumed.
    pub started: String,
    /// Values given by `--set`, in their order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<String>,
}

/// Wall time per phase \[s\]. Phases that a kind of run does not separate are included in its steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Phases {
    /// Reading, meshes and stiffness; with faults, also the condensation.
    pub plan: f64,
    /// Condensation, pairing and factorisations of bodies.
    pub set_up: f64,
    /// Steps.
    pub steps: f64,
    /// Files and figures after the last step; with bodies, also observers and recovery of fields.
    pub output: f64,
}

/// Facts that may differ between machines and between runs.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Provenance<'a> {
    /// Wall time; absent until the run has ended.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<Phases>,
    /// Number of threads.
    pub threads: usize,
    /// Commit of the program, "unknown" outside a checkout; with the suffix `-dirty` if its sources had been modified.
    pub commit: &'static str,
    /// Peak memory of the process \[bytes\]; absent if the system does not report it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_bytes: Option<usize>,
    /// Parts of the set-up that were read from the output directory, or kept there; absent if there are none.
    #[serde(skip_serializing_if = "<[Kept]>::is_empty")]
    pub setup: &'a [Kept],
    /// Input of the run.
    #[serde(flatten)]
    pub origin: &'a Origin,
}

/// A report as written to its file.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Report<'a, P> {
    /// Version of the format.
    pub schema: u32,
    /// Kind of run.
    pub kind: Kind,
    /// Status of the run.
    pub status: Status,
    /// Title of the scene.
    pub title: &'a str,
    /// Version of the program.
    pub version: &'static str,
    /// SHA-256 of the scene as it was run, in `scene.toml`: that of the scene file, unless `--set` changed values.
    pub scene_sha256: &'a str,
    /// SHA-256 of the mesh files, by their names in the scene; absent until they are read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meshes_sha256: Option<&'a BTreeMap<String, String>>,
    /// Machine-dependent part.
    pub run: Provenance<'a>,
    /// Part that depends on the kind of run.
    #[serde(flatten)]
    pub results: P,
}

/// Report of a run that has not ended, or that ended without results.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Sketch {
    /// Error with which the run ended; absent while it is in progress.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Part of a report that depends on the kind of run.
pub trait Results: Serialize {
    /// Kind of run.
    const KIND: Kind;

    /// Outcome.
    fn outcome(&self) -> &Outcome;

    /// Warnings of the plan, and of what the run has found.
    fn warnings(&self) -> &[Warning];

    /// Accepted steps.
    fn steps(&self) -> u64;

    /// Wall time.
    fn seconds(&self) -> Phases;

    /// Wall time, to be completed.
    fn seconds_mut(&mut self) -> &mut Phases;

    /// Summary to be read at the end of the run.
    fn text(&self) -> String;
}

/// Implements what reports of all kinds have in fields of the same names.
macro_rules! results {
    ($report:ty, $kind:expr) => {
        impl $crate::report::Results for $report {
            const KIND: $crate::report::Kind = $kind;

            fn outcome(&self) -> &$crate::report::Outcome {
                &self.outcome
            }

            fn warnings(&self) -> &[$crate::warning::Warning] {
                &self.warnings
            }

            fn steps(&self) -> u64 {
                self.counts.steps as u64
            }

            fn seconds(&self) -> $crate::report::Phases {
                self.seconds
            }

            fn seconds_mut(&mut self) -> &mut $crate::report::Phases {
                &mut self.seconds
            }

            fn text(&self) -> String {
                self.text()
            }
        }
    };
}

pub(crate) use results;

/// Commit of the program, "unknown" outside a checkout.
pub(crate) fn commit() -> &'static str {
    option_env!("ASPERITY_COMMIT").unwrap_or("unknown")
}

/// Work as operation counts, which do not depend on the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Work {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Points of faults.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// Cells of bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<usize>,
    /// Evaluations of the right-hand side; with faults, each applies the operator once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_hand_sides: Option<u64>,
    /// Evaluations of the Jacobian.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jacobians: Option<u64>,
    /// Factorisations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factorisations: Option<u64>,
    /// Solutions with these factorisations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solves: Option<u64>,
    /// Restarts after events.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restarts: Option<u64>,
}
