//! What a run leaves behind: records in memory, field files, tables, plots and progress, each an [`Observer`] that sees
//! every accepted step and knows nothing of how it was computed.

pub mod atomic;
pub mod decimals;
pub mod files;
mod multi;
pub mod plots;
mod progress;
mod pulse;
mod record;
mod schedule;
mod table;
#[cfg(test)]
mod tests;
pub mod view;
pub mod vtu;

pub use files::Files;
pub(crate) use files::stems;
pub use multi::Multi;
pub use progress::Progress;
pub use pulse::Pulse;
pub use record::{InterfaceHistory, PointHistory, Recorder, StageEnd};
pub use schedule::FieldSchedule;
pub use view::Observer;

use std::path::{Path, PathBuf};

/// Why an output could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ObserveError {
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
    /// A plot could not be drawn.
    #[error("cannot draw {path}: {reason}")]
    Draw {
        /// The plot.
        path: PathBuf,
        /// What the plotting library says.
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

impl ObserveError {
    pub(crate) fn write(path: &Path, source: std::io::Error) -> Self {
        Self::Write { path: path.to_path_buf(), source }
    }
}

/// Refuses a field whose length is not the announced one.
fn expect_length(what: &str, expected: usize, found: usize) -> Result<(), ObserveError> {
    if expected == found {
        return Ok(());
    }
    Err(ObserveError::Shape { what: what.to_string(), expected, found })
}
