//! Scenes: read from a file, checked as a whole, handed on as a value.

pub mod check;
pub mod diagnostic;
mod entry;
mod exact;
mod explain;
pub mod law;
pub mod model;
mod motion;
pub mod near;
pub mod slider;
mod title;
pub mod units;

pub use entry::Entry;

use crate::plan::PlanError;
use model::Scene;
use std::fmt;
use std::ops::Range;
use std::path::Path;

/// Something wrong in a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct SceneError {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
    /// Bytes of the scene file it is about; empty when there is no file.
    pub span: Range<usize>,
    /// Other places that take part in it, each with a few words.
    pub also: Vec<(Range<usize>, String)>,
}

impl SceneError {
    /// An error with a place and a remedy.
    #[must_use]
    pub fn at(span: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), span, also: Vec::new() }
    }

    /// The same error, pointing to another place as well.
    #[must_use]
    pub fn and(mut self, span: Range<usize>, words: impl Into<String>) -> Self {
        self.also.push((span, words.into()));
        self
    }
}

/// Everything wrong in a scene, in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneErrors(pub Vec<SceneError>);

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            f.write_str(&error.message)?;
            if let Some(help) = &error.help {
                write!(f, " ({help})")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for SceneErrors {}

impl From<PlanError> for SceneErrors {
    fn from(e: PlanError) -> Self {
        Self(vec![SceneError { message: e.message, help: e.help, span: e.span, also: Vec::new() }])
    }
}

impl From<SceneError> for PlanError {
    fn from(e: SceneError) -> Self {
        Self { message: e.message, help: e.help, span: e.span }
    }
}

/// Reads and checks a scene; paths of mesh files in it are relative to the present folder.
///
/// # Errors
/// All that is wrong with it, or the first thing that keeps it from being read.
pub fn read(text: &str) -> Result<Scene, SceneErrors> {
    read_in(text, Path::new(""))
}

/// Reads and checks a scene whose mesh files are named relative to `folder`.
///
/// # Errors
/// See [`read`].
pub fn read_in(text: &str, folder: &Path) -> Result<Scene, SceneErrors> {
    let mut scene: Scene = toml::from_str(text).map_err(|e| SceneErrors(vec![explain::explain(&e, text)]))?;
    scene.folder = folder.to_path_buf();
    let (errors, warnings) = check::check(&scene);
    scene.warnings = warnings;
    if errors.is_empty() { Ok(scene) } else { Err(SceneErrors(errors)) }
}
