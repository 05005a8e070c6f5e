//! Input of a run, and the names of the files that say so.

use crate::report::common::{Kind, Origin};
use jiff::Timestamp;
use std::fs;
use std::path::Path;

/// Name of the report.
pub(super) const REPORT: &str = "report.json";
/// File whose lock says that a run writes here.
pub(super) const LOCK: &str = ".lock";

/// Input of a run.
#[derive(Clone, Debug)]
pub(super) struct Begin {
    pub kind: Kind,
    pub title: String,
    /// SHA-256 of the scene file.
    pub hash: String,
    pub origin: Origin,
    /// True if to go on from a checkpoint there.
    pub resume: bool,
    /// True if an unfinished run or the result of another scene may be moved out of the way.
    pub force: bool,
}

impl Begin {
    /// Of a scene file that is read now.
    pub fn now(kind: Kind, scene: &Path, title: &str, hash: &str) -> Self {
        let path = fs::canonicalize(scene).unwrap_or_else(|_| scene.to_path_buf());
        let origin = Origin { scene: path.display().to_string(), started: Timestamp::now().to_string() };
        Self { kind, title: title.into(), hash: hash.into(), origin, resume: false, force: false }
    }
}
