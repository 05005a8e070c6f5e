//! Part common to every `report.json`: its schema, the outcome, and the provenance.

use asperity_cycles::Energy;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Version of the form of `report.json`. It grows where a key changes its meaning or goes, not where one is added.
pub const SCHEMA: u32 = 1;

/// Command that was run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Bodies with interfaces, through stages.
    Bodies,
    /// Faults through cycles.
    Faults,
    /// Spring-sliders.
    Sliders,
}

/// End of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// At the end or after the events asked for.
    #[default]
    Completed,
    /// The run could not go on; everything before `time` stands.
    Stopped {
        /// Stage, where the scene has several.
        #[serde(skip_serializing_if = "Option::is_none")]
        stage: Option<String>,
        /// Time of the last good state \[s\].
        time: f64,
        /// Reason.
        reason: String,
        /// Kind of end.
        kind: Stop,
    },
    /// A signal or its wall time ended it; everything before `time` stands.
    Interrupted {
        /// Stage, where the scene has several.
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

    /// Reason why the run ended before its end, where it did.
    #[must_use]
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Completed => None,
            Self::Stopped { reason, .. } | Self::Interrupted { reason, .. } => Some(reason),
        }
    }
}

/// Reason why a run could not go on.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// No solution was found in steps of any length.
    NotConverged,
    /// The accuracy asked for needs steps below the smallest allowed.
    SmallestStep,
    /// The rates have no integral beyond this time, or not in so many steps.
    Integration,
    /// A point was about to slide where less than one point stands on the length over which a front of slip loses strength.
    UnderResolved {
        /// Interface.
        interface: String,
        /// The point \[m\].
        position: [f64; 3],
    },
    /// No quasi-static state follows the last one.
    Instability {
        /// Interface.
        interface: String,
        /// Point at which it was met \[m\].
        position: [f64; 3],
        /// Slip rate there in the state that was not accepted \[m/s\].
        slip_rate: f64,
    },
}

/// Status of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It goes on, or was killed.
    Running,
    /// It ended as asked.
    Completed,
    /// It could not go on.
    Stopped,
    /// A signal or its wall time ended it.
    Interrupted,
}

/// Input of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Origin {
    /// Path of the scene file.
    pub scene: String,
    /// Time at which it was begun, or resumed.
    pub started: String,
}

/// Wall time per phase \[s\]; what a kind of run does not tell apart belongs to its steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Phases {
    /// Reading, meshes, stiffness; of faults also the condensation.
    pub plan: f64,
    /// Condensation, pairing, factorisations of bodies.
    pub set_up: f64,
    /// Steps.
    pub steps: f64,
    /// Observers and recovery of fields.
    pub output: f64,
}

/// Facts that may differ from machine to machine and from run to run.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Provenance<'a> {
    /// Wall time; absent until the run has ended.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<Phases>,
    /// Threads.
    pub threads: usize,
    /// Commit of the program, "unknown" outside a checkout; with `-dirty` where its sources had changed since.
    pub commit: &'static str,
    /// Most memory the process had until then \[bytes\]; absent where the system does not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_bytes: Option<usize>,
    /// Input of the run.
    #[serde(flatten)]
    pub origin: &'a Origin,
}

/// A report as it is written.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Report<'a, P> {
    /// Version of its form.
    pub schema: u32,
    /// Command that was run.
    pub kind: Kind,
    /// Status of the run.
    pub status: Status,
    /// Title of the scene.
    pub title: &'a str,
    /// Version of the program.
    pub version: &'static str,
    /// SHA-256 of the scene file.
    pub scene_sha256: &'a str,
    /// SHA-256 of the mesh files it reads, by their names in the scene; absent until they are read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meshes_sha256: Option<&'a BTreeMap<String, String>>,
    /// Machine-dependent.
    pub run: Provenance<'a>,
    /// Part of its own kind.
    #[serde(flatten)]
    pub results: P,
}

/// Words about a run that has not ended, or ended without results.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Sketch {
    /// The error with which it ended; absent while it goes on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Part of the report of its own kind.
pub trait Results: Serialize {
    /// Its kind.
    const KIND: Kind;

    /// Outcome.
    fn outcome(&self) -> &Outcome;

    /// Wall time.
    fn seconds(&self) -> Phases;
}

/// Commit of the program, "unknown" outside a checkout.
pub(crate) fn commit() -> &'static str {
    option_env!("ASPERITY_COMMIT").unwrap_or("unknown")
}

/// Energy budget with its imbalance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct EnergyBalance {
    /// Energy budget \[J; J per metre of thickness in the plane; J/m² of spring-sliders\].
    #[serde(flatten)]
    pub parts: Energy,
    /// |loads + opening - elastic - friction - radiated - kinetic| over the largest of them \[-\].
    pub imbalance: f64,
}

impl From<Energy> for EnergyBalance {
    fn from(parts: Energy) -> Self {
        Self { parts, imbalance: parts.imbalance() }
    }
}
