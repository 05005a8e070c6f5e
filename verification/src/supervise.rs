//! The suite in a process of its own: a case that ends the process, by a signal or by running out of stack or memory, disagrees
//! with its name, and the other cases run.

use serde::{Deserialize, Serialize};
use std::io;
use std::path::Path;
use std::process::{Command, ExitStatus};

/// A case that ended the process, and how.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LostCase {
    /// Name of the case.
    pub case: String,
    /// End of the process, as text.
    pub how: String,
}

/// State of a process of the suite, in a file: the supervisor names lost cases, the process those that run.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct State {
    /// Names of the running cases.
    pub running: Vec<String>,
    /// True once the report is written.
    pub ended: bool,
    /// Cases that are not to be run, since they ended an earlier process.
    pub lost: Vec<LostCase>,
}

impl State {
    /// Reads the file.
    ///
    /// # Errors
    /// If it cannot be read, or is not of this form.
    pub fn read(path: &Path) -> io::Result<State> {
        Ok(serde_json::from_str(&std::fs::read_to_string(path)?)?)
    }

    /// Writes the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        std::fs::write(path, serde_json::to_string(self)?)
    }
}

/// Runs `suite` until it ends by itself, and returns its exit status. A process that ends otherwise is followed by one without
/// the case that ended it. `alone` runs one case by name; of several cases that ran side by side it tells which one it was.
///
/// # Errors
/// If a process cannot be started, or the file at `path` cannot be read or written.
pub fn supervise(
    path: &Path,
    mut suite: impl FnMut() -> Command,
    mut alone: impl FnMut(&str) -> Command,
) -> io::Result<ExitStatus> {
    let mut lost: Vec<LostCase> = Vec::new();
    loop {
        State { lost: lost.clone(), ..State::default() }.write(path)?;
        let status = suite().status()?;
        let state = State::read(path)?;
        if state.ended || state.running.is_empty() {
            return Ok(status);
        }
        let guilty = guilty(path, &state.running, &mut alone)?;
        lost.extend(
            guilty.into_iter().map(|case| LostCase { case, how: format!("the process ended: {status}") }),
        );
    }
}

/// Those of the running cases that end a process alone; all of them if none does.
fn guilty(
    path: &Path,
    running: &[String],
    alone: &mut impl FnMut(&str) -> Command,
) -> io::Result<Vec<String>> {
    if running.len() == 1 {
        return Ok(running.to_vec());
    }
    let mut guilty = Vec::new();
    for case in running {
        State::default().write(path)?;
        alone(case).status()?;
        if !State::read(path)?.ended {
            guilty.push(case.clone());
        }
    }
    Ok(if guilty.is_empty() { running.to_vec() } else { guilty })
}
