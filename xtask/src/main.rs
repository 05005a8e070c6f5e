//! Starts commands and reads result files; knows no physics.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program speaks through its standard streams"
)]

mod benchmarks;
mod defects;
mod interop;
mod report;
mod stage;
mod tidy;

use clap::{Parser, Subcommand};
use stage::{Failure, Stage};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Chores of the workspace.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Options {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// tidy, the workspace's tests, then the verification suite.
    Verify {
        /// Run the long cases, too.
        #[arg(long)]
        full: bool,
        /// Run only cases whose name matches.
        #[arg(long, value_name = "GLOB")]
        case: Option<String>,
    },
    /// Checks what the compiler and clippy do not.
    Tidy,
    /// Makes each planted defect in a copy of the tree, and shows which claims notice it.
    Defects {
        /// Only defects with this in their names.
        #[arg(value_name = "PART")]
        only: Option<String>,
        /// Run only the cases that a defect names, and not the quick suite where these do not notice it.
        #[arg(long)]
        expected: bool,
        /// Run the tests of the workspace, too.
        #[arg(long)]
        tests: bool,
        /// Run defects again that were noticed before.
        #[arg(long)]
        again: bool,
    },
    /// Writes the benchmarks that others can enter: reference values, entries and pages, or an archive of them.
    Benchmarks {
        /// Only benchmarks with this in their names.
        #[arg(value_name = "PART")]
        only: Option<String>,
        /// Run nothing: only the files that follow from reference values and results.
        #[arg(long)]
        pages: bool,
        /// Write an archive of all files there instead, the same bytes for the same files.
        #[arg(long, value_name = "FILE.tar", conflicts_with_all = ["only", "pages"])]
        archive: Option<PathBuf>,
    },
    /// Runs the benches.
    Bench,
    /// Says where the last verification report is, and what it says.
    Report,
    /// Builds the book.
    Docs,
    /// Checks the outputs of a run with their real readers, in a Python environment of its own.
    Interop,
}

fn main() -> ExitCode {
    let root = root();
    let result = match Options::parse().chore {
        Chore::Verify { full, case } => verify(&root, full, case.as_deref()),
        Chore::Tidy => tidy(&root),
        Chore::Defects { only, expected, tests, again } => {
            defects::run(&root, &defects::Choice { only, expected, tests, again })
        }
        Chore::Benchmarks { only, pages, archive } => {
            benchmarks::run(&root, &benchmarks::Choice { only, pages, archive })
        }
        Chore::Bench => Stage::new("bench", "cargo").args(["bench", "-p", "asperity-benches"]).run(&root),
        Chore::Report => report::print(&root),
        Chore::Docs => docs(&root),
        Chore::Interop => interop::run(&root),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(failure.code())
        }
    }
}

/// The workspace: the parent of this package.
fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_owned()
}

fn verify(root: &Path, full: bool, case: Option<&str>) -> Result<(), Failure> {
    tidy(root)?;
    Stage::new("tests", "cargo").args(["test", "--workspace", "--release"]).run(root)?;
    let mut suite = Stage::new("verification", "cargo").args([
        "run",
        "--release",
        "-p",
        "asperity-verification",
        "--",
        "--tested",
    ]);
    if full {
        suite = suite.args(["--full"]);
    }
    if let Some(case) = case {
        suite = suite.args(["--case", case]);
    }
    suite.run(root)
}

fn tidy(root: &Path) -> Result<(), Failure> {
    stage::announce("tidy");
    let found = tidy::check(root)?;
    for problem in &found {
        println!("{problem}");
    }
    let errors = found.iter().filter(|problem| !problem.warning).count();
    println!("tidy: {errors} errors, {} warnings", found.len() - errors);
    if errors == 0 { Ok(()) } else { Err(Failure::Tidy { errors }) }
}

fn docs(root: &Path) -> Result<(), Failure> {
    if !stage::exists("mdbook") {
        return Err(Failure::Missing { program: "mdbook", how: "cargo install mdbook --locked" });
    }
    Stage::new("docs", "mdbook").args(["build", "docs"]).run(root)
}
