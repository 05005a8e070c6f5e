//! Input of a run, and names of the report and the lock file.

use super::inputs::Inputs;
use asperity_plan::shared::sha256::sha256;
use asperity_run::report::{Kind, Origin};
use jiff::Timestamp;
use std::fs;
use std::path::Path;

/// Name of the report file.
pub const REPORT: &str = "report.json";
/// Name of the file with the scene as it was run.
pub(super) const SCENE: &str = "scene.toml";
/// Name of the file that says what each file of a run is.
pub(super) const README: &str = "README.md";
/// Name of the page of a run for browsers.
pub const PAGE: &str = "report.html";
/// Name of the folder of figures.
pub const PLOTS: &str = "plots";
/// Name of the lock file; the lock is held while a run writes to the directory.
pub const LOCK: &str = ".lock";
/// Name of the file that keeps room for the report of the end.
pub(super) const RESERVE: &str = ".reserve";

/// Input of a run.
#[derive(Clone, Debug)]
pub(super) struct Begin {
    pub kind: Kind,
    pub title: String,
    /// The scene, with the values that `--set` gives, and its files.
    pub inputs: Inputs,
    /// SHA-256 of the text.
    pub hash: String,
    pub origin: Origin,
    /// True if the run resumes from the checkpoint in the directory.
    pub resume: bool,
    /// True if an unfinished run or the result of another scene may be moved away.
    pub force: bool,
}

impl Begin {
    /// Path of the scene file.
    pub fn scene(&self) -> &Path {
        Path::new(&self.origin.scene)
    }

    /// Input of a run of a scene file that was just read, with settings.
    pub fn now(kind: Kind, scene: &Path, title: &str, inputs: Inputs, set: Vec<String>) -> Self {
        let path = fs::canonicalize(scene).unwrap_or_else(|_| scene.to_path_buf());
        let origin = Origin { scene: path.display().to_string(), started: Timestamp::now().to_string(), set };
        let (title, hash) = (title.into(), sha256([&inputs.text]));
        Self { kind, title, inputs, hash, origin, resume: false, force: false }
    }
}
