#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod azimuth;
pub mod check;
pub mod diagnostic;
mod entry;
mod exact;
mod explain;
pub mod files;
mod here;
pub mod keys;
pub mod law;
pub mod lengths;
pub mod model;
mod motion;
pub mod names;
pub mod near;
pub mod plausible;
pub mod schema;
pub mod settings;
mod shape;
pub mod slider;
mod spanned;
mod title;
pub mod units;
pub mod unprintable;
pub mod upright;
pub mod warning;

pub use entry::Entry;

use crate::diagnostic::Diagnostics;
use law::Laws;
use model::Scene;
use std::path::Path;

/// Reads and checks a scene with the friction laws known to the program. Files are named relative to `folder`, and `columns` reads those whose
/// numbers belong to the scene.
///
/// # Errors
/// All errors of the checks, or the first error of the text or of a file.
pub fn read(
    text: &str,
    folder: &Path,
    laws: &Laws,
    columns: &mut files::Columns<'_>,
) -> Result<Scene, Diagnostics> {
    if let Some(error) = unprintable::find(text) {
        return Err(Diagnostics(vec![error]));
    }
    let mut scene: Scene = toml::from_str(text).map_err(|e| Diagnostics(vec![explain::explain(&e, text)]))?;
    scene.folder = folder.to_path_buf();
    let doubts = files::fill(&mut scene, columns).map_err(|error| Diagnostics(vec![error]))?;
    azimuth::rakes(&mut scene);
    let (mut errors, mut warnings) = check::check(&scene, laws);
    plausible::judge(text, plausible::Known::of(&scene), &mut errors, &mut warnings);
    warnings.extend(doubts);
    scene.warnings = warnings;
    if errors.is_empty() { Ok(scene) } else { Err(Diagnostics(errors)) }
}
