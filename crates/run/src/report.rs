//! Part common to every `report.json`: version, outcome and provenance.

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
    #[serde(skip_serializing_if = "<[SetupPart]>::is_empty")]
    pub setup: &'a [SetupPart],
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

/// A part of a set-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// Tractions that slip and loads cause.
    Operator,
    /// Bodies that a stage before has pressed.
    Pressing,
}

impl Part {
    /// Name of its file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Operator => "operator",
            Self::Pressing => "pressing",
        }
    }
}

/// Use of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Use {
    /// The part was read instead of computed.
    Read,
    /// The part was computed and written.
    Written,
}

/// A part of a set-up that was read or written.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SetupPart {
    /// The part.
    pub part: Part,
    /// Its file in the output directory.
    pub file: String,
    /// Use of the file.
    #[serde(rename = "use")]
    pub how: Use,
    /// SHA-256 of what the part depends on.
    pub inputs_sha256: String,
    /// Size of the file \[bytes\].
    pub bytes: u64,
    /// Wall time that computing the part took, in this run or the one that wrote the file \[s\].
    pub seconds: f64,
}

impl std::fmt::Display for SetupPart {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { part, file, how, inputs_sha256, bytes, seconds } = self;
        let (name, size) = (part.name(), *bytes as f64 / 1e6);
        let inputs = inputs_sha256.get(..12).unwrap_or_default();
        match how {
            Use::Read => {
                write!(f, "{name} read from `{file}`, {size:.1} MB, instead of computed in {seconds:.1} s")
            }
            Use::Written => {
                write!(f, "{name} computed in {seconds:.1} s and kept in `{file}`, {size:.1} MB")
            }
        }?;
        write!(f, " (inputs {inputs})")
    }
}
