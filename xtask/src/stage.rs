//! Stages: commands that run one after another, each announced.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Reason why a chore failed.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A command ended with an error; its own messages precede this one.
    #[error("stage `{stage}` failed{}", .code.map_or(String::new(), |code| format!(" with exit code {code}")))]
    Stage {
        /// Name of the stage.
        stage: String,
        /// Exit code; `None` if a signal ended it.
        code: Option<i32>,
    },
    /// A command could not be started.
    #[error("cannot start `{program}`: {source}")]
    Start {
        /// Program.
        program: String,
        /// Reason.
        source: std::io::Error,
    },
    /// Tidy found errors.
    #[error("tidy found {errors} errors")]
    Tidy {
        /// Number of errors.
        errors: usize,
    },
    /// A program that the chore needs was not found.
    #[error("`{program}` is needed and was not found; get it with: {how}")]
    Missing {
        /// Program.
        program: &'static str,
        /// Command that installs it.
        how: &'static str,
    },
    /// A file that the chore needs is missing or cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// File.
        path: PathBuf,
        /// Reason.
        source: std::io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// File.
        path: PathBuf,
        /// Reason.
        source: std::io::Error,
    },
    /// A result that must exist first is missing.
    #[error("{} does not exist; make it with: {how}", .path.display())]
    Absent {
        /// File.
        path: PathBuf,
        /// Command that makes it.
        how: &'static str,
    },
    /// A result file is not a report.
    #[error("{} is not a report: {source}", .path.display())]
    Report {
        /// File.
        path: PathBuf,
        /// Reason.
        source: serde_json::Error,
    },
    /// A planted defect is invalid.
    #[error("defect `{name}`: {reason}")]
    Defect {
        /// Name of the defect.
        name: String,
        /// Reason.
        reason: String,
    },
    /// Cargo could not describe the workspace.
    #[error("cargo metadata: {0}")]
    Metadata(#[from] cargo_metadata::Error),
    /// The tree could not be walked.
    #[error("cannot walk the workspace: {0}")]
    Walk(#[from] walkdir::Error),
}

impl Failure {
    /// Exit code to pass on: that of the command if there is one.
    pub fn code(&self) -> u8 {
        match self {
            Failure::Stage { code: Some(code), .. } => {
                u8::try_from(*code).ok().filter(|&c| c != 0).unwrap_or(1)
            }
            _ => 1,
        }
    }
}

/// A named command.
pub struct Stage {
    name: String,
    program: PathBuf,
    arguments: Vec<String>,
    environment: Vec<(String, String)>,
}

impl Stage {
    /// A stage that starts `program`. `cargo` means the cargo that started this process.
    pub fn new(name: &str, program: impl Into<PathBuf>) -> Stage {
        let program = program.into();
        let own = std::env::var_os("CARGO").filter(|_| program == Path::new("cargo"));
        let program = own.map_or(program, PathBuf::from);
        Stage { name: name.to_owned(), program, arguments: Vec::new(), environment: Vec::new() }
    }

    /// Adds arguments.
    pub fn args<'a>(mut self, arguments: impl IntoIterator<Item = &'a str>) -> Stage {
        self.arguments.extend(arguments.into_iter().map(str::to_owned));
        self
    }

    /// Sets a variable of the command's environment.
    pub fn env(mut self, name: &str, value: &str) -> Stage {
        self.environment.push((name.to_owned(), value.to_owned()));
        self
    }

    /// Runs the command in `folder`; it inherits standard output and error.
    pub fn run(self, folder: &Path) -> Result<(), Failure> {
        announce(&self.name);
        let program = self.program.display().to_string();
        let status = Command::new(&self.program)
            .args(&self.arguments)
            .envs(self.environment)
            .current_dir(folder)
            .status()
            .map_err(|source| Failure::Start { program, source })?;
        if status.success() { Ok(()) } else { Err(Failure::Stage { stage: self.name, code: status.code() }) }
    }
}

/// Prints the heading of a stage.
pub fn announce(name: &str) {
    println!("\n== {name} ==");
}

/// True if a program can be started.
pub fn exists(program: &str) -> bool {
    let quiet = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    quiet.is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::{Failure, Stage};
    use std::path::Path;

    #[test]
    fn the_exit_code_of_a_command_passes_through() {
        let result = Stage::new("shell", "sh").args(["-c", "exit 7"]).run(Path::new("."));
        assert_eq!(result.map_err(|failure| failure.code()), Err(7));
    }

    #[test]
    fn a_program_that_does_not_exist_is_named() {
        let result = Stage::new("none", "no-such-program-here").run(Path::new("."));
        assert!(matches!(result, Err(Failure::Start { program, .. }) if program == "no-such-program-here"));
    }
}
