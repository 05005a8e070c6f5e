//! Files that exist completely or not at all: written under a temporary name in the same directory, then renamed.

use crate::OutputError;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Creates a directory and its parents.
///
/// # Errors
/// If the directory cannot be created.
pub fn create_dir(path: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(path).map_err(|source| OutputError::Directory { path: path.to_path_buf(), source })
}

/// Writes `bytes` to `path` and replaces an existing file atomically. A reader sees either the old file or the new one.
///
/// # Errors
/// If the file cannot be written. The temporary file is removed.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let temporary = temporary_name(path);
    fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path)).map_err(|source| {
        // The first error is the one to report; failure to remove the temporary file adds nothing to it.
        let _ = fs::remove_file(&temporary);
        OutputError::write(path, source)
    })
}

/// Like [`write`], but flushes the file to disk before the renaming. After a machine failure either the old file or the new one
/// exists.
///
/// # Errors
/// See [`write`].
pub fn write_durably(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    stream(path, |file| file.write_all(bytes))
}

/// Like [`write_durably`], with contents that `contents` writes piece by piece.
///
/// # Errors
/// See [`write`].
pub fn stream(
    path: &Path,
    contents: impl FnOnce(&mut fs::File) -> std::io::Result<()>,
) -> Result<(), OutputError> {
    let temporary = temporary_name(path);
    let written = fs::File::create(&temporary).and_then(|mut file| {
        contents(&mut file)?;
        file.sync_all()
    });
    written.and_then(|()| fs::rename(&temporary, path)).map_err(|source| {
        // See `write`.
        let _ = fs::remove_file(&temporary);
        OutputError::write(path, source)
    })
}

/// Removes what writing `path` has left if it was killed. Nobody else may be writing it.
pub fn tidy(path: &Path) {
    // Usually there is nothing, and what cannot be removed does no harm.
    let _ = fs::remove_file(temporary_name(path));
}

/// Creates an output directory and checks that files can be written into it, before anything is computed.
///
/// # Errors
/// If the directory cannot be created, or a file cannot be written into it.
pub fn writable_dir(path: &Path) -> Result<(), OutputError> {
    create_dir(path)?;
    let trial = path.join(".writable");
    write(&trial, b"")?;
    fs::remove_file(&trial).map_err(|source| OutputError::write(&trial, source))
}

fn temporary_name(path: &Path) -> PathBuf {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.tmp"))
}
