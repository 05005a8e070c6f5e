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
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file is no checkpoint, or not what was written.
    #[error("the checkpoint {path} is damaged: {reason}; run without --resume to begin again")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// The checkpoint of another kind of run.
    #[error(
        "the checkpoint {path} is of a run of {found}, and the scene is of {scene}; choose another output directory, or run without --resume to begin again"
    )]
    Kind {
        /// The file.
        path: PathBuf,
        /// Command that was run.
        found: String,
        /// Value of the scene.
        scene: &'static str,
    },
    /// Written by another version of the program.
    #[error(
        "the checkpoint {path} has version {found}, and this program reads version {reads}; resume it with the program that wrote it, or run without --resume to begin again"
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: String,
        /// The version that this program reads.
        reads: &'static str,
    },
    /// The scene is not the one that was run.
    #[error(
        "the checkpoint {path} is of another scene: the scene file or a mesh file has changed since in more than {allowed}; restore it, or run without --resume to begin again"
    )]
    Scene {
        /// The file.
        path: PathBuf,
        /// Allowed changes.
        allowed: &'static str,
    },
    /// The loads until then are not those that acted.
    #[error(
        "the checkpoint {path} is of other loads: with another duration of the last stage they are not what they were until {until:e} s; prescribe rates instead of values at its end, or run without --resume to begin again"
    )]
    Loads {
        /// The file.
        path: PathBuf,
        /// Time reached \[s\].
        until: f64,
    },
    /// The run has got farther than the scene now asks for.
    #[error(
        "the checkpoint {path} lies beyond what the scene asks for: it is at {at:e} s with {events} events; ask for more, or run without --resume to begin again"
    )]
    Beyond {
        /// The file.
        path: PathBuf,
        /// Its time \[s\].
        at: f64,
        /// Its events.
        events: usize,
    },
    /// An output file cannot be written, or is not as it was at the checkpoint.
    #[error(transparent)]
    Output(#[from] OutputError),
}
