//! Runs the verification suite and writes its report.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program speaks through its standard streams"
)]

use asperity_driver::cli::{self, Arguments};
use asperity_verification::case::Outcome;
use asperity_verification::report::{self, provenance::Provenance};
use asperity_verification::suite::{Selection, Summary};
use asperity_verification::{Verdict, cases};
use clap::Parser;
use std::error::Error;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Runs the verification cases one after another, judges their claims and writes a report.
#[derive(Parser)]
struct Options {
    /// Run the long cases, too.
    #[arg(long)]
    full: bool,
    /// Run only cases whose name matches this pattern (`*` any characters, `?` one).
    #[arg(long, value_name = "GLOB")]
    case: Option<String>,
    /// Folder of the report.
    #[arg(long, value_name = "DIR", default_value = "target/verify")]
    out: PathBuf,
    /// Run this scene as the `asperity` program does, without plots, instead of the suite. For tools that measure a process.
    #[arg(long, hide = true, value_name = "FILE")]
    scene: Option<PathBuf>,
}

fn main() -> ExitCode {
    let options = Options::parse();
    if let Some(scene) = &options.scene {
        return run_scene(scene, &options.out);
    }
    match suite(&options) {
        Ok(summary) if summary.passes() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run_scene(scene: &Path, out: &Path) -> ExitCode {
    let words = ["asperity", "run", "--no-plots", "--force", "--out"].map(OsStr::new);
    let arguments = Arguments::parse_from(words.into_iter().chain([out.as_os_str(), scene.as_os_str()]));
    match cli::execute(&arguments) {
        Ok(cli::End::Done) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::from(2),
        Err(error) => {
            eprintln!("error: {error:?}");
            ExitCode::FAILURE
        }
    }
}

fn suite(options: &Options) -> Result<Summary, Box<dyn Error>> {
    let start = Instant::now();
    let chosen = Selection { full: options.full, glob: options.case.clone() }.of(cases::ALL)?;
    let width = chosen.iter().map(|case| case.name.len()).max().unwrap_or(0);
    println!("{:width$}   hold  disagree  not covered   slack  thin     time", "case");
    let mut outcomes: Vec<Outcome> = Vec::new();
    for case in chosen {
        let outcome = case.execute();
        print_row(&outcome, width);
        outcomes.push(outcome);
    }
    let run = Provenance::gather(options.full, start.elapsed().as_secs_f64());
    report::write(&options.out, &outcomes, &run)?;
    let summary = Summary::of_all(&outcomes);
    println!();
    println!("report: {}", options.out.join("index.html").display());
    println!("{summary}");
    Ok(summary)
}

fn print_row(outcome: &Outcome, width: usize) {
    let s = Summary::of(&outcome.record.claims);
    println!(
        "{:width$} {:>6} {:>9} {:>12} {:>7} {:>5} {:>7.2} s",
        outcome.case.name, s.hold, s.disagree, s.not_covered, s.slack_unexplained, s.thin, outcome.wall
    );
    for judged in outcome.record.claims.iter().filter(|judged| judged.verdict == Verdict::Disagrees) {
        let size = judged
            .measured
            .map_or(String::new(), |m| format!(" (error {:.3e}, bound {:.3e})", m.error, m.bound));
        println!("  disagrees: {}: {}{size}", judged.claim.quantity, judged.problem.as_deref().unwrap_or(""));
    }
}
