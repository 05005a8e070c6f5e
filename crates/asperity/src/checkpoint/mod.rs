//! Checkpoint of a run: one file with everything needed to resume it.
//!
//! ```text
//! asperity checkpoint of faults, version 2
//! <SHA-256 of the rest>
//! <JSON>
//! ```
//!
//! Numbers in the JSON have the fewest decimals that read back to the same value. A new checkpoint is written to the disc under a temporary name and
//! then replaces the previous one.

mod error;
mod pauses;
pub mod scene;

pub use error::ResumeError;
pub use pauses::Pauses;

use asperity_output::{OutputError, atomic};
use asperity_plan::shared::sha256::sha256;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Name of the file in the output directory.
pub const FILE: &str = "checkpoint";

/// Beginning of the first line of every checkpoint.
const KIND: &str = "asperity checkpoint of ";

/// State of a run of one kind, as its checkpoints have it.
pub trait SavedState: Serialize + DeserializeOwned {
    /// Kind of run, in the plural.
    const OF: &'static str;
    /// Version of the contents.
    const VERSION: &'static str;
    /// Parts of a scene that may change when a run is resumed.
    const ALLOWED: &'static str = "its title and its layout";
}

/// Contents of the file.
#[derive(Serialize, Deserialize)]
struct Contents<S> {
    /// Hash of everything that must not change when a run is resumed.
    physics: String,
    state: S,
}

/// Writes a checkpoint of a scene with this hash of its physics into `out`.
///
/// # Errors
/// If the file cannot be written.
pub fn write<S: SavedState>(out: &Path, physics: &str, state: &S) -> Result<(), OutputError> {
    let path = out.join(FILE);
    let contents = Contents { physics: physics.into(), state };
    let contents = serde_json::to_string(&contents).map_err(|e| OutputError::write(&path, e.into()))?;
    let (of, version, sum) = (S::OF, S::VERSION, sha256([&contents]));
    let text = format!("{KIND}{of}, version {version}\n{sum}\n{contents}\n");
    atomic::write_durably(&path, text.as_bytes())
}

/// Reads the checkpoint of `out`; `None` if there is none.
///
/// # Errors
/// If it is damaged, has another version, or belongs to a scene whose hash is not `physics`.
pub fn read<S: SavedState>(out: &Path, physics: &str) -> Result<Option<S>, ResumeError> {
    let path = out.join(FILE);
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(ResumeError::Read { path, source }),
    };
    parse(bytes, &path, physics).map(Some)
}

/// State in a checkpoint whose file has these bytes; `path` names it in errors.
///
/// # Errors
/// See [`read`].
pub fn parse<S: SavedState>(bytes: Vec<u8>, path: &Path, physics: &str) -> Result<S, ResumeError> {
    let path = path.to_path_buf();
    let damaged = |reason: &str| ResumeError::Damaged { path: path.clone(), reason: reason.into() };
    let text = String::from_utf8(bytes).map_err(|_| damaged("it is no text"))?;
    let mut lines = text.splitn(3, '\n');
    let kind = lines.next().and_then(|line| line.strip_prefix(KIND));
    let (of, version) = kind
        .and_then(|kind| kind.split_once(", version "))
        .ok_or_else(|| damaged("its first line is that of no checkpoint"))?;
    if of != S::OF {
        return Err(ResumeError::Kind { path, found: of.into(), scene: S::OF });
    }
    if version != S::VERSION {
        return Err(ResumeError::Version { path, found: version.into(), reads: S::VERSION });
    }
    let sum = lines.next().unwrap_or_default();
    let contents = lines.next().and_then(|rest| rest.strip_suffix('\n')).unwrap_or_default();
    if sha256([contents]) != sum {
        return Err(damaged("its contents do not have the sum written beside them"));
    }
    let read: Contents<S> = serde_json::from_str(contents).map_err(|e| damaged(&e.to_string()))?;
    if read.physics != physics {
        return Err(ResumeError::Scene { path, allowed: S::ALLOWED });
    }
    Ok(read.state)
}

/// Error for contents that do not fit the run.
pub fn foreign(out: &Path, reason: &str) -> ResumeError {
    ResumeError::Damaged { path: out.join(FILE), reason: reason.into() }
}

/// Error for a checkpoint of a run with other output files.
pub fn other_files(out: &Path) -> ResumeError {
    foreign(out, "its list of output files differs from that of this scene")
}

/// Removes the checkpoint of an earlier run from `out`.
///
/// # Errors
/// If there is one that cannot be removed.
pub fn remove(out: &Path) -> Result<(), OutputError> {
    let path = out.join(FILE);
    match fs::remove_file(&path) {
        Err(e) if e.kind() != ErrorKind::NotFound => Err(OutputError::write(&path, e)),
        _ => Ok(()),
    }
}
