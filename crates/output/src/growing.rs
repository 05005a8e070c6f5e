//! A table that grows by whole rows.

use crate::atomic;
use crate::error::OutputError;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// See the module.
#[derive(Debug)]
pub struct Growing {
    path: PathBuf,
    file: fs::File,
    /// Bytes written so far.
    bytes: u64,
}

impl Growing {
    /// A new one, with its header.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create(path: PathBuf, header: &[u8]) -> Result<Self, OutputError> {
        atomic::write(&path, header)?;
        match fs::OpenOptions::new().append(true).open(&path) {
            Ok(file) => Ok(Self { path, file, bytes: header.len() as u64 }),
            Err(source) => Err(OutputError::write(&path, source)),
        }
    }

    /// One that had so many bytes; later ones are cut off.
    ///
    /// # Errors
    /// If the file is missing, shorter than that, or cannot be written.
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

    /// One write per row: a run that is killed leaves whole rows.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn push(&mut self, row: &[u8]) -> Result<(), OutputError> {
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

    /// Waits until its rows are on the disc.
    ///
    /// # Errors
    /// If they could not be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.file.sync_data().map_err(|source| OutputError::write(&self.path, source))
    }
}
