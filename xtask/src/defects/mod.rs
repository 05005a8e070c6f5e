//! Planted defects: each is applied to a copy of the tree, which is then built and verified. A claim should detect it.

mod definition;
mod files;
mod outcome;
mod together;
mod tree;

pub use definition::{Defect, FOLDER};
pub use outcome::{Outcome, RESULTS, Results};

use crate::stage::{Failure, announce};
use files::{copy, failed, read, write};
use outcome::Status;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use together::Together;

/// Folder of the copy and its binaries.
const PLACE: &str = "target/defects";
/// Time after which a build or the quick suite is killed: four times what the suite takes.
const LONGEST: Duration = Duration::from_secs(1800);
/// Time after which a quick case is killed: four times what the longest takes without a defect, where its own code is not optimised.
const LONGEST_CASE: Duration = Duration::from_secs(600);
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

/// Applies the defects and prints the claims that detect them. Each result is stored in [`RESULTS`] at once, so that an
/// interrupted run can resume.
pub fn run(root: &Path, choice: &Choice) -> Result<(), Failure> {
    let chosen = |defect: &Defect| choice.only.as_ref().is_none_or(|part| defect.name.contains(part));
    let defects: Vec<Defect> = Defect::all(root)?.into_iter().filter(chosen).collect();
    if choice.list {
        return list(root, &defects);
    }
    let workshop = Workshop::open(root, choice)?;
    let mut due = Vec::new();
    for defect in &defects {
        if choice.again || due_because(root, defect)?.is_some() {
            due.push(defect);
        }
    }
    // Tests are built for one defect at a time.
    let alone = if choice.tests || due.len() < 2 { due } else { workshop.make_together(&due)? };
    workshop.make_alone(&alone)?;
    summarise(root, &defects)
}

/// Prints the results of the defects.
fn summarise(root: &Path, defects: &[Defect]) -> Result<(), Failure> {
    let results = Results::read(root)?;
    let outcome = |defect: &Defect| results.get(&defect.name).cloned().unwrap_or_default();
    for defect in defects {
        println!("{:45} {}", defect.name, outcome(defect).words());
    }
    let (noticed, missed): (Vec<_>, Vec<_>) = defects.iter().partition(|d| outcome(d).is_noticed());
    println!("\ndefects: {} of {} noticed by a claim", noticed.len(), defects.len());
    for defect in missed {
        println!("  not noticed: {} ({})", defect.name, defect.wrong);
    }
    Ok(())
}

/// Reason to make a defect again: it has no result that noticed it, or a file that it touches has changed since.
fn due_because(root: &Path, defect: &Defect) -> Result<Option<&'static str>, Failure> {
    Ok(match Results::read(root)?.get(&defect.name) {
        None => Some("no result"),
        Some(outcome) if !outcome.is_noticed() => Some("not noticed"),
        Some(outcome) if outcome.files != tree::files(root, defect)? => Some("stale"),
        Some(_) => None,
    })
}

/// Prints the defects that the next run would make, and why.
fn list(root: &Path, defects: &[Defect]) -> Result<(), Failure> {
    let mut due = 0;
    for defect in defects {
        if let Some(why) = due_because(root, defect)? {
            due += 1;
            println!("{:60} {why}", defect.name);
        }
    }
    println!("\ndefects: {due} of {} to be run", defects.len());
    Ok(())
}

/// Defect of a run of the suite, and the folder of its report.
struct Trial<'a> {
    /// Defect among those of the build; `None` without one.
    chosen: Option<&'a str>,
    /// Folder of the report, which no other run has at the same time.
    report: &'a str,
}

/// The copy of a tree in which defects are made, and where their results go.
struct Workshop<'a> {
    root: &'a Path,
    choice: &'a Choice,
    place: PathBuf,
    /// Commit and hash of the tree.
    commit: String,
    tree: String,
    /// Held while the results are changed.
    results: Mutex<()>,
}

impl<'a> Workshop<'a> {
    fn open(root: &'a Path, choice: &'a Choice) -> Result<Self, Failure> {
        let place = root.join(PLACE);
        copy(root, &place.join("tree"))?;
        let (commit, tree) = (commit(root)?, tree::hash(root)?);
        Ok(Self { root, choice, place, commit, tree, results: Mutex::new(()) })
    }

    /// Makes defects in one build, and returns those that have to be made alone.
    fn make_together<'d>(&self, defects: &[&'d Defect]) -> Result<Vec<&'d Defect>, Failure> {
        let tree = self.place.join("tree");
        let sound = Together::new(&tree, defects, defects.iter().map(|d| d.name.clone()).collect())?;
        let mut alone = BTreeSet::new();
        loop {
            announce(&format!("defects: {} in one build", defects.len() - alone.len()));
            let together = Together::new(&tree, defects, alone)?;
            together.write(&tree)?;
            let built = build(&self.place).arg("--message-format=short").stderr(Stdio::piped()).output();
            sound.write(&tree)?;
            let built = built.map_err(|source| Failure::Start { program: "cargo".into(), source })?;
            alone = together.alone.clone();
            if built.status.success() {
                break;
            }
            let blamed = together.blamed(&String::from_utf8_lossy(&built.stderr));
            if blamed.is_empty() {
                // The compiler blames no defect: each is made alone, which tells more.
                return Ok(defects.to_vec());
            }
            alone.extend(blamed);
        }
        let (apart, here): (Vec<_>, Vec<_>) = defects.iter().partition(|d| alone.contains(&d.name));
        let unsound = self.without(&here)?;
        let sound = here.into_iter().filter(|d| !d.expected.iter().any(|case| unsound.contains(case)));
        self.each(&sound.collect::<Vec<_>>())?;
        if let Some(case) = unsound.first() {
            let reason = format!("{} cases disagree without a defect, such as `{case}`", unsound.len());
            return Err(Failure::Defect { name: "none".into(), reason });
        }
        Ok(apart)
    }

    /// Runs the cases of the defects without any. Returns those in which not every claim holds, which can show no defect.
    fn without(&self, defects: &[&Defect]) -> Result<BTreeSet<String>, Failure> {
        announce("defects: the cases without a defect");
        let cases: BTreeSet<&String> = defects.iter().flat_map(|d| &d.expected).collect();
        let unsound = Mutex::new(BTreeSet::new());
        two_at_a_time(cases.into_iter(), |case| {
            let mut outcome = Outcome::default();
            self.suite(&Trial { chosen: None, report: case }, Some(case), &mut outcome)?;
            if outcome.is_noticed() || outcome.status != Status::Ran {
                println!("{case:45} disagrees without a defect");
                unsound.lock().unwrap_or_else(PoisonError::into_inner).insert(case.clone());
            }
            Ok(())
        })?;
        Ok(unsound.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// Verifies defects that are in the build.
    fn each(&self, defects: &[&Defect]) -> Result<(), Failure> {
        two_at_a_time(defects.iter(), |defect| {
            let outcome = self.verify(defect, Some(&defect.name))?;
            self.keep(defect, outcome)
        })
    }

    /// Makes defects one after the other, each in a build of its own.
    fn make_alone(&self, defects: &[&Defect]) -> Result<(), Failure> {
        if defects.is_empty() {
            return Ok(());
        }
        announce("defects: the tree without defect");
        // If the tree does not build without a defect, the compiler's messages say why.
        if !ends_well(build(&self.place).stderr(Stdio::inherit()))? {
            return Err(Failure::Defect { name: "none".into(), reason: "the tree does not build".into() });
        }
        for defect in defects {
            announce(&format!("defect: {}", defect.name));
            let outcome = self.make(defect)?;
            self.keep(defect, outcome)?;
        }
        Ok(())
    }

    /// Applies a defect to the copy, builds and verifies it, and reverts it.
    fn make(&self, defect: &Defect) -> Result<Outcome, Failure> {
        let tree = self.place.join("tree");
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
        let outcome = if ends_well(&mut build(&self.place))? {
            self.verify(defect, None)
        } else {
            Ok(Outcome { status: Status::DoesNotBuild, ..Outcome::default() })
        };
        // In reverse order: if a file has two changes, the text saved before the first is the original.
        for (path, text) in sound.iter().rev() {
            write(path, text)?;
        }
        outcome
    }

    /// Stores the result of a defect.
    fn keep(&self, defect: &Defect, outcome: Outcome) -> Result<(), Failure> {
        let outcome = Outcome {
            commit: self.commit.clone(),
            tree: self.tree.clone(),
            files: tree::files(self.root, defect)?,
            ..outcome
        };
        println!("{:45} {}", defect.name, outcome.words());
        let _held = self.results.lock();
        Results::read(self.root)?.with(&defect.name, outcome).write(self.root)
    }

    /// Runs the cases that the defect names. If these do not detect it, the quick suite follows.
    fn verify(&self, defect: &Defect, chosen: Option<&str>) -> Result<Outcome, Failure> {
        let mut outcome = Outcome::default();
        let trial = Trial { chosen, report: &defect.name };
        for case in &defect.expected {
            self.suite(&trial, Some(case), &mut outcome)?;
            outcome.cases.push(case.clone());
        }
        if !outcome.is_noticed() && !self.choice.expected {
            self.suite(&trial, None, &mut outcome)?;
            outcome.cases.clear();
        }
        if self.choice.tests {
            outcome.tests = Some(failing_tests(&self.place)?);
        }
        Ok(outcome)
    }

    /// Runs a case, or all quick ones, in the copy.
    fn suite(&self, trial: &Trial<'_>, case: Option<&str>, outcome: &mut Outcome) -> Result<(), Failure> {
        let report = self.place.join("report").join(trial.report);
        let results = report.join("report.json");
        // A run that writes no report must not pass for the run before.
        if results.exists() {
            std::fs::remove_file(&results).map_err(failed(&results))?;
        }
        let mut suite = Command::new(self.place.join("build/release/asperity-verification"));
        suite.current_dir(self.place.join("tree")).arg("--out").arg(&report);
        suite.stdout(Stdio::null()).stderr(Stdio::null()).env_remove(together::VARIABLE);
        if let Some(name) = trial.chosen {
            suite.env(together::VARIABLE, name);
        }
        if let Some(case) = case {
            suite.args(["--case", case]);
        }
        if ends(&mut suite, if case.is_some() { LONGEST_CASE } else { LONGEST })?.is_none() {
            outcome.status = Status::DoesNotEnd;
            return Ok(());
        }
        outcome.add(&results)
    }
}

/// Does the work on all items, two at a time: cases use one thread for the most part. The first failure ends it.
fn two_at_a_time<T: Send>(
    items: impl Iterator<Item = T> + Send,
    work: impl Fn(T) -> Result<(), Failure> + Sync,
) -> Result<(), Failure> {
    let queue = Mutex::new(items);
    let next = || queue.lock().ok().and_then(|mut queue| queue.next());
    let take = || -> Result<(), Failure> {
        while let Some(item) = next() {
            work(item)?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(take);
        let own = take();
        own.and(other.join().unwrap_or(Ok(())))
    })
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
        "profile.release.package.asperity-plan.opt-level=1",
        "profile.release.package.asperity.opt-level=1",
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
