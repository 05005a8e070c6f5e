//! The scene language with the friction laws of this program.

pub use asperity_scene::{Entry, check, keys, law, model, names, near, settings, slider, units};

use crate::diagnostic::Diagnostics;
use crate::laws;
use model::Scene;
use std::path::Path;

/// Reads and checks a scene; paths of mesh files are relative to the current folder.
///
/// # Errors
/// All errors of the scene, or the first one that prevents reading it.
pub fn read(text: &str) -> Result<Scene, Diagnostics> {
    read_in(text, Path::new(""))
}

/// Reads and checks a scene whose mesh files are relative to `folder`.
///
/// # Errors
/// See [`read`].
pub fn read_in(text: &str, folder: &Path) -> Result<Scene, Diagnostics> {
    asperity_scene::read(text, folder, laws::known())
}
