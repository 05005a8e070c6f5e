//! Output directories: one run per directory, with its state in the report, and no loss of results unless requested.
#![allow(clippy::disallowed_methods)]
#![cfg(unix)]

use crate::common::{SANDWICH, coarse_sandwich, told, varied};
use asperity_vary::Change::With;
use asperity_vary::SceneText;
use serde_json::Value;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const SLIDER: &str = include_str!("../../../../scenes/spring-slider.toml");

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, &[&["run"], arguments].concat()).output().unwrap()
}

fn succeeds(folder: &Path, arguments: &[&str]) {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", told(&output));
}

/// A run that is refused for these reasons, and changes nothing.
fn refused(folder: &Path, arguments: &[&str], parts: &[&str]) {
    let before = everything(folder);
    let output = run(folder, arguments);
    let told = told(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    for part in parts {
        assert!(told.contains(part), "{part} is not in\n{told}");
    }
    assert!(everything(folder) == before, "a refused run changed something");
}

/// All files below a folder, by path.
fn everything(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let (mut found, mut folders) = (Vec::new(), vec![folder.to_path_buf()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            // A lock is held, not written.
            if path.is_dir() {
                folders.push(path);
            } else if !path.ends_with(".lock") {
                found.push((path.clone(), fs::read(&path).unwrap()));
            }
        }
    }
    found.sort();
    found
}

fn report(directory: &Path) -> Value {
    serde_json::from_slice(&fs::read(directory.join("report.json")).unwrap()).unwrap()
}

fn scene(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), text).unwrap();
    folder
}

#[test]
fn running_a_scene_again_keeps_the_result_before_it() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    let mut hashes = Vec::new();
    for k in 0..3 {
        fs::write(folder.join("s.toml"), format!("{SLIDER}\n# change {k}\n")).unwrap();
        succeeds(folder, &["s.toml"]);
        let report = report(&folder.join("out/s"));
        assert_eq!(report["status"], "completed");
        assert!(report["run"]["scene"].as_str().unwrap().ends_with("s.toml"));
        hashes.push(report["scene_sha256"].clone());
        if k > 0 {
            assert_eq!(self::report(&folder.join("out/s.previous"))["scene_sha256"], hashes[k - 1]);
            assert!(folder.join("out/s.previous/history/block.csv").is_file());
        }
    }
    assert_eq!(fs::read_dir(folder.join("out")).unwrap().count(), 2);
}

#[test]
fn a_link_to_a_directory_stays_and_its_target_holds_the_result() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    // Also a link to a link, and one to nothing yet.
    fs::create_dir(folder.join("target")).unwrap();
    for (link, to) in [("link", "target"), ("other", "link"), ("early", "later")] {
        std::os::unix::fs::symlink(to, folder.join(link)).unwrap();
    }
    for (out, target) in [("link", "target"), ("other/", "target"), ("link/.", "target"), ("early", "later")]
    {
        for _ in 0..2 {
            succeeds(folder, &["s.toml", "--out", out]);
            assert_eq!(report(&folder.join(target))["status"], "completed");
        }
        assert!(folder.join(format!("{target}.previous/report.json")).is_file());
        let kept = |link: &str| fs::symlink_metadata(folder.join(link)).unwrap().is_symlink();
        assert!(["link", "other", "early"].into_iter().all(kept));
    }
    std::os::unix::fs::symlink("circle", folder.join("circle")).unwrap();
    let circle = run(folder, &["s.toml", "--out", "circle"]);
    assert!(!circle.status.success() && told(&circle).contains("link to itself"), "{}", told(&circle));
}

#[test]
fn a_name_as_long_as_names_may_be_is_run_again() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    let name = "s".repeat(250);
    fs::rename(folder.join("s.toml"), folder.join(format!("{name}.toml"))).unwrap();
    for _ in 0..3 {
        succeeds(folder, &[&format!("{name}.toml")]);
    }
    let names = fs::read_dir(folder.join("out")).unwrap().map(|entry| entry.unwrap().file_name());
    let names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
    assert_eq!(names.len(), 2);
    assert!(names.contains(&name) && names.iter().any(|n| n.ends_with(".previous")), "{names:?}");
}

#[test]
fn the_result_of_another_scene_is_not_replaced_unless_that_is_asked_for() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    succeeds(folder, &["s.toml", "--out", "result"]);
    fs::write(folder.join("s.toml"), varied(SLIDER, &[With("title", "another")])).unwrap();
    refused(folder, &["s.toml", "--out", "result"], &["result of another scene", "--force"]);
    // A file elsewhere with the same title.
    fs::create_dir(folder.join("elsewhere")).unwrap();
    fs::write(folder.join("elsewhere/s.toml"), format!("{SLIDER}\n# another\n")).unwrap();
    refused(folder, &["elsewhere/s.toml", "--out", "result"], &["result of another scene", "/s.toml"]);
    succeeds(folder, &["s.toml", "--out", "result", "--force"]);
    assert_eq!(report(&folder.join("result"))["title"], "another");
    assert_ne!(report(&folder.join("result.previous"))["title"], "another");
}

#[test]
fn what_no_run_has_written_is_never_touched() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    fs::create_dir_all(folder.join("out/s")).unwrap();
    fs::write(folder.join("out/s/notes.txt"), "mine").unwrap();
    refused(folder, &["s.toml"], &["notes.txt is not of a run", "--out"]);
    refused(folder, &["s.toml", "--force"], &["notes.txt is not of a run"]);
    fs::remove_file(folder.join("out/s/notes.txt")).unwrap();
    succeeds(folder, &["s.toml"]);
    succeeds(folder, &["s.toml"]);
    fs::write(folder.join("out/s.previous/plots/mine.docx"), "mine").unwrap();
    refused(folder, &["s.toml"], &["mine.docx is not of a run", "move it away"]);
    // A report of something else.
    fs::create_dir(folder.join("other")).unwrap();
    fs::write(folder.join("other/report.json"), "{\"status\": \"fine\"}").unwrap();
    refused(folder, &["s.toml", "--out", "other"], &["report.json is not of a run"]);
}

#[test]
fn a_run_that_was_killed_is_kept_as_the_one_before() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    succeeds(folder, &["s.toml"]);
    let path = folder.join("out/s/report.json");
    let kill = || {
        let mut report: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
        report["status"] = "running".into();
        fs::write(&path, report.to_string()).unwrap();
    };
    kill();
    succeeds(folder, &["s.toml"]);
    assert_eq!(report(&folder.join("out/s.previous"))["status"], "running");
    // A run without results replaces no earlier one.
    for file in fs::read_dir(folder.join("out/s")).unwrap().map(|e| e.unwrap().path()) {
        if file.is_dir() {
            fs::remove_dir_all(file).unwrap();
        } else if file != path {
            fs::remove_file(file).unwrap();
        }
    }
    kill();
    fs::write(folder.join("out/s.previous/report.json"), fs::read(&path).unwrap()).unwrap();
    let kept = everything(&folder.join("out/s.previous"));
    succeeds(folder, &["s.toml"]);
    assert!(everything(&folder.join("out/s.previous")) == kept);
}

#[test]
fn a_scene_that_cannot_be_planned_leaves_the_result_before_it_where_it_was() {
    let text = |set: &str| {
        format!(
            "schema = 1\ntitle = \"a file\"\nkinematics = \"plane-strain\"\n[materials.m]\nyoung = 1e9\npoisson = 0.2\n[bodies.B]\n\
             mesh.gmsh = {{ file = \"m.msh\" }}\nmaterial = \"m\"\n[[stages]]\nname = \"load\"\nduration = 1\nsteps = 1\n\
             conditions = [{{ set = \"B.bottom\", x = 0, y = 0 }}, {{ set = \"B.{set}\", pressure = 1e6 }}]\n\
             [time]\nstepper = \"implicit\"\n"
        )
    };
    let folder = scene(&text("nowhere"));
    let folder = folder.path();
    fs::write(folder.join("m.msh"), include_bytes!("../meshes/two_layers.msh")).unwrap();
    refused(folder, &["s.toml"], &["nowhere"]);
    assert!(!folder.join("out").exists());
    fs::write(folder.join("s.toml"), text("top")).unwrap();
    succeeds(folder, &["s.toml"]);
    succeeds(folder, &["s.toml"]);
    fs::write(folder.join("s.toml"), text("nowhere")).unwrap();
    refused(folder, &["s.toml"], &["nowhere"]);
}

#[test]
fn two_runs_do_not_write_into_one_directory() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    succeeds(folder, &["s.toml"]);
    let lock = File::options().append(true).open(folder.join("out/s/.lock")).unwrap();
    lock.lock().unwrap();
    refused(folder, &["s.toml"], &["another run writes into out/s", "--out"]);
    refused(folder, &["s.toml", "--force"], &["another run writes into out/s"]);
    drop(lock);
    succeeds(folder, &["s.toml"]);
}

/// A fault that needs few steps, in the plane.
const FAULT: &str = include_str!("../../../../verification/cases/fault_turning/scene.toml");

#[test]
fn whatever_runs_leave_is_known_to_be_theirs() {
    let coarse = coarse_sandwich();
    let turning =
        format!("{FAULT}\n[output]\nbodies = true\nstations.main = [[0, \"0.5 km\", \"0.5 km\"]]\n");
    for text in [&coarse, SLIDER, include_str!("../../../../scenes/cook.toml"), &turning] {
        let folder = scene(text);
        // The third run replaces the first one, after it has checked each of its files.
        for _ in 0..3 {
            succeeds(folder.path(), &["s.toml"]);
        }
    }
}

/// Waits until a file exists and has at least this size.
fn grown(child: &mut Child, file: &Path, size: u64) {
    let begin = Instant::now();
    while fs::metadata(file).map_or(0, |m| m.len()) < size {
        assert!(child.try_wait().unwrap().is_none(), "the run has ended");
        assert!(begin.elapsed() < Duration::from_secs(300), "the run does not get on");
    }
}

#[test]
fn a_signal_ends_runs_of_bodies_and_sliders_with_what_was_computed() {
    let fine = varied(SANDWICH, &[With("time.tolerance", "0.01 nm")]);
    let long = varied(SLIDER, &[With("events.stop_after", "100000"), With("time.end", "1e9 s")]);
    let bodies = (&fine, "probes/fault.csv", "interrupted: a signal asked for it in stage");
    for (text, file, said) in [bodies, (&long, "history/block.csv", "interrupted: a signal asked for it at")]
    {
        let folder = scene(text);
        let folder = folder.path();
        let mut child = command(folder, &["run", "s.toml", "--no-plots"]).spawn().unwrap();
        grown(&mut child, &folder.join("out/s").join(file), 3000);
        assert_eq!(report(&folder.join("out/s"))["status"], "running");
        assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{}", told(&output));
        assert!(told(&output).contains(said), "{}", told(&output));
        let report = report(&folder.join("out/s"));
        assert_eq!(report["status"], "interrupted");
        assert!(report["counts"]["steps"].as_u64().unwrap() > 0);
    }
}

#[test]
fn a_closed_or_full_stream_does_not_end_a_run() {
    let folder = scene(SLIDER);
    let folder = folder.path();
    let full = || Stdio::from(File::options().write(true).open("/dev/full").unwrap());
    let mut child = command(folder, &["run", "s.toml", "--out", "closed"]).spawn().unwrap();
    drop((child.stdout.take(), child.stderr.take()));
    assert!(child.wait().unwrap().success());
    let both = command(folder, &["run", "s.toml", "--out", "full"]).stdout(full()).stderr(full()).status();
    assert!(both.unwrap().success());
    let one = command(folder, &["run", "s.toml", "--out", "one"]).stdout(full()).output().unwrap();
    assert!(one.status.success());
    assert!(told(&one).contains("standard output cannot be written"), "{}", told(&one));
    for out in ["closed", "full", "one"] {
        assert_eq!(report(&folder.join(out))["status"], "completed");
    }
    let mut child = command(folder, &["check", "s.toml"]).spawn().unwrap();
    drop(child.stdout.take());
    assert!(child.wait().unwrap().success());
    // The exit code is that of the run, whatever happens to the streams.
    fs::write(folder.join("s.toml"), "schema = 1").unwrap();
    let bad = command(folder, &["run", "s.toml"]).stdout(full()).stderr(full()).status();
    assert_eq!(bad.unwrap().code(), Some(1));
}

#[test]
fn an_error_far_along_a_line_is_shown() {
    let far = SceneText::new(SLIDER).renamed("title", &"x".repeat(70_000)).text().unwrap();
    let folder = scene(&far);
    let output = run(folder.path(), &["s.toml"]);
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    let folder = scene(&format!("schema = 1\nlist = [{}oops]\n", " ".repeat(70_000)));
    let output = run(folder.path(), &["s.toml"]);
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert!(told(&output).contains("s.toml:2:70009"), "{}", told(&output));
}
