//! Set-ups of faults that took long, kept beside the run for the next one: the operator of slip with the tractions of loads, and
//! bodies that a stage before has pressed.
//!
//! A part of a set-up is a value with everything that a run of the same scene needs of it. It is used only if it was computed by
//! the same program from the same inputs, so that results have the same bits with and without it.

mod file;
mod key;

pub use key::Key;

use asperity_output::atomic;
use asperity_run::report::{Part, SetupPart, Use};
use clap::ValueEnum;
use file::{Identity, UnusedReason};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::cell::{OnceCell, RefCell};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Folder of the set-up in the output directory.
pub const FOLDER: &str = "setup";

/// Wall time from which computing a part is worth a file: an interruption then costs less than this.
const LONG: Duration = Duration::from_secs(60);

/// Set-ups that are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// One that took a minute or longer.
    #[default]
    Auto,
    /// Any.
    Always,
    /// None, and none is read.
    Never,
}

/// Set-ups in the directory of a run.
#[derive(Debug, Default)]
pub struct Setups {
    /// Folder of the files; `None` if nothing is kept.
    folder: Option<PathBuf>,
    when: When,
    /// SHA-256 of the program, once it is asked for; `None` if it cannot be read.
    program: OnceCell<Option<String>>,
    kept: RefCell<Vec<SetupPart>>,
    warnings: RefCell<Vec<String>>,
}

impl Setups {
    /// Set-ups of which none is kept.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// Set-ups that are kept in an output directory.
    #[must_use]
    pub fn beside(out: &Path, when: When) -> Self {
        let folder = (when != When::Never).then(|| out.join(FOLDER));
        Self { folder, when, ..Self::default() }
    }

    /// Returns the hash of what a part depends on, if parts are kept.
    pub fn hash(&self, of: impl FnOnce(Key) -> Key) -> Option<String> {
        self.folder.as_ref().map(|_| of(Key::default()).finish())
    }

    /// Reads a part that depends on these inputs, or computes it and keeps it if that took long. A file that cannot be used or
    /// written is a warning.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn part<T, E>(
        &self,
        part: Part,
        inputs: Option<String>,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E>
    where
        T: Serialize + DeserializeOwned,
    {
        let (Some(folder), Some(inputs)) = (&self.folder, inputs) else { return make() };
        let path = folder.join(format!("{}.bin", part.name()));
        if let Some(read) = self.read(part, &path, &inputs) {
            return Ok(read);
        }
        let clock = Instant::now();
        let made = make()?;
        let took = clock.elapsed();
        if self.when == When::Always || took >= LONG {
            self.write(part, &path, &inputs, (took.as_secs_f64(), &made));
        }
        Ok(made)
    }

    /// Returns the parts that were read or written, and warnings about files.
    #[must_use]
    pub fn finish(self) -> (Vec<SetupPart>, Vec<String>) {
        if let Some(folder) = &self.folder {
            // Only an empty one is removed: nothing could be written to it.
            let _ = fs::remove_dir(folder);
        }
        (self.kept.into_inner(), self.warnings.into_inner())
    }

    fn read<T: DeserializeOwned>(&self, part: Part, path: &Path, inputs: &str) -> Option<T> {
        atomic::tidy(path);
        if !path.exists() {
            // As usual. The program need not be summed up.
            return None;
        }
        let program = self.program()?;
        match file::read(path, &Identity { part: part.name(), inputs, program }) {
            Ok((read, seconds, bytes)) => {
                self.keep(part, Use::Read, inputs, (bytes, seconds));
                Some(read)
            }
            Err(UnusedReason::Absent) => None,
            Err(reason) => {
                let path = path.display();
                let warning = format!("the set-up in {path} is not used, and computed again: {reason}");
                self.warnings.borrow_mut().push(warning);
                None
            }
        }
    }

    fn write<T: Serialize>(&self, part: Part, path: &Path, inputs: &str, (seconds, made): (f64, &T)) {
        let Some(program) = self.program() else {
            let warning = "the set-up is not kept, as the file of the program cannot be read".to_string();
            self.warnings.borrow_mut().push(warning);
            return;
        };
        let identity = Identity { part: part.name(), inputs, program };
        let made = path.parent().map_or(Ok(()), atomic::create_dir).and_then(|()| {
            let bytes = file::write(path, &identity, seconds, made)?;
            self.keep(part, Use::Written, inputs, (bytes, seconds));
            Ok(())
        });
        if let Err(error) = made {
            let warning = format!("{error}: the set-up is not kept, and the next run computes it again");
            self.warnings.borrow_mut().push(warning);
        }
    }

    fn keep(&self, part: Part, how: Use, inputs: &str, (bytes, seconds): (u64, f64)) {
        let file = format!("{FOLDER}/{}.bin", part.name());
        let inputs_sha256 = inputs.to_string();
        self.kept.borrow_mut().push(SetupPart { part, file, how, inputs_sha256, bytes, seconds });
    }

    /// SHA-256 of the program. A version would not do: set-ups of a program under development differ from build to build.
    fn program(&self) -> Option<&str> {
        let found = || file::sum_of(&std::env::current_exe().ok()?).ok();
        self.program.get_or_init(found).as_deref()
    }
}
