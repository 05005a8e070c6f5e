//! Reason why an output could not be made.

use std::path::{Path, PathBuf};

/// Reason why an output could not be made.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// A directory could not be made.
    #[error("cannot create the output directory {path}: {source}")]
    Directory {
        /// The directory.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file could not be written (or renamed into its place, or removed).
    #[error("cannot write {path}: {source}")]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A table that is to grow on cannot be opened.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A table has lost rows.
    #[error(
        "{path} has {found} bytes and had {expected} at the checkpoint; restore it, or run without --resume to begin again"
    )]
    Shorter {
        /// The file.
        path: PathBuf,
        /// Bytes it has.
        found: u64,
        /// Bytes it had.
        expected: u64,
    },
    /// A plot could not be drawn.
    #[error("cannot draw {path}: {reason}")]
    Draw {
        /// The plot.
        path: PathBuf,
        /// Words of the plotting library.
        reason: String,
    },
    /// The step shows something else than the set-up announced.
    #[error("{what}: {found} values where the set-up announced {expected}")]
    Shape {
        /// Which field, of which part.
        what: String,
        /// Length announced.
        expected: usize,
        /// Length found.
        found: usize,
    },
}

impl OutputError {
    /// A file could not be written.
    #[must_use]
    pub fn write(path: &Path, source: std::io::Error) -> Self {
        Self::Write { path: path.to_path_buf(), source }
    }
}

/// Refuses a field whose length is not the announced one.
pub(crate) fn expect_length(what: &str, expected: usize, found: usize) -> Result<(), OutputError> {
    if expected == found {
        return Ok(());
    }
    Err(OutputError::Shape { what: what.to_string(), expected, found })
}
