//! Commands around runs: templates, values set in a scene, lines of JSON, the state of a run, the reference of keys.
#![allow(clippy::disallowed_methods)]

use crate::common::coarse_sandwich as coarse;
use asperity::cli::Template;
use clap::ValueEnum;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Standard error with its line breaks and margins removed.
fn message(output: &Output) -> String {
    text(&output.stderr).split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
}

fn report(folder: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(folder.join("report.json")).unwrap()).unwrap()
}

const SLIDERS: &str = include_str!("../../../../scenes/spring-slider.toml");

fn with(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), scene).unwrap();
    folder
}

#[test]
fn every_template_is_sound_and_none_replaces_a_file() {
    let folder = tempfile::tempdir().unwrap();
    for template in Template::value_variants() {
        let name = template.name();
        assert_eq!(template.to_possible_value().unwrap().get_name(), name);
        let new = asperity(folder.path(), &["new", name]);
        assert!(new.status.success(), "{}", text(&new.stderr));
        let file = format!("{name}.toml");
        let checked = asperity(folder.path(), &["check", &file]);
        assert!(checked.status.success(), "{name}: {}", text(&checked.stderr));
        assert!(!text(&checked.stdout).contains("warning"), "{name}: {}", text(&checked.stdout));
        std::fs::write(folder.path().join(&file), "mine").unwrap();
        let again = asperity(folder.path(), &["new", name]);
        assert_eq!(again.status.code(), Some(1));
        assert!(message(&again).contains("exists already"), "{}", message(&again));
        assert_eq!(std::fs::read_to_string(folder.path().join(&file)).unwrap(), "mine");
    }
}

#[test]
fn the_fast_templates_run_to_their_ends() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["sliders", "contact", "contact-3d", "cycles-2d", "cycles-3d", "subduction"] {
        assert!(asperity(folder.path(), &["new", name]).status.success());
        let run = asperity(folder.path(), &["run", &format!("{name}.toml"), "--no-plots"]);
        assert!(run.status.success(), "{name}: {}", text(&run.stderr));
        assert_eq!(report(&folder.path().join("out").join(name))["status"], "completed");
    }
}

#[test]
fn a_run_with_a_set_value_is_that_of_the_changed_scene() {
    let folder = with(SLIDERS);
    let set = ["--set", "sliders.block.normal=4MPa", "--set", "events.below=0.5 mm/s"];
    let run = asperity(folder.path(), &[&["run", "s.toml", "--no-plots"][..], &set].concat());
    assert!(run.status.success(), "{}", text(&run.stderr));
    let out = folder.path().join("out/s");
    let resolved = std::fs::read_to_string(out.join("scene.toml")).unwrap();
    assert!(
        resolved.contains("normal = \"4MPa\"") && resolved.contains("below = \"0.5 mm/s\""),
        "{resolved}"
    );
    std::fs::write(folder.path().join("t.toml"), &resolved).unwrap();
    assert!(asperity(folder.path(), &["run", "t.toml", "--no-plots"]).status.success());
    let (set, written) = (report(&out), report(&folder.path().join("out/t")));
    assert_eq!(set["run"]["set"][0], "sliders.block.normal=4MPa");
    let parts = |report: &Value| {
        let mut report = report.clone();
        report.as_object_mut().unwrap().remove("run");
        report
    };
    assert_eq!(parts(&set), parts(&written));
}

#[test]
fn an_unknown_path_or_a_bad_value_is_an_error_that_names_the_setting() {
    let folder = with(SLIDERS);
    for (set, part) in [
        ("sliders.block.nromal=4MPa", "did you mean `normal`?"),
        ("sliders.blok.normal=4MPa", "did you mean `block`?"),
        ("slider.block.normal=4MPa", "did you mean `sliders`?"),
        ("springs[0].stiffness=1", "write it into the file"),
        ("sliders.block.normal=4 km", "[--set:1:22]"),
        ("sliders.block.law.evolution=aging", "[--set:1:"),
        ("sliders.block=3", "set its keys"),
        ("sliders.block.law=[1", "cannot be read"),
        ("time.end", "write a key and its value"),
    ] {
        for command in ["check", "run"] {
            let output = asperity(folder.path(), &[command, "s.toml", "--set", set]);
            assert!(matches!(output.status.code(), Some(1 | 2)), "{set}");
            assert!(message(&output).contains(part), "{set}: {}", message(&output));
        }
        assert!(!folder.path().join("out").exists(), "{set}");
    }
}

#[test]
fn an_error_beside_a_set_value_has_its_line_in_the_file() {
    let scene = SLIDERS.split("stiffness = ").collect::<Vec<_>>().join("stifness = ");
    let line = scene.lines().position(|line| line.starts_with("stifness")).unwrap() + 1;
    let folder = with(&scene);
    let output =
        asperity(folder.path(), &["check", "s.toml", "--set", "load.nothing=1", "--set", "time.end=1 s"]);
    assert!(message(&output).contains("has no key `nothing`"), "{}", message(&output));
    for set in ["sliders.block.mass=3000 kg/m^2", "events.below=1 um/s"] {
        let output = asperity(folder.path(), &["check", "s.toml", "--set", set]);
        assert!(message(&output).contains(&format!("[s.toml:{line}:1]")), "{}", message(&output));
    }
}

#[test]
fn lines_of_json_tell_the_whole_run() {
    let folder = with(SLIDERS);
    let run = asperity(folder.path(), &["run", "s.toml", "--json", "--no-plots", "--threads", "1"]);
    assert!(run.status.success() && run.stderr.is_empty(), "{}", text(&run.stderr));
    let lines: Vec<Value> =
        text(&run.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let kinds: Vec<&str> = lines.iter().map(|line| line["line"].as_str().unwrap()).collect();
    assert_eq!((kinds[0], kinds[1], kinds[kinds.len() - 1]), ("begin", "planned", "end"));
    assert_eq!(kinds.iter().filter(|kind| **kind == "event").count(), 10);
    assert!(kinds.contains(&"progress"));
    assert_eq!(lines[0]["threads"], 1);
    let end = &lines[lines.len() - 1];
    assert_eq!((&end["status"], &end["code"]), (&Value::from("completed"), &Value::from(0)));
    let bad = asperity(folder.path(), &["run", "s.toml", "--json", "--set", "sliders.block.normal=4 km"]);
    let end: Value = serde_json::from_str(&text(&bad.stdout)).unwrap();
    assert_eq!((&end["status"], &end["code"]), (&Value::from("failed"), &Value::from(1)));
    assert!(end["diagnostic"]["message"].is_string(), "{end}");
}

#[test]
fn a_quiet_run_prints_nothing_but_warnings() {
    let folder = with(&coarse());
    let run = asperity(folder.path(), &["run", "s.toml", "--quiet", "--no-plots"]);
    assert!(run.status.success() && run.stdout.is_empty(), "{}", text(&run.stdout));
    let lines = text(&run.stderr);
    assert!(lines.lines().all(|line| line.starts_with("warning: ")), "{lines}");
}

#[test]
fn the_directory_says_what_its_files_are_and_how_the_run_ended() {
    let folder = with(SLIDERS);
    assert!(asperity(folder.path(), &["run", "s.toml"]).status.success());
    let out = folder.path().join("out/s");
    assert!(!out.join("progress.json").exists());
    let readme = std::fs::read_to_string(out.join("README.md")).unwrap();
    for entry in std::fs::read_dir(&out).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(name == ".lock" || readme.contains(&format!("- `{name}")), "{name} is not in\n{readme}");
    }
    let status = asperity(folder.path(), &["status", "out/s"]);
    assert!(
        status.status.success() && text(&status.stdout).contains("completed"),
        "{}",
        text(&status.stdout)
    );
    std::fs::write(folder.path().join("t.toml"), coarse()).unwrap();
    let cut = ["run", "t.toml", "--out", "cut", "--wall-time", "0 s"];
    assert_eq!(asperity(folder.path(), &cut).status.code(), Some(3));
    let status = asperity(folder.path(), &["status", "cut", "--json"]);
    assert_eq!(status.status.code(), Some(3));
    let status: Value = serde_json::from_str(&text(&status.stdout)).unwrap();
    assert_eq!((&status["state"], &status["resumable"]), (&Value::from("interrupted"), &Value::from(true)));
    assert_eq!(asperity(folder.path(), &["status", "nowhere"]).status.code(), Some(1));
}

#[test]
fn a_key_is_explained_by_its_row_of_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    let output = asperity(folder.path(), &["explain", "faults.law.a"]);
    let page = include_str!("../../../../docs/src/commands.md");
    assert!(page.contains(&text(&output.stdout)), "{}", text(&output.stdout));
    let output = asperity(folder.path(), &["explain", "faults.main.nromal"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(message(&output).contains("did you mean `normal`?"), "{}", message(&output));
    assert!(asperity(folder.path(), &["explain"]).status.success());
    assert!(text(&asperity(folder.path(), &["man"]).stdout).contains(".TH asperity 1"));
    assert!(text(&asperity(folder.path(), &["completions", "bash"]).stdout).contains("_asperity"));
}

#[test]
fn two_directories_are_compared_column_by_column() {
    let folder = with(SLIDERS);
    let run = |out: &str, set: &str| {
        let run = asperity(folder.path(), &["run", "s.toml", "--no-plots", "--out", out, "--set", set]);
        assert!(run.status.success(), "{}", text(&run.stderr));
    };
    run("a", "title=one");
    run("b", "title=other");
    run("c", "sliders.block.stiffness=1.2 GPa/m");
    let compared = asperity(folder.path(), &["compare", "a", "b", "--tolerance", "0"]);
    assert!(compared.status.success(), "{}", text(&compared.stdout));
    let compared = asperity(folder.path(), &["compare", "a", "c"]);
    assert_eq!(compared.status.code(), Some(1));
    assert!(text(&compared.stdout).contains("differs"), "{}", text(&compared.stdout));
    // What one folder lacks is not agreement.
    let history = folder.path().join("b/history/block.csv");
    let whole = std::fs::read_to_string(&history).unwrap();
    let lines = |keep: usize| whole.split_inclusive('\n').take(keep).collect::<String>();
    for keep in [1, 10] {
        std::fs::write(&history, lines(keep)).unwrap();
        let compared = asperity(folder.path(), &["compare", "a", "b"]);
        assert_eq!(compared.status.code(), Some(1), "{}", text(&compared.stdout));
        let said = format!("history/block.csv: {} of ", keep - 1);
        assert!(text(&compared.stdout).contains(&said), "{}", text(&compared.stdout));
    }
    std::fs::write(&history, whole).unwrap();
    // Stations have no ending.
    let station = |out: &str, row: &str| {
        let path = folder.path().join(out).join("stations");
        std::fs::create_dir_all(&path).unwrap();
        std::fs::write(path.join("main_dp000"), format!("# location= here\nt slip\n0e0 0e0\n{row}\n"))
            .unwrap();
    };
    station("a", "1e0 1e0");
    assert_eq!(asperity(folder.path(), &["compare", "a", "b"]).status.code(), Some(1));
    station("b", "1e0 1.1e0");
    assert_eq!(asperity(folder.path(), &["compare", "a", "b"]).status.code(), Some(1));
    station("b", "1e0 1e0");
    assert!(asperity(folder.path(), &["compare", "a", "b"]).status.success());
    assert_eq!(asperity(folder.path(), &["compare", "a", "nowhere"]).status.code(), Some(2));
    assert_eq!(asperity(folder.path(), &["compare", "a", "b", "--tolerance", "-1"]).status.code(), Some(2));
}
