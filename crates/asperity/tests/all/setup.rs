//! Set-ups of faults that are kept in the output directory: runs that read them leave the files of runs that compute them.
#![allow(clippy::disallowed_methods)]
#![cfg(unix)]

use crate::common::{cycles, told, varied};
use crate::resume::{files, folder, run, text};
use asperity_vary::Change::{Add, With, Without};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

const BP1: &str = include_str!("../../../../scenes/bp1-half-space.toml");
const PRESSED: &str = include_str!("../../../../verification/cases/fault_pressing/block.toml");

/// A line of 200 cells in a half-space, whose operator is compressed, over some steps.
fn line(duration: &str) -> String {
    varied(
        BP1,
        &[
            With("faults.main.line.spacing", "200 m"),
            Add("faults.main.under_resolved", "allow"),
            With("stages[0].duration", duration),
        ],
    )
}

/// Files of a run without its set-up and the texts that list it.
fn results(out: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = files(out);
    if let Some(page) = all.get_mut(Path::new("report.html")) {
        let whole = text(page);
        let list = whole.find("<ul><li><a href=\"README.md\">").unwrap();
        page.truncate(list);
    }
    all.retain(|path, _| !path.starts_with("setup") && !path.ends_with("README.md"));
    all
}

fn assert_same(folder: &Path, out: &str) {
    let (expected, found) = (results(&folder.join("whole")), results(&folder.join(out)));
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (path, bytes) in &expected {
        assert!(found[path] == *bytes, "{} of `{out}` differs", path.display());
    }
}

fn succeeds(output: &Output) -> String {
    assert!(output.status.success(), "{}", told(output));
    text(&output.stdout)
}

/// The parts of the set-up in the report of a run.
fn reported(out: &Path) -> Value {
    let report: Value = serde_json::from_slice(&fs::read(out.join("report.json")).unwrap()).unwrap();
    report["run"]["setup"].clone()
}

/// Runs a scene without a set-up, with one that is kept, and with one that is read; `parts` are those that are kept.
fn kept_and_read(scene: &str, parts: &[&str]) {
    let folder = folder(scene);
    let folder = folder.path();
    let whole = succeeds(&run(folder, "whole", &[]));
    assert!(!whole.contains("set-up  ") && reported(&folder.join("whole")).is_null(), "{whole}");
    for (arguments, printed, how) in [
        (&["--cache", "always"][..], "and kept in `setup/", "written"),
        (&["--cache", "auto"], "read from `setup/", "read"),
        (&[], "read from `setup/", "read"),
    ] {
        let output = run(folder, "kept", arguments);
        let out = succeeds(&output);
        assert!(out.contains(printed), "{out}");
        assert!(!told(&output).contains("the set-up"), "{}", told(&output));
        assert_same(folder, "kept");
        let reported = reported(&folder.join("kept"));
        let parted: Vec<&str> =
            reported.as_array().unwrap().iter().map(|k| k["part"].as_str().unwrap()).collect();
        assert_eq!(parted, parts);
        assert!(reported.as_array().unwrap().iter().all(|k| k["use"] == how), "{reported}");
    }
    let readme = fs::read_to_string(folder.join("kept/README.md")).unwrap();
    assert!(readme.contains("- `setup/`: "), "{readme}");
    assert!(!folder.join("kept.previous/setup").exists(), "it follows the last run");
}

#[test]
fn the_set_up_of_a_compressed_operator_is_read_with_the_same_bits() {
    kept_and_read(&line("20 yr"), &["operator"]);
}

#[test]
fn the_set_up_of_condensed_bodies_is_read_with_the_same_bits() {
    kept_and_read(&varied(cycles::SCENE, &[With("events.stop_after", "1")]), &["operator"]);
}

/// A spring is sampled by displacements of the bodies, which need the factor: only the bodies as they were pressed are kept.
#[test]
fn the_set_up_of_pressed_bodies_is_read_with_the_same_bits() {
    let scene = varied(
        PRESSED,
        &[
            With("stages[1].duration", "40 s"),
            With("bodies.A.mesh.block.size", "5 mm"),
            With("bodies.B.mesh.block.size", "5 mm"),
            Add("faults.face.under_resolved", "allow"),
        ],
    );
    kept_and_read(&scene, &["pressing"]);
    let still = [
        Without("output.points"),
        Without("output.forces"),
        With("stages[1].conditions", r#"[{ set = "B.top", y = { rate = "-1 um/s" } }]"#),
    ];
    kept_and_read(&varied(&scene, &still), &["pressing", "operator"]);
}

#[test]
fn a_set_up_that_was_damaged_or_is_of_another_rock_is_computed_again() {
    let folder = folder(&line("20 yr"));
    let folder = folder.path();
    succeeds(&run(folder, "whole", &[]));
    succeeds(&run(folder, "kept", &["--cache", "always"]));
    let file = folder.join("kept/setup/operator.bin");
    let mut bytes = fs::read(&file).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&file, &bytes).unwrap();
    let output = run(folder, "kept", &[]);
    succeeds(&output);
    let warning = "kept/setup/operator.bin is not used, and computed again: it is damaged";
    assert!(told(&output).contains(warning), "{}", told(&output));
    assert_same(folder, "kept");
    succeeds(&run(folder, "kept", &["--cache", "always"]));
    // What the operator does not depend on may change.
    let friction = ["--set", "faults.main.law.mu0=0.61"];
    assert!(succeeds(&run(folder, "kept", &friction)).contains("read from"));
    let output = run(folder, "kept", &["--set", "materials.rock.young=90 GPa", "--quiet"]);
    succeeds(&output);
    assert!(
        told(&output).contains("the points, the rock, the bodies or their loads were others"),
        "{}",
        told(&output)
    );
    succeeds(&run(folder, "other", &["--set", "materials.rock.young=90 GPa"]));
    let table = |out: &str| fs::read(folder.join(out).join("largest_rate.csv")).unwrap();
    assert!(table("kept") == table("other") && table("kept") != table("whole"));
}

#[test]
fn a_set_up_survives_a_run_that_is_interrupted_and_one_that_is_refused_after_it() {
    let folder = folder(&line("250 yr"));
    let folder = folder.path();
    succeeds(&run(folder, "whole", &[]));
    let output = run(folder, "kept", &["--cache", "always", "--wall-time", "0 s"]);
    assert_eq!(output.status.code(), Some(3), "{}", told(&output));
    let resumed = succeeds(&run(folder, "kept", &["--resume"]));
    assert!(resumed.contains("read from") && resumed.contains("resumed at"), "{resumed}");
    assert_same(folder, "kept");
    // A station that is found beside the fault once the operator is known.
    let far = ["--cache", "always", "--set", "output.stations.main=[\"80 km\"]"];
    let output = run(folder, "refused", &far);
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    let left: Vec<_> =
        fs::read_dir(folder.join("refused")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, ["setup"]);
    assert!(succeeds(&run(folder, "refused", &[])).contains("read from"));
    assert_same(folder, "refused");
    // The result before it and its set-up stay as they are.
    let before = files(&folder.join("kept"));
    let output = run(folder, "kept", &far[2..]);
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert!(files(&folder.join("kept")) == before && folder.join("kept/setup/operator.bin").is_file());
}
