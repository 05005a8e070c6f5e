//! Figures of runs, and the peaks of events in tables.
#![allow(clippy::disallowed_methods)]

use crate::common::told;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn scene(name: &str) -> String {
    format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// Runs a scene with settings into the folder `out` of a new folder.
fn run(scene: &str, settings: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let set = settings.iter().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> = ["run", scene, "--out", "out"].into_iter().chain(set).collect();
    let program = env!("CARGO_BIN_EXE_asperity");
    let ended = Command::new(program).current_dir(folder.path()).args(arguments).output().unwrap();
    assert!(ended.status.success(), "{}", told(&ended));
    folder
}

/// Rows of a table with these columns, by the beginnings of their names.
fn columns(path: &Path, names: &[&str]) -> Vec<Vec<f64>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let head = reader.headers().unwrap().clone();
    let number = |name: &&str| head.iter().position(|h| h.starts_with(name)).unwrap();
    let numbers: Vec<usize> = names.iter().map(number).collect();
    let row = |row: csv::StringRecord| numbers.iter().map(|&n| row[n].parse().unwrap()).collect();
    reader.records().map(|r| row(r.unwrap())).collect()
}

/// Largest slip rate within each event over its peak in the catalogue.
fn over_peaks(out: &Path, rates: &[(f64, f64)]) -> Vec<f64> {
    let events = columns(&out.join("events.csv"), &["onset", "duration", "peak_rate"]);
    let largest = |event: &Vec<f64>| {
        let within = rates.iter().filter(|r| (event[0]..=event[0] + event[1]).contains(&r.0));
        within.map(|r| r.1).fold(0.0, f64::max) / event[2]
    };
    events.iter().map(largest).collect()
}

/// Relative error of a slip rate whose logarithm has six decimals.
const SIX_DIGITS: f64 = 1.2e-6;

#[test]
fn the_largest_slip_rate_in_the_table_of_faults_is_the_peak_of_the_catalogue() {
    for (name, settings) in
        [("subduction", &[][..]), ("thermal-pressurisation", &[]), ("fault-3d", &["events.stop_after=1"])]
    {
        let folder = run(&scene(name), settings);
        let out = folder.path().join("out");
        let rows = columns(&out.join("largest_rate.csv"), &["time", "log10 slip_rate"]);
        let rates: Vec<(f64, f64)> = rows.iter().map(|r| (r[0], 10.0_f64.powf(r[1]))).collect();
        let all = over_peaks(&out, &rates);
        assert!(!all.is_empty() && all.iter().all(|r| (r - 1.0).abs() < SIX_DIGITS), "{name}: {all:?}");
    }
}

#[test]
fn the_largest_slip_rate_in_the_history_of_a_slider_is_the_peak_of_the_catalogue() {
    let of = |settings: &[&str]| {
        let folder = run(&scene("spring-slider"), settings);
        let out = folder.path().join("out");
        let rows = columns(&out.join("history/block.csv"), &["time", "slip_rate"]);
        over_peaks(&out, &rows.iter().map(|r| (r[0], r[1].abs())).collect::<Vec<_>>())
    };
    assert!(of(&["events.stop_after=3"]).iter().all(|r| (r - 1.0).abs() < 1e-12));
    // Peaks are those of steps, all of which that are the largest have rows; between steps rows may be faster.
    let at_steps = of(&["events.stop_after=3", "events.peaks=false"]);
    assert!(at_steps.iter().all(|r| (1.0 - 1e-12..1.01).contains(r)), "{at_steps:?}");
}

#[test]
fn the_largest_slip_rate_in_the_table_of_interfaces_is_the_peak_of_the_catalogue() {
    let folder = run(&scene("stick-slip"), &["events.stop_after=2"]);
    let out = folder.path().join("out");
    let rows = columns(
        &out.join("largest_rates.csv"),
        &["time", "largest slip_rate of one", "largest slip_rate of other"],
    );
    let rates: Vec<(f64, f64)> = rows.iter().map(|r| (r[0], r[1].max(r[2]))).collect();
    let all = over_peaks(&out, &rates);
    assert!(all.len() == 2 && all.iter().all(|r| (r - 1.0).abs() < 1e-12), "{all:?}");
}

/// Names of the figures of a run.
fn names(out: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(out.join("plots")).unwrap().map(|entry| entry.unwrap().path());
    entries.map(|path| path.file_stem().unwrap().to_str().unwrap().to_string()).collect()
}

/// Value of an attribute.
fn attribute(text: &str, name: &str) -> Option<f64> {
    text.split_once(&format!(" {name}=\""))?.1.split_once('"')?.0.parse().ok()
}

/// Mean width of a character over its em, and the room that rounding may take.
const CHARACTER: f64 = 0.6;
const ROUNDING: f64 = 0.5;

/// Texts of a figure that lie beyond its page.
fn beyond(svg: &str) -> Vec<String> {
    let page = [attribute(svg, "width").unwrap(), attribute(svg, "height").unwrap()];
    let texts = svg.lines().filter(|line| line.starts_with("<text"));
    let lies_beyond = |line: &&str| {
        let (x, y, size) = (attribute(line, "x"), attribute(line, "y"), attribute(line, "font-size"));
        let (x, y, size) = (x.unwrap(), y.unwrap(), size.unwrap());
        let words = line.split_once('>').unwrap().1.split('<').next().unwrap();
        let long = CHARACTER * size * words.chars().count() as f64;
        let upright = line.contains("rotate(");
        let (along, across) = if upright { (y, x) } else { (x, y) };
        let share =
            if line.contains("\"middle\"") { 0.5 } else { f64::from(u8::from(line.contains("\"end\""))) };
        let (start, most) = (along - share * long, if upright { [page[1], page[0]] } else { page });
        start < -ROUNDING
            || start + long > most[0] + ROUNDING
            || across < 0.4 * size
            || across > most[1] - 0.4 * size
    };
    texts.filter(lies_beyond).map(str::to_owned).collect()
}

#[test]
fn runs_of_every_kind_have_figures_of_their_state_with_all_texts_on_the_page() {
    let section: PathBuf = scene("subduction").into();
    let expected: [(&str, &[&str], &[&str]); 4] = [
        (
            section.to_str().unwrap(),
            &["events.stop_after=1"],
            &[
                "stations_state",
                "plate_state",
                "plate_coupling",
                "plate_coupling_profiles",
                "plate_rate",
                "phase_portrait",
                "receivers_displacement_x",
                "receivers_displacement_y",
            ],
        ),
        (&scene("spring-slider"), &["events.stop_after=2"], &["sliders_state"]),
        (&scene("sandwich-state"), &["events.stop_after=2"], &["face_state"]),
        (
            &scene("bp5"),
            &[
                "faults.main.rectangle.size=6 km",
                "stages[0].duration=20 yr",
                "faults.main.under_resolved=allow",
            ],
            &["main_event_000_before_rate", "main_event_000_midway_coupling", "main_event_000_before_state"],
        ),
    ];
    for (scene, settings, figures) in expected {
        let folder = run(scene, settings);
        let out = folder.path().join("out");
        let drawn = names(&out);
        for figure in figures {
            assert!(drawn.contains(*figure), "{scene} has no {figure}, but {drawn:?}");
        }
        for name in drawn {
            let svg = fs::read_to_string(out.join("plots").join(format!("{name}.svg"))).unwrap();
            let beyond = beyond(&svg);
            assert!(beyond.is_empty(), "{scene}, {name}: {beyond:?}");
        }
    }
}

#[test]
fn a_fault_without_plates_has_no_coupling_and_a_law_without_state_no_figure_of_it() {
    let folder = run(&scene("sandwich-state"), &["events.stop_after=1"]);
    let drawn = names(&folder.path().join("out"));
    assert!(!drawn.iter().any(|name| name.contains("coupling")), "{drawn:?}");
    let law = "law={ kind = \"rate\", form = \"regularised\", mu0 = 0.6, a = 0.01, v_ref = \"1 um/s\" }";
    let folder = run(&scene("spring-slider"), &[&format!("sliders.block.{law}"), "time.end=10 s"]);
    let drawn = names(&folder.path().join("out"));
    assert!(drawn.contains("sliders_friction") && !drawn.contains("sliders_state"), "{drawn:?}");
}
