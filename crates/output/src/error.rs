//! Errors of outputs.

use std::path::{Path, PathBuf};

/// Reason why a figure could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PaintError {
    /// The embedded font, for PNG.
    #[error("the embedded font is not readable")]
    Font,
    /// The embedded font, for PDF.
    #[error(transparent)]
    Face(#[from] ttf_parser::FaceParsingError),
    /// The part of the font that a figure uses.
    #[error(transparent)]
    Subset(#[from] subsetter::Error),
    /// The plotting library.
    #[error(transparent)]
    Plotters(#[from] Box<dyn std::error::Error + Send + Sync>),
    /// A table that cannot be read.
    #[error(transparent)]
    Table(#[from] csv::Error),
    /// A table with other rows than the map that it belongs to.
    #[error("it has {found} rows, and the map {expected} positions")]
    Rows {
        /// Number of its rows.
        found: usize,
        /// Positions of the map.
        expected: usize,
    },
}

/// Reason why an output could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// A directory could not be created.
    #[error("cannot create the output directory {path}: {source}")]
    Directory {
        /// The directory.
        path: PathBuf,
        /// Reason given by the system.
        source: std::io::Error,
    },
    /// A file could not be written, renamed or removed.
    #[error("cannot write {path}: {source}")]
    Write {
        /// The file.
        path: PathBuf,
        /// Reason given by the system.
        source: std::io::Error,
    },
    /// A table to be continued could not be opened.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// Reason given by the system.
        source: std::io::Error,
    },
    /// A table has lost rows.
    #[error(
        "{path} has {found} bytes and had {expected} at the checkpoint; restore it, or run without --resume to begin again"
    )]
    Shorter {
        /// The file.
        path: PathBuf,
        /// Bytes found.
        found: u64,
        /// Bytes at the checkpoint.
        expected: u64,
    },
    /// A plot could not be drawn.
    #[error("cannot draw {path}: {reason}")]
    Draw {
        /// The plot.
        path: PathBuf,
        /// Reason.
        reason: PaintError,
    },
    /// The fields of a step do not have the announced lengths.
    #[error("{what}: {found} values where the set-up announced {expected}")]
    Shape {
        /// Field and the part to which it belongs.
        what: String,
        /// Announced length.
        expected: usize,
        /// Length found.
        found: usize,
    },
}

impl OutputError {
    /// Error of a file that could not be written.
    #[must_use]
    pub fn write(path: &Path, source: std::io::Error) -> Self {
        Self::Write { path: path.to_path_buf(), source }
    }
}

/// Refuses a field that does not have the announced length.
pub(crate) fn expect_length(what: &str, expected: usize, found: usize) -> Result<(), OutputError> {
    if expected == found {
        return Ok(());
    }
    Err(OutputError::Shape { what: what.to_string(), expected, found })
}
