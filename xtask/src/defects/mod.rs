//! Planted defects: each is made in a copy of the tree, which is then built and verified. A claim should notice it.

mod definition;
mod outcome;

pub use definition::{Defect, FOLDER};

use crate::stage::{Failure, announce};
use outcome::{Outcome, Status};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use walkdir::WalkDir;

/// Folder of the copy, its binaries and the results.
const PLACE: &str = "target/defects";
/// Time after which a command in a copy with a defect is killed: the quick suite takes a quarter of it.
const LONGEST: Duration = Duration::from_secs(1800);
/// Interval of looks at a command.
const LOOK: Duration = Duration::from_millis(200);

/// Choice of defects and of what is run.
pub struct Choice {
    /// Part of the names of the defects; all where absent.
    pub only: Option<String>,
    /// Run only the cases that a defect names, instead of the quick suite.
    pub expected: bool,
    /// Run defects again that have a result.
    pub again: bool,
}

/// Makes the defects one after the other, and prints which claims notice them. Results are kept, so that a run that was interrupted resumes.
pub fn run(root: &Path, choice: &Choice) -> Result<(), Failure> {
    let place = root.join(PLACE);
    let tree = place.join("tree");
    let results = place.join("results");
    create(&results)?;
    copy(root, &tree)?;
    announce("defects: the tree without defect");
    if !ends_well(&mut build(&place))? {
        return Err(Failure::Defect { name: "none".into(), reason: "the tree does not build".into() });
    }
    let chosen = |defect: &Defect| choice.only.as_ref().is_none_or(|part| defect.name.contains(part));
    let mut found = Vec::new();
    for defect in Defect::all(root)?.into_iter().filter(chosen) {
        let file = results.join(format!("{}.json", defect.name));
        let known = Outcome::read(&file).filter(|_| !choice.again);
        let outcome = match known {
            Some(outcome) => outcome,
            None => {
                announce(&format!("defect: {}", defect.name));
                let outcome = plant(root, &place, &defect, choice.expected)?;
                outcome.write(&file)?;
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

/// Makes a defect in the copy, builds and verifies it, and takes it back.
fn plant(root: &Path, place: &Path, defect: &Defect, expected: bool) -> Result<Outcome, Failure> {
    let tree = place.join("tree");
    for change in &defect.change {
        let path = tree.join(&change.file);
        let text = read(&path)?;
        let changed = change.applied(&text).ok_or_else(|| Failure::Defect {
            name: defect.name.clone(),
            reason: format!("its old text does not occur exactly once in {}", change.file),
        })?;
        write(&path, &changed)?;
    }
    let outcome = verify(place, defect, expected);
    for change in &defect.change {
        write(&tree.join(&change.file), &read(&root.join(&change.file))?)?;
    }
    outcome
}

/// Builds the copy, and runs its quick suite or the cases the defect names.
fn verify(place: &Path, defect: &Defect, expected: bool) -> Result<Outcome, Failure> {
    if !ends_well(&mut build(place))? {
        return Ok(Outcome { status: Status::DoesNotBuild, noticed: Vec::new() });
    }
    let mut outcome = Outcome { status: Status::Ran, noticed: Vec::new() };
    let cases: Vec<Option<&str>> = match expected && !defect.expected.is_empty() {
        true => defect.expected.iter().map(|case| Some(case.as_str())).collect(),
        false => vec![None],
    };
    for case in cases {
        let report = place.join("report");
        let mut suite = Command::new(place.join("build/release/asperity-verification"));
        suite.current_dir(place.join("tree")).arg("--out").arg(&report).stdout(Stdio::null());
        if let Some(case) = case {
            suite.args(["--case", case]);
        }
        if ends(&mut suite)?.is_none() {
            outcome.status = Status::DoesNotEnd;
            continue;
        }
        outcome.add(&report.join("report.json"))?;
    }
    Ok(outcome)
}

fn build(place: &Path) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(place.join("tree"));
    cargo.env("CARGO_TARGET_DIR", place.join("build")).env("CARGO_INCREMENTAL", "1");
    cargo.args(["build", "--quiet", "--release", "-p", "asperity-verification"]);
    cargo.args(["--config", "profile.release.incremental=true"]);
    cargo.stdout(Stdio::null()).stderr(Stdio::null());
    cargo
}

fn ends_well(command: &mut Command) -> Result<bool, Failure> {
    Ok(ends(command)? == Some(true))
}

/// True if the command succeeds; none if it was killed because it took too long.
fn ends(command: &mut Command) -> Result<Option<bool>, Failure> {
    let program = command.get_program().to_string_lossy().into_owned();
    let mut child = command.spawn().map_err(|source| Failure::Start { program, source })?;
    let begun = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(Some(status.success())),
            Ok(None) if begun.elapsed() < LONGEST => std::thread::sleep(LOOK),
            Ok(None) | Err(_) => {
                // A child that has just ended cannot be killed, which does no harm.
                let _ = child.kill();
                let _ = child.wait();
                return Ok(None);
            }
        }
    }
}

/// Copies the sources; files that have not changed keep their times, so that little is built again.
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
