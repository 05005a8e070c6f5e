//! The command `status`: how far the run in a directory is.

use super::begin::{LOCK, REPORT};
use super::end::End;
use super::json;
use crate::checkpoint;
use asperity_output::terminal::printing::out;
use asperity_output::terminal::progress::{self, Record, status as line};
use asperity_output::words::about;
use asperity_run::report::Status;
use jiff::Timestamp;
use miette::{IntoDiagnostic, WrapErr, miette};
use serde::{Deserialize, Serialize};
use std::fs::{File, TryLockError};
use std::path::Path;

/// Part of `report.json`.
#[derive(Deserialize)]
struct Report {
    title: String,
    kind: String,
    status: Status,
    pub reason: Option<String>,
    #[serde(default)]
    outcome: serde_json::Value,
    run: Run,
}

#[derive(Deserialize)]
struct Run {
    scene: Option<String>,
    started: Option<String>,
}

/// State of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// It holds the lock of its directory.
    Running,
    /// It ended without a report of its end.
    Killed,
    /// It ended with an error.
    Stopped,
    /// It ended early as asked, with a checkpoint.
    Interrupted,
    /// It reached its end.
    Completed,
}

/// Facts about the run in a directory.
#[derive(Serialize)]
pub struct RunStatus {
    /// State of the run.
    pub state: State,
    title: String,
    kind: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    started: Option<String>,
    /// Reason of the end of a stopped run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// True if `--resume` continues the run.
    pub resumable: bool,
    /// Time since the progress was written \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    age: Option<f64>,
    /// Progress as it was last written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub progress: Option<Record>,
}

/// Prints the state of the run in a directory.
pub(super) fn print(folder: &Path, as_json: bool) -> miette::Result<End> {
    let known = known(folder)?;
    if as_json {
        out(format_args!("{}\n", json::pretty(&known).into_diagnostic()?));
    } else {
        out(format_args!("{}: {}\n{}", folder.display(), word(known.state), text(&known)));
    }
    Ok(match known.state {
        State::Running | State::Completed => End::Done,
        State::Stopped => End::Stopped("the run could not continue".into()),
        State::Killed => End::Interrupted(after(&known, "the run was killed")),
        State::Interrupted => End::Interrupted(after(&known, "the run was interrupted")),
    })
}

/// Words with the advice for a run that can be resumed.
fn after(known: &RunStatus, words: &str) -> String {
    let advice = if known.resumable { "; its command with --resume continues it" } else { "" };
    format!("{words}{advice}")
}

fn word(state: State) -> &'static str {
    match state {
        State::Running => "running",
        State::Killed => "killed",
        State::Stopped => "stopped",
        State::Interrupted => "interrupted",
        State::Completed => "completed",
    }
}

/// Facts about the run in `folder`.
///
/// # Errors
/// If the directory holds no report that can be read.
pub fn known(folder: &Path) -> miette::Result<RunStatus> {
    let path = folder.join(REPORT);
    let bytes = std::fs::read(&path)
        .into_diagnostic()
        .wrap_err_with(|| format!("{} is not the output directory of a run", folder.display()))?;
    let report: Report = serde_json::from_slice(&bytes)
        .map_err(|error| miette!("{} is not the report of a run: {error}", path.display()))?;
    let record = std::fs::read(folder.join(progress::FILE)).ok();
    let record = record.and_then(|bytes| serde_json::from_slice::<Record>(&bytes).ok());
    let state = match report.status {
        Status::Running if is_held(folder) => State::Running,
        Status::Running => State::Killed,
        Status::Completed => State::Completed,
        Status::Stopped => State::Stopped,
        Status::Interrupted => State::Interrupted,
    };
    let within = report.outcome.as_object().into_iter().flat_map(|o| o.values());
    let reason = within.filter_map(|o| o["reason"].as_str()).next().map(str::to_string);
    let age = record.as_ref().and_then(|r| age(&r.written));
    Ok(RunStatus {
        state,
        title: report.title,
        kind: report.kind,
        scene: report.run.scene,
        started: report.run.started,
        reason: report.reason.or(reason),
        resumable: state != State::Completed && folder.join(checkpoint::FILE).exists(),
        age,
        progress: record,
    })
}

/// True if a run holds the lock of a directory. Without locks in the file system, a run that has no end is taken to be running.
fn is_held(folder: &Path) -> bool {
    let Ok(file) = File::open(folder.join(LOCK)) else { return false };
    match file.try_lock() {
        Ok(()) => false,
        Err(TryLockError::WouldBlock) => true,
        Err(TryLockError::Error(_)) => true,
    }
}

/// Time since an instant \[s\].
fn age(written: &str) -> Option<f64> {
    let written: Timestamp = written.parse().ok()?;
    Some(Timestamp::now().duration_since(written).as_secs_f64().max(0.0))
}

/// Text for people.
#[must_use]
pub fn text(known: &RunStatus) -> String {
    let mut text = format!("  {} ({})\n", known.title, known.kind);
    let origin = [("scene", &known.scene), ("begun", &known.started), ("reason", &known.reason)];
    for (name, value) in origin {
        if let Some(value) = value {
            text += &format!("  {name}: {value}\n");
        }
    }
    if let Some(record) = &known.progress {
        let left = record.seconds_left.filter(|_| known.state == State::Running);
        text += &format!("  {:.1} %: {}\n", 100.0 * record.fraction, line(&record.now, left));
        if let (State::Running, Some(age)) = (known.state, known.age) {
            text += &format!("  last update {} ago\n", about(age));
        }
        if let Some(bytes) = record.bytes {
            text += &format!("  memory: {:.0} MB\n", bytes as f64 / 1e6);
        }
    } else if known.state == State::Running {
        text += "  no step so far: planning or setting up\n";
    }
    text
}
