//! Runs the verification suite and writes its report.

use asperity::cli::{self, Arguments};
use asperity_output::terminal::printing;
use asperity_verification::case::{Case, Outcome};
use asperity_verification::pool::{self, Limits};
use asperity_verification::report::{self, history, junit, provenance::Provenance};
use asperity_verification::suite::{Selection, Summary};
use asperity_verification::supervise::{self, State};
use asperity_verification::{Verdict, cases, cases::programs, numbers};
use clap::Parser;
use std::error::Error;
use std::ffi::{OsStr, OsString};
use std::io;
use std::num::NonZeroUsize;
use std::os::unix::process::parent_id;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

/// Runs the verification cases, judges their claims and writes a report.
#[derive(Parser)]
struct Options {
    /// Also run the long cases.
    #[arg(long)]
    full: bool,
    /// Run only cases whose name matches this pattern (`*` any characters, `?` one).
    #[arg(long, value_name = "GLOB")]
    case: Option<String>,
    /// Cases that run at a time. Wall times are comparable with one only.
    #[arg(long, value_name = "NUMBER", default_value = "1")]
    jobs: NonZeroUsize,
    /// Folder of the report.
    #[arg(long, value_name = "DIR", default_value = "target/verify")]
    out: PathBuf,
    /// Also write the claims as JUnit XML.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Store error, bound and cost of the cases for a release in verification/history/TAG.json.
    #[arg(long, value_name = "TAG")]
    keep: Option<String>,
    /// State on the pages that the workspace tests passed immediately before.
    #[arg(long)]
    tested: bool,
    /// File in which a process of the suite says what it runs; without it, the suite runs in a process of its own.
    #[arg(long, value_name = "FILE", hide = true)]
    state: Option<PathBuf>,
}

fn main() -> ExitCode {
    // Cases that measure or interrupt a process start this program as `asperity`, so that they run the code built with them.
    let mut words = std::env::args_os().skip(1).peekable();
    if words.peek().is_some_and(|word| word == programs::NAME) {
        return ExitCode::from(asperity(&Arguments::parse_from(words)));
    }
    if words.next_if(|word| word == programs::IN_FOLDERS).is_some() {
        return in_folders(words);
    }
    let options = Options::parse();
    let passes = match &options.state {
        Some(state) => suite(&options, state).map(|summary| summary.passes()),
        None => supervised(&options).map_err(Into::into),
    };
    match passes {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            printing::err(format_args!("error: {error}\n"));
            ExitCode::FAILURE
        }
    }
}

/// Runs the suite in a process of its own. True if it passes.
fn supervised(options: &Options) -> io::Result<bool> {
    std::fs::create_dir_all(&options.out)?;
    let state = options.out.join("state.json");
    let program = std::env::current_exe()?;
    let process = || {
        let mut process = Command::new(&program);
        process.arg("--state").arg(&state);
        process
    };
    let whole = || {
        let mut whole = process();
        whole.args(std::env::args_os().skip(1));
        whole
    };
    let alone = |case: &str| {
        let mut alone = process();
        alone.args(["--full", "--case", case, "--out"]).arg(options.out.join("alone"));
        alone
    };
    let status = supervise::supervise(&state, whole, alone)?;
    std::fs::remove_file(&state)?;
    Ok(status.success())
}

/// Executes a command of the `asperity` program. Returns its exit code.
fn asperity(arguments: &Arguments) -> u8 {
    match cli::execute(arguments) {
        Ok(end) => end.code(),
        Err(error) => {
            printing::err(format_args!("error: {error:?}\n"));
            1
        }
    }
}

/// Runs the scenes of folders until one fails. The name of the folder of results in each comes first.
fn in_folders(mut words: impl Iterator<Item = OsString>) -> ExitCode {
    let Some(out) = words.next() else { return ExitCode::FAILURE };
    let mut codes = words.map(PathBuf::from).map(|folder| run_in_folder(&folder, &out));
    ExitCode::from(codes.find(|&code| code != 0).unwrap_or(0))
}

/// Runs the scene of a folder. At the end of this function callgrind writes what it has counted, so that it has to stay one.
#[inline(never)]
fn run_in_folder(folder: &Path, out: &OsStr) -> u8 {
    let (scene, out) = (folder.join(programs::SCENE), folder.join(out));
    let words = ["asperity", "run", "--no-plots", "--out"].map(OsString::from);
    asperity(&Arguments::parse_from(words.into_iter().chain([out.into(), scene.into()])))
}

/// Runs the cases, except those that ended an earlier process, which disagree. The file `path` says which ones run.
fn run(chosen: &[&Case], options: &Options, path: &Path, width: usize) -> io::Result<Vec<Outcome>> {
    let mut state = State::read(path)?;
    let how =
        |case: &Case| state.lost.iter().find(|lost| lost.case == case.name).map(|lost| lost.how.clone());
    let (lost, sound): (Vec<&Case>, Vec<&Case>) = chosen.iter().partition(|case| how(case).is_some());
    let mut outcomes: Vec<Outcome> =
        lost.iter().filter_map(|case| Some(case.lost(&how(case)?, 0.0))).collect();
    outcomes.iter().for_each(|outcome| print_row(outcome, width));
    let limits = Limits::from_releases(&history::releases(&history::folder()));
    let parent = parent_id();
    let running = |names: &[&str]| {
        if parent_id() != parent {
            return Err(io::Error::other("the process that started the suite has ended"));
        }
        if state.running == names {
            return Ok(());
        }
        state.running = names.iter().map(|&name| name.to_owned()).collect();
        state.write(path)
    };
    outcomes
        .extend(pool::execute(&sound, options.jobs, &limits, running, |outcome| print_row(outcome, width))?);
    Ok(outcomes)
}

fn suite(options: &Options, state: &Path) -> Result<Summary, Box<dyn Error>> {
    let start = Instant::now();
    let chosen = Selection { full: options.full, glob: options.case.clone() }.select(cases::ALL)?;
    if options.full {
        let forecast = history::forecast(&history::releases(&history::folder()), &chosen);
        printing::out(format_args!("{} cases: {forecast}\n", chosen.len()));
    }
    let width = chosen.iter().map(|case| case.name.len()).max().unwrap_or(0);
    printing::out(format_args!("{:width$}   hold  disagree  not covered   loose  near     time\n", "case"));
    let outcomes = run(&chosen, options, state, width)?;
    let run = Provenance::gather(options.full, options.tested, start.elapsed().as_secs_f64());
    report::write(&options.out, &outcomes, &run)?;
    if let Some(path) = &options.junit {
        report::put(path, &junit::document(&outcomes))?;
    }
    if let Some(tag) = &options.keep {
        report::keep(&history::folder().join(format!("{tag}.json")), tag, &outcomes, &run)?;
    }
    let summary = Summary::from_outcomes(&outcomes);
    printing::out(format_args!("\n"));
    printing::out(format_args!("report: {}\n", options.out.join("index.html").display()));
    if !summary.remarks().is_empty() {
        printing::out(format_args!("{}\n", summary.remarks()));
    }
    let read = numbers::all()?;
    let unknown: Vec<String> = read.iter().flat_map(|number| number.unknown(&outcomes)).collect();
    if !unknown.is_empty() {
        return Err(
            format!("verification/numbers.toml: no claim has the name\n  {}", unknown.join("\n  ")).into()
        );
    }
    let without = read.iter().filter(|number| number.held(&outcomes).is_empty()).count();
    printing::out(format_args!(
        "numbers in files: {} with evidence, {without} without\n",
        read.len() - without
    ));
    printing::out(format_args!("{summary}\n"));
    State { ended: true, ..State::default() }.write(state)?;
    Ok(summary)
}

fn print_row(outcome: &Outcome, width: usize) {
    let s = Summary::from_claims(&outcome.record.claims);
    printing::out(format_args!(
        "{:width$} {:>6} {:>9} {:>12} {:>7} {:>5} {:>7.2} s\n",
        outcome.case.name, s.hold, s.disagree, s.not_covered, s.slack_unexplained, s.thin, outcome.wall
    ));
    for judged in outcome.record.claims.iter().filter(|judged| judged.verdict == Verdict::Disagrees) {
        let size = judged
            .measured
            .map_or(String::new(), |m| format!(" (error {:.3e}, bound {:.3e})", m.error, m.bound));
        printing::out(format_args!(
            "  disagrees: {}: {}{size}\n",
            judged.claim.quantity,
            judged.problem.as_deref().unwrap_or("")
        ));
    }
}
