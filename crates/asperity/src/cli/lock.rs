//! Lock of an output directory: held by the run that writes there, and free again when its process ends in any way.

use super::begin::LOCK;
use miette::{IntoDiagnostic, WrapErr, miette};
use std::fs::{File, TryLockError};
use std::io::{ErrorKind, Read as _, Write as _};
use std::path::Path;

/// Lock held for as long as this value exists. The file holds the number of the process meanwhile.
#[derive(Debug)]
pub(super) struct Lock(File);

impl Lock {
    /// Locks a directory for this process; `None` if the file system has no locks.
    ///
    /// # Errors
    /// If another run holds the lock, or the file cannot be written.
    pub fn acquire(path: &Path) -> miette::Result<Option<Self>> {
        let name = path.join(LOCK);
        let file = File::options().create(true).append(true).read(true).open(&name);
        let mut file = file.into_diagnostic().wrap_err_with(|| format!("cannot write {}", name.display()))?;
        match file.try_lock() {
            Ok(()) => {
                // The number only serves the message of another run.
                let _ = file.set_len(0).and_then(|()| writeln!(file, "{}", std::process::id()));
                Ok(Some(Self(file)))
            }
            Err(TryLockError::WouldBlock) => Err(miette!(
                "another run{} writes into {}: wait for its end, or choose another directory with --out",
                holder(&mut file),
                path.display()
            )),
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(None),
            Err(TryLockError::Error(error)) => {
                Err(error).into_diagnostic().wrap_err_with(|| format!("cannot lock {}", name.display()))
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // What stays in the file does no harm.
        let _ = self.0.set_len(0);
    }
}

/// Process that holds a lock, in parentheses; nothing if its number cannot be read.
fn holder(file: &mut File) -> String {
    let mut text = String::new();
    let read = file.read_to_string(&mut text);
    let number = read.ok().and_then(|_| text.trim().parse::<u32>().ok());
    number.map_or(String::new(), |number| format!(" (process {number})"))
}
