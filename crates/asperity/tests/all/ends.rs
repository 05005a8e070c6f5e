//! Ends of every kind of run before its time: by signals, the limit of wall time, and a full disk. Each leaves its exit code, a report, a page and a
//! checkpoint, keeps the result before it, and resumed leaves the files of a run left alone.
#![allow(clippy::disallowed_methods)]
#![cfg(unix)]

use crate::common::{SANDWICH, told, varied};
use crate::resume::{assert_same, files, folder, run, text};
use asperity_vary::Change::{Add, With};
use serde_json::Value;
use std::fs;
use std::os::unix::process::ExitStatusExt as _;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Kinds of runs, with scenes that take some seconds, and a table that grows by each step.
pub fn kinds() -> [(&'static str, String, &'static str); 4] {
    let bodies = varied(
        SANDWICH,
        &[
            With("bodies.A.mesh.block.size", "5 mm"),
            With("bodies.B.mesh.block.size", "5 mm"),
            With("time.tolerance", "0.0005 nm"),
        ],
    );
    let faults = varied(
        crate::common::cycles::SCENE,
        &[With("events.stop_after", "20"), Add("time.log_rate_tolerance", "1e-6")],
    );
    let dynamics = varied(
        crate::dynamic::SCENE,
        &[With("bodies.A.mesh.fault.spacing", "100 m"), With("stages[0].duration", "30 s")],
    );
    [
        ("bodies", bodies, "probes/fault.csv"),
        ("faults", faults, "largest_rate.csv"),
        ("sliders", sliders(), "history/block.csv"),
        ("dynamics", dynamics, "energy.csv"),
    ]
}

/// A slider whose load point changes its rate often: the integration restarts there.
fn sliders() -> String {
    let rate = |k: usize| if k.is_multiple_of(2) { "1 um/s" } else { "2 um/s" };
    let piece = |k: usize| format!(r#"["{} s", "{1}"], ["{2} s", "{1}"]"#, 500 * k, rate(k), 500 * (k + 1));
    let table: Vec<String> = (0..60).map(piece).collect();
    varied(
        include_str!("../../../../scenes/spring-slider.toml"),
        &[
            With("load.rate", &format!("{{ table = [{}] }}", table.join(", "))),
            With("time.end", "30000 s"),
            With("events.stop_after", "1000"),
            Add("time.tolerance", "1e-11"),
        ],
    )
}

/// Ways in which runs end before their time.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// A signal, by the name that `kill` gives it.
    Signal(&'static str),
    Wall,
    /// The largest size of a file \[bytes\], as a full disk.
    Full(u64),
    /// SIGKILL, of which no process learns.
    Killed,
}

pub const OFTEN: [&str; 2] = ["--checkpoint-every", "0 s"];

/// Begins a run; beyond `most` bytes no file may grow.
pub fn start(folder: &Path, out: &str, arguments: &[&str], most: Option<u64>) -> Child {
    // POSIX counts in blocks of 512 bytes.
    let limit = most.map_or("unlimited".into(), |most| (most / 512).to_string());
    let mut command = Command::new("sh");
    command.args(["-c", &format!("ulimit -f {limit}; exec \"$0\" \"$@\"")]);
    command.arg(env!("CARGO_BIN_EXE_asperity")).args(["run", "s.toml", "--out", out]).args(arguments);
    command.current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Waits until a checkpoint lies beside a table of at least this size.
pub fn under_way(child: &mut Child, out: &Path, table: &str, size: u64) {
    let begin = Instant::now();
    let large = || fs::metadata(out.join(table)).map_or(0, |data| data.len()) >= size;
    // The result before may still stand there.
    let own = || fs::read_to_string(out.join("report.json")).is_ok_and(|text| text.contains("\"running\""));
    while !own() || !large() || !out.join("checkpoint").exists() {
        assert!(child.try_wait().unwrap().is_none(), "the run has ended");
        assert!(begin.elapsed() < Duration::from_secs(300), "the run does not get on");
    }
}

/// Ends a run in `out` in this way. The table has `size` bytes at the end.
fn end(folder: &Path, out: &str, (table, size): (&str, u64), way: Way) -> Output {
    match way {
        Way::Wall => run(folder, out, &["--wall-time", "0.05 s"]),
        Way::Full(most) => start(folder, out, &OFTEN, Some(most)).wait_with_output().unwrap(),
        Way::Signal(name) => stopped(folder, out, (table, size), name),
        Way::Killed => stopped(folder, out, (table, size), "KILL"),
    }
}

fn stopped(folder: &Path, out: &str, (table, size): (&str, u64), signal: &str) -> Output {
    let mut child = start(folder, out, &OFTEN, None);
    under_way(&mut child, &folder.join(out), table, size / 10);
    let sent = Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
    child.wait_with_output().unwrap()
}

fn report(out: &Path) -> Value {
    serde_json::from_slice(&fs::read(out.join("report.json")).unwrap()).unwrap()
}

/// Copies a directory of results, so that a run finds one before it.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let (from, to) = (entry.path(), to.join(entry.file_name()));
        if from.is_dir() {
            copy(&from, &to);
        } else {
            fs::copy(from, to).unwrap();
        }
    }
}

/// Asserts that a run which has ended in some way leaves all that it should.
fn assert_left(out: &Path, output: &Output, way: Way) {
    if let Way::Killed = way {
        assert_eq!(output.status.signal(), Some(9));
        assert_eq!(report(out)["status"], "running");
        return;
    }
    let said = told(output);
    assert_eq!(output.status.code(), Some(3), "{said}");
    let why = match way {
        Way::Full(_) => "no room to write: ",
        Way::Wall => "its wall time is over",
        _ => "a signal asked for it",
    };
    assert!(said.contains("interrupted: ") && said.contains(why) && said.contains("--resume"), "{said}");
    let report = report(out);
    assert_eq!(report["status"], "interrupted", "{said}");
    assert!(report.to_string().contains(why), "{report}");
    assert!(fs::read_to_string(out.join("report.html")).unwrap().contains(why));
    for name in [".reserve", ".report.json.tmp"] {
        assert!(!out.join(name).exists(), "{name}");
    }
}

/// Ends runs of one kind in every way.
fn every_way(kind: &str) {
    let (_, scene, table) = kinds().into_iter().find(|(name, ..)| *name == kind).unwrap();
    let folder = folder(&scene);
    let folder = folder.path();
    let whole = run(folder, "whole", &[]);
    assert!(whole.status.success(), "{}", told(&whole));
    let size = fs::metadata(folder.join("whole").join(table)).unwrap().len();
    for (out, way) in [
        ("int", Way::Signal("INT")),
        ("term", Way::Signal("TERM")),
        ("wall", Way::Wall),
        ("full", Way::Full(size / 2)),
        ("killed", Way::Killed),
    ] {
        let path = folder.join(out);
        copy(&folder.join("whole"), &path);
        let output = end(folder, out, (table, size), way);
        assert_left(&path, &output, way);
        assert!(path.join("checkpoint").is_file(), "{way:?}");
        // Without `--resume` it is refused, and nothing changes.
        let (before, refused) = (files(&path), run(folder, out, &[]));
        assert_eq!(refused.status.code(), Some(1), "{way:?}");
        assert!(told(&refused).contains("resume it with --resume"), "{}", told(&refused));
        assert!(files(&path) == before, "{way:?}");
        let resumed = run(folder, out, &["--resume"]);
        assert!(resumed.status.success(), "{way:?}: {}", told(&resumed));
        assert!(text(&resumed.stdout).contains("resumed "), "{way:?}: {}", text(&resumed.stdout));
        assert_same(folder, out);
        assert_same(folder, &format!("{out}.previous"));
    }
}

#[test]
fn runs_of_bodies_end_in_every_way_and_resume() {
    every_way("bodies");
}

#[test]
fn runs_of_faults_end_in_every_way_and_resume() {
    every_way("faults");
}

#[test]
fn runs_of_sliders_end_in_every_way_and_resume() {
    every_way("sliders");
}

#[test]
fn runs_of_bodies_with_mass_end_in_every_way_and_resume() {
    every_way("dynamics");
}

#[test]
fn a_run_without_room_before_its_first_checkpoint_says_that_nothing_can_be_resumed() {
    for (kind, scene, _) in kinds() {
        let folder = folder(&scene);
        let folder = folder.path();
        assert!(run(folder, "out", &["--no-plots"]).status.success(), "{kind}");
        let before = files(&folder.join("out"));
        let arguments = ["--checkpoint-every", "1 h"];
        let output = start(folder, "out", &arguments, Some(131_072)).wait_with_output().unwrap();
        let said = told(&output);
        assert_eq!(output.status.code(), Some(2), "{kind}: {said}");
        assert!(
            said.contains("stopped: no room to write: ") && said.contains("nothing can be resumed"),
            "{said}"
        );
        let report = report(&folder.join("out"));
        assert_eq!(report["status"], "stopped", "{kind}");
        assert!(report["reason"].as_str().unwrap().contains("nothing can be resumed"), "{kind}: {report}");
        assert!(folder.join("out/report.html").is_file(), "{kind}");
        assert!(!folder.join("out/checkpoint").exists(), "{kind}");
        // What it left is no result: the next run replaces it, and not the result before.
        let output = run(folder, "out", &["--wall-time", "0 s"]);
        assert_eq!(output.status.code(), Some(3), "{kind}: {}", told(&output));
        assert!(files(&folder.join("out.previous")) == before, "{kind}");
    }
}

#[test]
fn a_run_that_finds_no_room_at_its_start_leaves_the_result_before_where_it_was() {
    let folder = folder(&sliders());
    let folder = folder.path();
    assert!(run(folder, "out", &["--no-plots"]).status.success());
    let before = files(&folder.join("out"));
    // No room for the report, and room for the report but not for what is kept for the end.
    for most in [0, 4096] {
        let output = start(folder, "out", &[], Some(most)).wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{}", told(&output));
        assert!(told(&output).contains("File too large"), "{}", told(&output));
        assert!(files(&folder.join("out")) == before, "{most}");
        assert!(!folder.join("out.previous").exists(), "{most}");
    }
}

#[test]
fn a_run_whose_last_files_cannot_be_written_resumes_at_its_last_checkpoint() {
    for (kind, scene, table) in kinds() {
        let folder = folder(&scene);
        let folder = folder.path();
        let whole = run(folder, "whole", &[]);
        assert!(whole.status.success(), "{kind}: {}", told(&whole));
        let mut child = start(folder, "out", &OFTEN, None);
        under_way(&mut child, &folder.join("out"), table, 1);
        // What the figures need is written under this name at first.
        let obstacle = folder.join("out/.plots.json.tmp");
        fs::create_dir(&obstacle).unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{kind}: {}", told(&output));
        assert_eq!(report(&folder.join("out"))["status"], "interrupted", "{kind}");
        fs::remove_dir(obstacle).unwrap();
        let resumed = run(folder, "out", &["--resume"]);
        assert!(resumed.status.success(), "{kind}: {}", told(&resumed));
        assert!(text(&resumed.stdout).contains("resumed "), "{kind}: {}", text(&resumed.stdout));
        assert_same(folder, "out");
    }
}

#[test]
fn a_resumed_run_leaves_no_figures_and_no_page_of_its_interruption() {
    for (kind, scene, _) in kinds() {
        let folder = folder(&scene);
        let folder = folder.path();
        assert_eq!(run(folder, "out", &["--wall-time", "0.05 s"]).status.code(), Some(3), "{kind}");
        assert!(folder.join("out/plots").is_dir() && folder.join("out/report.html").is_file(), "{kind}");
        let arguments = ["--resume", "--no-plots", "--checkpoint-every", "0 s"];
        let mut child = start(folder, "out", &arguments, None);
        while folder.join("out/plots").exists() {
            assert!(child.try_wait().unwrap().is_none(), "{kind} has ended with its old figures");
        }
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!folder.join("out/plots").exists(), "{kind}");
    }
}
