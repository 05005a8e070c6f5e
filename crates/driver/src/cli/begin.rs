//! Input of a run, and names of the report and the lock file.

use crate::report::common::{Kind, Origin};
use jiff::Timestamp;
use std::fs;
use std::path::Path;

/// Name of the report file.
pub(super) const REPORT: &str = "report.json";
/// Name of the lock file; the lock is held while a run writes to the directory.
pub(super) const LOCK: &str = ".lock";

/// Input of a run.
#[derive(Clone, Debug)]
pub(super) struct Begin {
    pub kind: Kind,
    pub title: String,
    /// SHA-256 of the scene file.
    pub hash: String,
    pub origin: Origin,
    /// True if the run resumes from the checkpoint in the directory.
    pub resume: bool,
    /// True if an unfinished run or the result of another scene may be moved away.
    pub force: bool,
}

impl Begin {
    /// Input of a run of a scene file that was just read.
    pub fn now(kind: Kind, scene: &Path, title: &str, hash: &str) -> Self {
        let path = fs::canonicalize(scene).unwrap_or_else(|_| scene.to_path_buf());
        let origin = Origin { scene: path.display().to_string(), started: Timestamp::now().to_string() };
        Self { kind, title: title.into(), hash: hash.into(), origin, resume: false, force: false }
    }
}
