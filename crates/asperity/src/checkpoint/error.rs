//! Reason why a run cannot be resumed.

use asperity_output::OutputError;
use std::path::PathBuf;

/// See the module.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The checkpoint cannot be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// Reason given by the system.
        source: std::io::Error,
    },
    /// The file is not a checkpoint, or its contents are not what was written.
    #[error("the checkpoint {path} is damaged: {reason}; run without --resume to begin again")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Description of the damage.
        reason: String,
    },
    /// The checkpoint belongs to another kind of run.
    #[error(
        "the checkpoint {path} is of a run of {found}, and the scene is of {scene}; choose another output directory, or run without --resume to begin again"
    )]
    Kind {
        /// The file.
        path: PathBuf,
        /// Kind of the run that wrote the checkpoint.
        found: String,
        /// Kind of the scene.
        scene: &'static str,
    },
    /// The checkpoint was written by another version of the program.
    #[error(
        "the checkpoint {path} has version {found}, and this program reads version {reads}; resume it with the program that wrote it, or run without --resume to begin again"
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// Version of the checkpoint.
        found: String,
        /// Version that this program reads.
        reads: &'static str,
    },
    /// The scene differs from the one that was run.
    #[error(
        "the checkpoint {path} is of another scene: the scene file, a value of --set or a mesh file has changed since in more than {allowed}; restore it, or run without --resume to begin again"
    )]
    Scene {
        /// The file.
        path: PathBuf,
        /// Parts of the scene that may change.
        allowed: &'static str,
    },
    /// The loads up to the checkpoint differ from those that were applied.
    #[error(
        "the checkpoint {path} is of other loads: with another duration of the last stage they are not what they were until {until:e} s; prescribe rates instead of values at its end, or run without --resume to begin again"
    )]
    Loads {
        /// The file.
        path: PathBuf,
        /// Time of the checkpoint \[s\].
        until: f64,
    },
    /// The run has advanced beyond the end that the scene now requests.
    #[error(
        "the checkpoint {path} lies beyond what the scene asks for: it is at {at:e} s with {events} events; ask for more, or run without --resume to begin again"
    )]
    Beyond {
        /// The file.
        path: PathBuf,
        /// Time of the checkpoint \[s\].
        at: f64,
        /// Number of events so far.
        events: usize,
    },
    /// An output file cannot be written, or has changed since the checkpoint.
    #[error(transparent)]
    Output(#[from] OutputError),
}
