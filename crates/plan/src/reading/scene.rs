//! The scene language with the friction laws of this program.

pub use asperity_scene::{
    Entry, check, control_characters, files, keys, kind, law, model, names, plausibility, reader, settings,
    slider, suggestions, units,
};

use crate::reading::columns::file::columns_of;
use crate::reading::diagnostic::Diagnostics;
use asperity_laws as laws;
use model::{Scene, Spanned};
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
    let mut columns = |file: &Spanned<String>, wanted: &[files::Column<'_>]| columns_of(folder, file, wanted);
    asperity_scene::read(text, folder, laws::known(), &mut columns)
}
