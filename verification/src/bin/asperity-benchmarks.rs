//! Writes the benchmarks for other programs: reference values, the entries of this program and of the independent ones, and the
//! tables of their pages.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program prints to its standard streams")]

use asperity_verification::CaseError;
use asperity_verification::benchmarks::{self, Maker, pages};
use clap::Parser;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Writes the files of all benchmarks.
#[derive(Parser)]
struct Options {
    /// Folder of the benchmarks.
    #[arg(long, value_name = "DIR", default_value = "docs/src/benchmarks")]
    folder: PathBuf,
    /// Run no scenes; write the tables of values, templates and pages from the existing reference values and results.
    #[arg(long)]
    pages: bool,
    /// Only benchmarks whose names contain this text.
    #[arg(value_name = "PART")]
    only: Option<String>,
}

fn main() -> ExitCode {
    let options = Options::parse();
    let chosen = |maker: &&Maker| options.only.as_ref().is_none_or(|part| maker.name.contains(part.as_str()));
    for maker in benchmarks::ALL.iter().filter(chosen) {
        if let Err(error) = write(&options, maker) {
            eprintln!("error: {}: {error}", maker.name);
            return ExitCode::FAILURE;
        }
        println!("{}", maker.name);
    }
    ExitCode::SUCCESS
}

fn write(options: &Options, maker: &Maker) -> Result<(), CaseError> {
    let folder = options.folder.join(maker.name);
    if !options.pages {
        run(&folder, maker)?;
    }
    for file in pages::derived(&folder)? {
        fs::write(&file.path, &file.text)?;
    }
    Ok(())
}

/// Writes reference values and entries.
fn run(folder: &Path, maker: &Maker) -> Result<(), CaseError> {
    let made = (maker.make)()?;
    fs::create_dir_all(folder.join("results"))?;
    fs::write(folder.join("reference.json"), serde_json::to_string_pretty(&made.reference)? + "\n")?;
    for entry in &made.entries {
        fs::write(folder.join("results").join(format!("{}.csv", entry.file)), entry.text(&made.reference))?;
    }
    Ok(())
}
