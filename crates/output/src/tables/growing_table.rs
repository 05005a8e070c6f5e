//! A table that grows by whole rows.

use crate::atomic;
use crate::error::OutputError;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// A table that grows by whole rows.
#[derive(Debug)]
pub struct GrowingTable {
    path: PathBuf,
    file: fs::File,
    /// Bytes written so far.
    bytes: u64,
}

impl GrowingTable {
    /// Creates a table with its header.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create(path: PathBuf, header: impl AsRef<[u8]>) -> Result<Self, OutputError> {
        let header = header.as_ref();
        atomic::write(&path, header)?;
        match fs::OpenOptions::new().append(true).open(&path) {
            Ok(file) => Ok(Self { path, file, bytes: header.len() as u64 }),
            Err(source) => Err(OutputError::write(&path, source)),
        }
    }

    /// Reopens a table at a size in bytes and truncates it to this size.
    ///
    /// # Errors
    /// If the file is missing, shorter than `expected`, or cannot be written.
    pub fn reopen(path: PathBuf, expected: u64) -> Result<Self, OutputError> {
        let file = fs::OpenOptions::new().append(true).open(&path);
        let found = file.and_then(|file| Ok((file.metadata()?.len(), file)));
        let (found, file) = match found {
            Ok(found) => found,
            Err(source) => return Err(OutputError::Read { path, source }),
        };
        if found < expected {
            return Err(OutputError::Shorter { path, found, expected });
        }
        file.set_len(expected).map_err(|source| OutputError::write(&path, source))?;
        Ok(Self { path, file, bytes: expected })
    }

    /// Appends a row in a single write, so that an interrupted run leaves whole rows.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn push(&mut self, row: impl AsRef<[u8]>) -> Result<(), OutputError> {
        let row = row.as_ref();
        self.bytes += row.len() as u64;
        self.file.write_all(row).map_err(|source| OutputError::write(&self.path, source))
    }

    /// Bytes written so far.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Flushes all rows to disk.
    ///
    /// # Errors
    /// If the rows cannot be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.file.sync_data().map_err(|source| OutputError::write(&self.path, source))
    }
}
