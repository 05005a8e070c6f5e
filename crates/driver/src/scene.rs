//! The scene language with the friction laws that this program knows.

pub use asperity_scene::{Entry, check, law, model, names, near, slider, units};

use crate::diagnostic::Diagnostics;
use crate::laws;
use model::Scene;
use std::path::Path;

/// Reads and checks a scene; paths of mesh files in it are relative to the present folder.
///
/// # Errors
/// All that is wrong with it, or the first thing that keeps it from being read.
pub fn read(text: &str) -> Result<Scene, Diagnostics> {
    read_in(text, Path::new(""))
}

/// Reads and checks a scene whose mesh files are named relative to `folder`.
///
/// # Errors
/// See [`read`].
pub fn read_in(text: &str, folder: &Path) -> Result<Scene, Diagnostics> {
    asperity_scene::read(text, folder, laws::known())
}
