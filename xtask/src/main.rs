//! Chores of the workspace: they start commands and read result files, and contain no physics.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program prints to its standard streams")]

mod benchmarks;
mod code;
mod defects;
mod interop;
mod notices;
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
    /// Runs tidy, the tests of the workspace, and the verification suite.
    Verify {
        /// Run the long cases as well.
        #[arg(long)]
        full: bool,
        /// Run only cases whose name matches.
        #[arg(long, value_name = "GLOB")]
        case: Option<String>,
    },
    /// Runs checks that the compiler and clippy do not make.
    Tidy,
    /// Applies each planted defect to a copy of the tree and prints the claims that detect it.
    Defects {
        /// Only defects with this in their names.
        #[arg(value_name = "PART")]
        only: Option<String>,
        /// Run only the cases that a defect names, even if these do not detect it.
        #[arg(long)]
        expected: bool,
        /// Run the tests of the workspace as well.
        #[arg(long)]
        tests: bool,
        /// Rerun defects that were detected before.
        #[arg(long)]
        again: bool,
        /// List the defects that are to be run, and why, and run nothing.
        #[arg(long)]
        list: bool,
    },
    /// Writes the community benchmarks: reference values, entries and pages, or an archive of them.
    Benchmarks {
        /// Only benchmarks with this in their names.
        #[arg(value_name = "PART")]
        only: Option<String>,
        /// Run nothing: write only files derived from reference values and results.
        #[arg(long)]
        pages: bool,
        /// Write a reproducible archive of all files instead.
        #[arg(long, value_name = "FILE.tar", conflicts_with_all = ["only", "pages"])]
        archive: Option<PathBuf>,
    },
    /// Runs the benches.
    Bench,
    /// Prints the path and summary of the last verification report.
    Report,
    /// Prints names, versions and licences of the libraries that the program is built on.
    Notices,
    /// Builds the book.
    Docs,
    /// Checks the outputs of runs with common readers, in separate Python environments.
    Interop {
        /// Succeed without checks if the readers cannot be installed.
        #[arg(long)]
        if_possible: bool,
    },
}

fn main() -> ExitCode {
    let root = root();
    let result = match Options::parse().chore {
        Chore::Verify { full, case } => verify(&root, full, case.as_deref()),
        Chore::Tidy => tidy(&root),
        Chore::Defects { only, expected, tests, again, list } => {
            defects::run(&root, &defects::Choice { only, expected, tests, again, list })
        }
        Chore::Benchmarks { only, pages, archive } => {
            benchmarks::run(&root, &benchmarks::Choice { only, pages, archive })
        }
        Chore::Bench => Stage::new("bench", "cargo").args(["bench", "-p", "asperity-benches"]).run(&root),
        Chore::Report => report::print(&root),
        Chore::Notices => notices::print(&root),
        Chore::Docs => docs(&root),
        Chore::Interop { if_possible: true } => interop::run_if_possible(&root),
        Chore::Interop { if_possible: false } => interop::run(&root),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(failure.code())
        }
    }
}

/// Root of the workspace: the parent folder of this package.
fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_owned()
}

fn verify(root: &Path, full: bool, case: Option<&str>) -> Result<(), Failure> {
    tidy(root)?;
    // Without examples and benches, which have no tests: clippy sees that they compile.
    let tests =
        ["test", "--workspace", "--exclude", "asperity-benches", "--release", "--lib", "--bins", "--tests"];
    Stage::new("tests", "cargo").args(tests).env("RUST_TEST_THREADS", &threads().to_string()).run(root)?;
    Stage::new("documented examples", "cargo")
        .args(["test", "--workspace", "--exclude", "asperity-benches", "--release", "--doc"])
        .run(root)?;
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
    } else {
        // Many quick cases use one thread. Long cases need the memory, and their wall times are compared with those of releases.
        suite = suite.args(["--jobs", &cores().to_string()]);
    }
    if let Some(case) = case {
        suite = suite.args(["--case", case]);
    }
    suite.run(root)
}

/// Threads for tests: twice the cores, since tests of files wait for the disc.
fn threads() -> usize {
    2 * cores()
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
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
