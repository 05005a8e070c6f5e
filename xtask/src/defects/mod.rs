//! Planted defects: each is applied to a copy of the tree, which is then built and verified. A claim should detect it.

mod definition;
mod outcome;
mod tree;

pub use definition::{Defect, FOLDER};
pub use outcome::{Outcome, RESULTS, Results};

use crate::stage::{Failure, announce};
use outcome::Status;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use walkdir::WalkDir;

/// Folder of the copy and its binaries.
const PLACE: &str = "target/defects";
/// Time after which a build or the quick suite is killed: four times what the suite takes.
const LONGEST: Duration = Duration::from_secs(1800);
/// Time after which a quick case is killed: four times what the longest takes without a defect.
const LONGEST_CASE: Duration = Duration::from_secs(240);
/// Polling interval of a running command.
const LOOK: Duration = Duration::from_millis(200);

/// Choice of defects and of the runs.
pub struct Choice {
    /// Part of the names of the defects; all if absent.
    pub only: Option<String>,
    /// True to run only the cases that a defect names, even if these do not detect it.
    pub expected: bool,
    /// True to run the tests of the workspace as well.
    pub tests: bool,
    /// True to rerun defects that were detected before.
    pub again: bool,
    /// True to list the defects whose results are missing or stale, and to run nothing.
    pub list: bool,
}

/// Applies the defects one after the other and prints the claims that detect them. Each result is stored in [`RESULTS`]
/// at once, so that an interrupted run can resume.
pub fn run(root: &Path, choice: &Choice) -> Result<(), Failure> {
    let chosen = |defect: &Defect| choice.only.as_ref().is_none_or(|part| defect.name.contains(part));
    let defects: Vec<Defect> = Defect::all(root)?.into_iter().filter(chosen).collect();
    if choice.list {
        return list(root, &defects);
    }
    let place = root.join(PLACE);
    let commit = commit(root)?;
    copy(root, &place.join("tree"))?;
    announce("defects: the tree without defect");
    // If the tree does not build without a defect, the compiler's messages say why.
    if !ends_well(build(&place).stderr(Stdio::inherit()))? {
        return Err(Failure::Defect { name: "none".into(), reason: "the tree does not build".into() });
    }
    let mut found = Vec::new();
    let tree = tree::hash(root)?;
    for defect in defects {
        let files = tree::files(root, &defect)?;
        let known = Results::read(root)?.take(&defect.name);
        let known = known.filter(|o| o.is_noticed() && o.files == files && !choice.again);
        let outcome = match known {
            Some(outcome) => outcome,
            None => {
                announce(&format!("defect: {}", defect.name));
                let outcome = Outcome {
                    commit: commit.clone(),
                    tree: tree.clone(),
                    files,
                    ..plant(&place, &defect, choice)?
                };
                Results::read(root)?.with(&defect.name, outcome.clone()).write(root)?;
                outcome
            }
        };
        println!("{:45} {}", defect.name, outcome.words());
        found.push((defect, outcome));
    }
    let noticed = found.iter().filter(|(_, outcome)| outcome.is_noticed()).count();
    println!("\ndefects: {noticed} of {} noticed by a claim", found.len());
    for (defect, _) in found.iter().filter(|(_, outcome)| !outcome.is_noticed()) {
        println!("  not noticed: {} ({})", defect.name, defect.wrong);
    }
    Ok(())
}

/// Prints the defects that the next run would plant: those without a result that noticed them, and those of which a file has
/// changed since.
fn list(root: &Path, defects: &[Defect]) -> Result<(), Failure> {
    let results = Results::read(root)?;
    let mut due = 0;
    for defect in defects {
        let why = match results.get(&defect.name) {
            None => "no result",
            Some(outcome) if !outcome.is_noticed() => "not noticed",
            Some(outcome) if outcome.files != tree::files(root, defect)? => "stale",
            Some(_) => continue,
        };
        due += 1;
        println!("{:60} {why}", defect.name);
    }
    println!("\ndefects: {due} of {} to be run", defects.len());
    Ok(())
}

/// Applies a defect to the copy, builds and verifies it, and reverts it.
fn plant(place: &Path, defect: &Defect, choice: &Choice) -> Result<Outcome, Failure> {
    let tree = place.join("tree");
    let mut sound = Vec::new();
    for change in &defect.change {
        let path = tree.join(&change.file);
        let text = read(&path)?;
        let changed = change.applied(&text).ok_or_else(|| Failure::Defect {
            name: defect.name.clone(),
            reason: format!("its old text does not occur exactly once in {}", change.file),
        })?;
        write(&path, &changed)?;
        sound.push((path, text));
    }
    let outcome = verify(place, defect, choice);
    // In reverse order: if a file has two changes, the text saved before the first is the original.
    for (path, text) in sound.iter().rev() {
        write(path, text)?;
    }
    outcome
}

/// Builds the copy and runs the cases that the defect names. If these do not detect it, the quick suite follows.
fn verify(place: &Path, defect: &Defect, choice: &Choice) -> Result<Outcome, Failure> {
    let mut outcome = Outcome::default();
    if !ends_well(&mut build(place))? {
        outcome.status = Status::DoesNotBuild;
        return Ok(outcome);
    }
    for case in &defect.expected {
        suite(place, Some(case), &mut outcome)?;
        outcome.cases.push(case.clone());
    }
    if !outcome.is_noticed() && !choice.expected {
        suite(place, None, &mut outcome)?;
        outcome.cases.clear();
    }
    if choice.tests {
        outcome.tests = Some(failing_tests(place)?);
    }
    Ok(outcome)
}

/// Runs a case, or all quick ones, in the copy.
fn suite(place: &Path, case: Option<&str>, outcome: &mut Outcome) -> Result<(), Failure> {
    let report = place.join("report");
    let results = report.join("report.json");
    // A run that writes no report must not pass for the run before.
    if results.exists() {
        std::fs::remove_file(&results).map_err(failed(&results))?;
    }
    let mut suite = Command::new(place.join("build/release/asperity-verification"));
    suite.current_dir(place.join("tree")).arg("--out").arg(&report).stdout(Stdio::null());
    if let Some(case) = case {
        suite.args(["--case", case]);
    }
    if ends(&mut suite, if case.is_some() { LONGEST_CASE } else { LONGEST })?.is_none() {
        outcome.status = Status::DoesNotEnd;
        return Ok(());
    }
    outcome.add(&results)
}

/// Names of the tests of the workspace that fail in the copy.
fn failing_tests(place: &Path) -> Result<Vec<String>, Failure> {
    let output = cargo(place, &["test", "--workspace", "--no-fail-fast"])
        .output()
        .map_err(|source| Failure::Start { program: "cargo".into(), source })?;
    let text = String::from_utf8_lossy(&output.stdout);
    let failed = |line: &str| Some(line.strip_prefix("test ")?.strip_suffix(" ... FAILED")?.to_owned());
    Ok(text.lines().filter_map(failed).collect())
}

fn build(place: &Path) -> Command {
    let mut cargo = cargo(place, &["build", "--quiet", "-p", "asperity-verification"]);
    cargo.stdout(Stdio::null()).stderr(Stdio::null());
    cargo
}

/// Cargo in the copy, with the profile that rebuilds fastest after a change.
fn cargo(place: &Path, arguments: &[&str]) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(place.join("tree"));
    cargo.env("CARGO_TARGET_DIR", place.join("build")).env("CARGO_INCREMENTAL", "1");
    cargo.args(arguments).arg("--release");
    for setting in [
        "profile.release.incremental=true",
        "profile.release.package.asperity-driver.opt-level=1",
        "profile.release.package.asperity-verification.opt-level=0",
    ] {
        cargo.args(["--config", setting]);
    }
    cargo
}

/// Commit of the sources, with `+` if they have uncommitted changes.
fn commit(root: &Path) -> Result<String, Failure> {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").current_dir(root).args(arguments).output();
        output.map_err(|source| Failure::Start { program: "git".into(), source })
    };
    let hash = git(&["rev-parse", "--short=12", "HEAD"])?;
    let changed =
        git(&["status", "--porcelain", "--untracked-files=no", "--", "crates", "verification/cases"])?;
    let mark = if changed.stdout.is_empty() { "" } else { "+" };
    Ok(format!("{}{mark}", String::from_utf8_lossy(&hash.stdout).trim()))
}

fn ends_well(command: &mut Command) -> Result<bool, Failure> {
    Ok(ends(command, LONGEST)? == Some(true))
}

/// True if the command succeeds; `None` if it was killed at the time limit.
fn ends(command: &mut Command, longest: Duration) -> Result<Option<bool>, Failure> {
    let program = command.get_program().to_string_lossy().into_owned();
    let mut child = command.spawn().map_err(|source| Failure::Start { program, source })?;
    let begun = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(Some(status.success())),
            Ok(None) if begun.elapsed() < longest => std::thread::sleep(LOOK),
            Ok(None) | Err(_) => {
                // Killing a child that has just ended fails, which does no harm.
                let _ = child.kill();
                let _ = child.wait();
                return Ok(None);
            }
        }
    }
}

/// Copies the sources. Unchanged files keep their times, so that little is rebuilt.
fn copy(from: &Path, to: &Path) -> Result<(), Failure> {
    let skipped = |name: &str, depth| name == ".git" || depth == 1 && (name == "target" || name == "out");
    let walk = WalkDir::new(from).sort_by_file_name().into_iter();
    for entry in walk.filter_entry(|e| !skipped(&e.file_name().to_string_lossy(), e.depth())) {
        let entry = entry?;
        let path = entry.path();
        let target = to.join(path.strip_prefix(from).unwrap_or(path));
        if entry.file_type().is_dir() {
            create(&target)?;
        } else if entry.file_type().is_file() {
            let bytes = std::fs::read(path).map_err(failed(path))?;
            if std::fs::read(&target).ok().as_ref() != Some(&bytes) {
                std::fs::write(&target, &bytes).map_err(failed(&target))?;
            }
        }
    }
    Ok(())
}

fn failed(path: &Path) -> impl Fn(std::io::Error) -> Failure {
    let path = PathBuf::from(path);
    move |source| Failure::Read { path: path.clone(), source }
}

fn create(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(failed(folder))
}

fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(failed(path))
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text).map_err(failed(path))
}
