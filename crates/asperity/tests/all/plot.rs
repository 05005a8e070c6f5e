//! Figures drawn again from output directories: `asperity plot`.
#![allow(clippy::disallowed_methods)]

use crate::common::{coarse_sandwich, told};
use crate::resume::files;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// Runs a scene with settings into `out`.
fn run(folder: &Path, scene: &str, settings: &[&str]) {
    let set = settings.iter().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> = ["run", scene, "--out", "out"].into_iter().chain(set).collect();
    let ended = asperity(folder, &arguments);
    assert!([Some(0), Some(3)].contains(&ended.status.code()), "{}", told(&ended));
}

/// A folder with a run of bodies in contact.
fn contact() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), coarse_sandwich()).unwrap();
    run(folder.path(), "s.toml", &[]);
    folder
}

/// A folder with a run of a fault through an earthquake.
fn cycle() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), &scene("bp1"), &["events.stop_after=1"]);
    folder
}

#[test]
fn figures_drawn_again_are_those_of_the_run_in_every_kind_of_run() {
    let sliders = tempfile::tempdir().unwrap();
    run(sliders.path(), &scene("spring-slider"), &["events.stop_after=2"]);
    let waves = tempfile::tempdir().unwrap();
    run(waves.path(), &scene("tpv205-2d"), &["stages[0].duration=0.3 s"]);
    for folder in [contact(), cycle(), sliders, waves] {
        // What the figures need is in the directory alone, wherever that is.
        fs::rename(folder.path().join("out"), folder.path().join("moved")).unwrap();
        let drawn = asperity(folder.path(), &["plot", "moved", "--out", "again"]);
        assert!(drawn.status.success(), "{}", told(&drawn));
        let (first, again) = (folder.path().join("moved/plots"), folder.path().join("again"));
        assert!(!files(&first).is_empty());
        assert_eq!(files(&first), files(&again));
    }
}

#[test]
fn a_run_without_plots_of_a_fault_has_the_figures_of_one_with_plots() {
    let folder = cycle();
    let bare = ["run", &scene("bp1"), "--set", "events.stop_after=1", "--out", "bare", "--no-plots"];
    assert!(asperity(folder.path(), &bare).status.success());
    assert!(asperity(folder.path(), &["plot", "bare"]).status.success());
    let plots = |out: &str| files(&folder.path().join(out).join("plots"));
    assert_eq!(plots("out"), plots("bare"));
}

#[test]
fn figures_are_chosen_by_name_size_format_time_and_event() {
    let folder = cycle();
    let plot = |rest: &[&str]| {
        let _ = fs::remove_dir_all(folder.path().join("p"));
        let arguments: Vec<&str> = ["plot", "out", "--out", "p"].iter().chain(rest).copied().collect();
        let ended = asperity(folder.path(), &arguments);
        assert!(ended.status.success(), "{}", told(&ended));
        files(&folder.path().join("p"))
    };
    let named = plot(&["largest_rate", "out/plots/main_slip.svg", "--format", "svg,pdf,svg"]);
    let names: Vec<&str> = named.keys().map(|file| file.to_str().unwrap()).collect();
    assert_eq!(names, ["largest_rate.pdf", "largest_rate.svg", "main_slip.pdf", "main_slip.svg"]);
    // 174 mm are 493.2 points.
    let sized = plot(&["largest_rate", "--size", "17.4x10cm", "--format", "pdf,svg"]);
    let text = |files: &BTreeMap<PathBuf, Vec<u8>>, end: &str| {
        let path = PathBuf::from(format!("largest_rate.{end}"));
        String::from_utf8_lossy(&files[&path]).into_owned()
    };
    assert!(text(&sized, "pdf").contains("/MediaBox [0 0 493.22"), "{}", text(&sized, "pdf"));
    assert!(text(&sized, "svg").contains("width=\"657.6"), "{}", text(&sized, "svg"));
    let size = |files: &BTreeMap<PathBuf, Vec<u8>>| {
        u32::from_be_bytes(files[Path::new("largest_rate.png")][16..20].try_into().unwrap())
    };
    let fine = plot(&["largest_rate", "--format", "png", "--dpi", "96"]);
    let usual = plot(&["largest_rate", "--format", "png"]);
    assert_eq!(2 * size(&fine), size(&usual));
    let part = plot(&["largest_rate", "--from", "10 yr", "--to", "40 yr", "--format", "svg"]);
    let text = text(&part, "svg");
    assert!(text.contains(">10<") && text.contains(">40<") && !text.contains(">0<"), "{text}");
    let of_event = plot(&["--events", "1", "--from", "0 yr", "--to", "40 yr", "--format", "svg"]);
    assert!(of_event.keys().all(|file| !file.to_str().unwrap().contains("event_")), "{:?}", of_event.keys());
}

#[test]
fn what_cannot_be_drawn_is_refused_with_what_can() {
    let folder = cycle();
    let bare = folder.path().join("bare");
    fs::create_dir(&bare).unwrap();
    for (arguments, code, message) in [
        (&["out", "largest_rates"][..], 1, "there is no figure `largest_rates`"),
        (&["out", "nonsense"], 1, "main_slip"),
        (&["bare"], 1, "not the output directory of a run"),
        (&["missing"], 1, "not the output directory of a run"),
        (&["out", "--size", "79x60mm"], 2, "at least 80 mm wide and 50 mm high"),
        (&["out", "--size", "170"], 2, "170x110mm"),
        (&["out", "--size", "170x110"], 2, "170x110mm"),
        (&["out", "--size", "NaNxNaNmm"], 2, "at least 80 mm"),
        (&["out", "--size", "9999x9999mm"], 2, "at most 1200 mm"),
        (&["out", "--dpi", "0"], 2, "from 36 to 1200"),
        (&["out", "--size", "1200x1200mm", "--dpi", "1200"], 1, "million pixels"),
        (&["out", "--format", "jpg"], 2, "svg, png, pdf"),
        (&["out", "--from", "100"], 2, "unit"),
        (&["out", "--from", "1e9 yr"], 1, "the run lasts from"),
        (&["out", "--from", "20 yr", "--to", "10 yr"], 1, "the first time must lie before the last"),
        (&["out", "--events", "7"], 1, "event 7 has no figures of its own; those of events 1 to 1 have"),
        (&["out", "--events", "0"], 2, "0 is not in"),
    ] {
        let ended = asperity(folder.path(), &[&["plot"], arguments].concat());
        let told = told(&ended);
        assert_eq!(ended.status.code(), Some(code), "{arguments:?}: {told}");
        assert!(told.contains(message), "{arguments:?}: {told}");
    }
}

#[test]
fn a_missing_table_takes_only_its_own_figures_along() {
    let folder = cycle();
    fs::remove_file(folder.path().join("out/slip_profiles.csv")).unwrap();
    fs::remove_file(folder.path().join("out/events/moment_rate_000.csv")).unwrap();
    let ended = asperity(folder.path(), &["plot", "out", "--out", "p", "--format", "svg"]);
    assert!(ended.status.success(), "{}", told(&ended));
    assert!(told(&ended).contains("moment_rate_000.csv"), "{}", told(&ended));
    assert!(folder.path().join("p/main_event_000_rupture_times.svg").exists());
}

#[test]
fn a_run_that_wrote_nothing_for_figures_says_why() {
    let folder = contact();
    let bare = ["run", "s.toml", "--out", "bare", "--no-plots"];
    assert!(asperity(folder.path(), &bare).status.success());
    let ended = asperity(folder.path(), &["plot", "bare"]);
    assert!(!ended.status.success() && told(&ended).contains("--no-plots"), "{}", told(&ended));
    let path = folder.path().join("out/plots.json");
    let text = fs::read_to_string(&path).unwrap();
    let mut newer: serde_json::Value = serde_json::from_str(&text).unwrap();
    newer["version"] = 99.into();
    for (spoilt, message) in
        [(text[..text.len() / 2].to_string(), "cannot be read"), (newer.to_string(), "version 99")]
    {
        fs::write(&path, spoilt).unwrap();
        let ended = asperity(folder.path(), &["plot", "out"]);
        assert_eq!(ended.status.code(), Some(1));
        assert!(told(&ended).contains(message), "{}", told(&ended));
    }
}
