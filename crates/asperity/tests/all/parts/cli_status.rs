use asperity::cli::begin::{LOCK, REPORT};
use asperity::cli::status::*;
use asperity_output::terminal::progress::{self, Record, RunState};
use jiff::Timestamp;
use std::fs::File;
use std::path::Path;

/// Directory of a run with this status, with its progress.
fn folder(status: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let report = serde_json::json!({ "title": "t", "kind": "faults", "status": status, "run": {},
        "outcome": { "stopped": { "reason": "no state" } } });
    std::fs::write(folder.path().join(REPORT), report.to_string()).unwrap();
    let record = Record {
        fraction: 0.25,
        now: RunState { time: 1.0, end: 4.0, ..RunState::default() },
        seconds: 3.0,
        seconds_left: Some(9.0),
        bytes: None,
        written: Timestamp::now().to_string(),
    };
    std::fs::write(folder.path().join(progress::FILE), serde_json::to_vec(&record).unwrap()).unwrap();
    folder
}

#[test]
fn a_run_that_holds_its_lock_is_running_and_without_it_was_killed() {
    let folder = folder("running");
    assert_eq!(known(folder.path()).unwrap().state, State::Killed);
    let lock = File::create(folder.path().join(LOCK)).unwrap();
    lock.try_lock().unwrap();
    let known = known(folder.path()).unwrap();
    assert_eq!((known.state, known.resumable), (State::Running, false));
    let text = text(&known);
    assert!(text.contains("25.0 %") && text.contains("about 9 s left"), "{text}");
}

#[test]
fn the_end_of_a_run_is_that_of_its_report() {
    let stopped = known(folder("stopped").path()).unwrap();
    assert_eq!((stopped.state, stopped.reason.as_deref()), (State::Stopped, Some("no state")));
    assert!(!text(&stopped).contains("left"));
    assert_eq!(known(folder("completed").path()).unwrap().state, State::Completed);
    assert!(known(Path::new("nowhere")).is_err());
}
