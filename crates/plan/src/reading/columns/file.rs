//! Files of columns that a scene names.

use super::{Columns, Wrong};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::missing_file::{FileKind, unread};
use crate::reading::sniff::{self, Reader};
use asperity_scene::files::Column;
use asperity_scene::model::Spanned;
use std::path::Path;

/// Files of columns.
const TABLES: FileKind = FileKind { what: "files of columns", extensions: &["csv", "txt"] };

/// Columns of a file in a folder.
///
/// # Errors
/// [`Diagnostic`] at the name of the file.
pub(crate) fn read(folder: &Path, file: &Spanned<String>) -> Result<Columns, Diagnostic> {
    let bytes = bytes(folder, file, TABLES)?;
    if let Some(wrong) = sniff::other(&bytes, Reader::Columns) {
        return Err(refused(file, file.span(), wrong));
    }
    Columns::parse(&bytes).map_err(|wrong| refused(file, file.span(), wrong))
}

/// Bytes of a file in a folder, beside which others of its kind may lie.
///
/// # Errors
/// [`Diagnostic`] at the name of the file.
pub(crate) fn bytes(folder: &Path, file: &Spanned<String>, kind: FileKind) -> Result<Vec<u8>, Diagnostic> {
    let (name, path) = (file.get_ref(), folder.join(file.get_ref()));
    std::fs::read(&path).map_err(|e| {
        let (message, help) = unread(&path, &e, kind);
        Diagnostic::at(file.span(), format!("the file `{name}` cannot be read: {message}"), help)
    })
}

/// Numbers of columns of a file in a folder, in SI units.
///
/// # Errors
/// [`Diagnostic`] at the name of the file or of a column.
pub(crate) fn columns_of(
    folder: &Path,
    file: &Spanned<String>,
    wanted: &[Column<'_>],
) -> Result<Vec<Vec<f64>>, Diagnostic> {
    let columns = read(folder, file)?;
    let numbers = |column: &Column<'_>| {
        let found = columns.numbers(column.name, Some(column.dimension));
        found.map_err(|wrong| refused(file, column.place.clone(), wrong))
    };
    wanted.iter().map(numbers).collect()
}

/// Error of a file at a place of the scene.
pub(crate) fn refused(
    file: &Spanned<String>,
    place: std::ops::Range<usize>,
    Wrong { message, help }: Wrong,
) -> Diagnostic {
    Diagnostic::at(place, format!("file `{}`: {message}", file.get_ref()), help)
}
