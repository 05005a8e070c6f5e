//! Runs of faults that are killed, interrupted and resumed: their files are those of an uninterrupted run.
#![allow(clippy::disallowed_methods)]
#![cfg(unix)]

use crate::common::{told, varied};
use asperity::cli::page::RUN;
use asperity_vary::Change::{Add, With, Without};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// The scene of cycles through twelve events.
static SCENE: LazyLock<String> = LazyLock::new(|| {
    varied(
        crate::common::cycles::SCENE,
        &[With("events.stop_after", "12"), Add("time.log_rate_tolerance", "1e-6")],
    )
});

/// The scene through this many events.
fn events(most: usize) -> String {
    varied(&SCENE, &[With("events.stop_after", &most.to_string())])
}

/// Begins a run of `s.toml` in `folder` with outputs in `out`.
fn start(folder: &Path, out: &str, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).args(["run", "s.toml", "--out", out]).args(arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

pub fn run(folder: &Path, out: &str, arguments: &[&str]) -> Output {
    start(folder, out, arguments).wait_with_output().unwrap()
}

pub fn folder(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), scene).unwrap();
    folder
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// All files below `out` by their paths in it; of the report, only the parts that do not depend on the machine.
pub fn files(out: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![out.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let mut bytes = fs::read(&path).unwrap();
            if path.ends_with("report.json") {
                let mut report: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
                assert!(report.as_object_mut().unwrap().remove("run").is_some());
                bytes = report.to_string().into_bytes();
            }
            if path.ends_with("report.html") {
                let page = String::from_utf8(bytes).unwrap();
                let (run, rest): (Vec<&str>, Vec<&str>) =
                    page.lines().partition(|line| line.starts_with(RUN));
                assert_eq!(run.len(), 2, "{run:?}");
                bytes = rest.concat().into_bytes();
            }
            found.insert(path.strip_prefix(out).unwrap().to_path_buf(), bytes);
        }
    }
    found
}

pub fn assert_same(folder: &Path, out: &str) {
    let (expected, found) = (files(&folder.join("whole")), files(&folder.join(out)));
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (path, bytes) in &expected {
        assert!(found[path] == *bytes, "{} of `{out}` differs", path.display());
    }
}

/// Waits until the file has grown to `size`, or says that the run ended before.
fn grown(child: &mut Child, file: &Path, size: u64) -> bool {
    let begin = Instant::now();
    while fs::metadata(file).map_or(0, |m| m.len()) < size {
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        assert!(begin.elapsed() < Duration::from_secs(120), "the run does not get on");
    }
    true
}

#[test]
fn a_run_killed_again_and_again_leaves_the_files_of_one_left_alone() {
    let folder = folder(&SCENE);
    let folder = folder.path();
    let whole = run(folder, "whole", &[]);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    let rows = fs::metadata(folder.join("whole/largest_rate.csv")).unwrap().len();
    let arguments = ["--resume", "--checkpoint-every", "0 s"];
    let mut kills = 0;
    // From before the first checkpoint to shortly before the end, always in the same output directory.
    for percent in [0, 2, 11, 23, 37, 52, 68, 81, 93, 99] {
        let mut child = start(folder, "killed", &arguments);
        if grown(&mut child, &folder.join("killed/largest_rate.csv"), rows * percent / 100 + 1) {
            child.kill().unwrap();
            kills += i32::from(!child.wait().unwrap().success());
        }
    }
    assert!(kills >= 7, "only {kills} kills came in time");
    let last = run(folder, "killed", &arguments);
    assert!(last.status.success(), "{}", text(&last.stderr));
    assert!(text(&last.stdout).contains("resumed at"), "{}", text(&last.stdout));
    assert_same(folder, "killed");
    // Resuming a run that had ended changes nothing.
    assert!(run(folder, "killed", &arguments).status.success());
    assert_same(folder, "killed");
}

/// Runs a scene without interruption, and again interrupted at every restart: the files must be the same. Returns the
/// number of interruptions.
fn broken_off_at_every_restart(scene: &str) -> u32 {
    let folder = folder(scene);
    let folder = folder.path();
    assert!(run(folder, "whole", &[]).status.success());
    let mut breaks = 0;
    loop {
        let output = run(folder, "broken", &["--resume", "--wall-time", "0 s"]);
        if output.status.success() {
            break;
        }
        assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
        let told = text(&output.stderr);
        assert!(told.contains("wall time is over") && told.contains("--resume"), "{told}");
        breaks += 1;
    }
    assert_same(folder, "broken");
    breaks
}

#[test]
fn a_run_broken_off_at_every_restart_leaves_the_same_files_and_says_how_to_go_on() {
    let breaks = broken_off_at_every_restart(&events(2));
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn a_fault_loaded_by_backslip_is_gone_on_with_as_well() {
    let lagging = [
        Add("faults.main.creep.loading", "backslip"),
        With("stages[0].conditions[0].z", "0"),
        With("stages[0].conditions[1].z", "0"),
        Add("output.points", r#"{ beside = { body = "crust", at = ["5 km", "0 km"] } }"#),
    ];
    let breaks = broken_off_at_every_restart(&varied(&events(2), &lagging));
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn files_that_become_coarse_are_the_same_after_breaks() {
    let amounts =
        [Add("output.largest_file", "20 kB"), Add("output.cadence", r#"{ decades = 0.05, slip = "1 mm" }"#)];
    let breaks = broken_off_at_every_restart(&varied(&events(2), &amounts));
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn a_fault_in_space_whose_slip_turns_is_gone_on_with_as_well() {
    let scene = include_str!("../../../../verification/cases/fault_turning/scene.toml");
    let output = "\n[output]\nbodies = true\nstations.main = [[0, \"0.5 km\", \"0.5 km\"]]\n";
    let breaks = broken_off_at_every_restart(&(scene.to_string() + output));
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn a_fault_that_opens_and_closes_is_gone_on_with_as_well() {
    let scene = varied(
        include_str!("../../../../scenes/fault-opening.toml"),
        &[With("bodies.crust.mesh.fault.spacing", "200 m"), Add("output.bodies", "true")],
    );
    let breaks = broken_off_at_every_restart(&scene);
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn a_block_that_is_pressed_and_whose_values_are_sampled_is_gone_on_with_as_well() {
    let stages = r#"[
        { name = "press", duration = "10 s", conditions = [{ set = "A.left", x = { to = "0.05 mm" } }, { set = "A.bottom", y = 0 }, { set = "B.right", x = 0 }, { set = "B.top", y = 0 }] },
        { name = "slide", duration = "4000 s", conditions = [{ set = "B.top", y = { spring = 2e9, rate = "-1 um/s" } }] },
    ]"#;
    let scene = varied(
        include_str!("../../../../scenes/sandwich-state.toml"),
        &[
            Without("faults.face.normal"),
            With("faults.face.law.l", "10 um"),
            With("stages", stages),
            With("events.stop_after", "2"),
            Add("output.points", r#"{ inside = { body = "A", at = ["10 mm", "30 mm"] } }"#),
            Add("output.forces", r#"{ pressing = { set = "A.left" } }"#),
        ],
    );
    let breaks = broken_off_at_every_restart(&scene);
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn a_medium_with_receivers_and_slow_events_is_gone_on_with_as_well() {
    let scene = varied(
        &events(2),
        &[
            Without("bodies"),
            Without("faults.main.minus"),
            Without("faults.main.plus"),
            Without("stages[0].conditions"),
            Add("medium", r#"{ kind = "half-space", material = "rock" }"#),
            Add("faults.main.line", r#"{ trace = [[0, 0], [0, "-24 km"]], spacing = "750 m" }"#),
            With("faults.main.creep", r#"{ rate = "1e-9 m/s" }"#),
            Add("output.receivers", r#"{ near = ["1 km", 0], far = ["-50 km", "-2 km"] }"#),
            Add("output.rupture_rate", r#""5 cm/s""#),
            Add("events.slow_above", r#""3e-9 m/s""#),
        ],
    );
    let breaks = broken_off_at_every_restart(&scene);
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn a_fault_that_heats_up_is_gone_on_with_as_well() {
    let scene = varied(
        include_str!("../../../../scenes/thermal-pressurisation.toml"),
        &[Add("time.log_rate_tolerance", "1e-9")],
    );
    let breaks = broken_off_at_every_restart(&scene);
    assert!(breaks > 3, "{breaks}");
}

#[test]
fn a_signal_ends_a_run_with_a_checkpoint_and_its_own_exit_code() {
    let folder = folder(&SCENE);
    let folder = folder.path();
    // The process that starts the tests may make them ignore the end of a terminal, which a run then ignores as well.
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:")).unwrap_or("0").trim();
    let deaf = u64::from_str_radix(mask, 16).unwrap() & 1 == 1;
    for signal in ["-TERM", "-INT", "-HUP"] {
        if signal == "-HUP" && deaf {
            continue;
        }
        let out = &signal[1..];
        let mut child = start(folder, out, &[]);
        assert!(grown(&mut child, &folder.join(out).join("largest_rate.csv"), 4000));
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
        assert!(text(&output.stderr).contains("a signal asked for it"), "{}", text(&output.stderr));
        assert!(folder.join(out).join("checkpoint").is_file());
        let report = fs::read_to_string(folder.join(out).join("report.json")).unwrap();
        assert!(report.contains("\"status\": \"interrupted\""), "{report}");
    }
}

#[test]
fn an_unfinished_run_is_not_overwritten_unless_that_is_asked_for() {
    let folder = folder(&events(1));
    let folder = folder.path();
    assert_eq!(run(folder, "out", &["--wall-time", "0 s"]).status.code(), Some(3));
    let checkpoint = fs::read(folder.join("out/checkpoint")).unwrap();
    let again = run(folder, "out", &[]);
    assert_eq!(again.status.code(), Some(1));
    let told = told(&again);
    assert!(told.contains("--resume") && told.contains("--force"), "{told}");
    assert_eq!(fs::read(folder.join("out/checkpoint")).unwrap(), checkpoint);
    assert!(run(folder, "out", &["--force"]).status.success());
    assert_eq!(fs::read(folder.join("out.previous/checkpoint")).unwrap(), checkpoint);
}

#[test]
fn a_run_extended_to_more_events_leaves_the_files_of_one_that_had_them_from_the_start() {
    let folder = folder(&events(3));
    let folder = folder.path();
    assert!(run(folder, "extended", &[]).status.success());
    fs::write(folder.join("s.toml"), events(5)).unwrap();
    let output = run(folder, "extended", &["--resume"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("resumed at"), "{}", text(&output.stdout));
    assert!(run(folder, "whole", &[]).status.success());
    assert_same(folder, "extended");
    // Fewer events than there are already is no extension.
    fs::write(folder.join("s.toml"), events(4)).unwrap();
    let output = run(folder, "extended", &["--resume"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("lies beyond"), "{}", told(&output));
    assert_same(folder, "extended");
}

#[test]
fn a_run_extended_in_time_goes_on_from_its_last_restart_before_the_end() {
    // Powers of two: the rates of the loads have no rounding that depends on the duration.
    let lasting = |seconds: u64| {
        let duration = format!("{seconds} s");
        varied(&SCENE, &[With("stages[0].duration", &duration), Without("events.stop_after")])
    };
    let folder = folder(&lasting(1 << 34));
    let folder = folder.path();
    assert!(run(folder, "extended", &[]).status.success());
    fs::write(folder.join("s.toml"), lasting(1 << 35)).unwrap();
    let output = run(folder, "extended", &["--resume"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("resumed at"), "{}", text(&output.stdout));
    assert!(run(folder, "whole", &[]).status.success());
    assert_same(folder, "extended");
    // A shorter run is no extension, and a load that reaches its value at the end differs if the end does.
    for (scene, part) in [
        (lasting(1 << 34), "lies beyond"),
        (
            varied(&lasting(1 << 36), &[With("stages[0].conditions[1].z", r#"{ to = "17 m" }"#)]),
            "of another scene",
        ),
    ] {
        fs::write(folder.join("s.toml"), scene).unwrap();
        let output = run(folder, "extended", &["--resume"]);
        assert_eq!(output.status.code(), Some(1));
        assert!(told(&output).contains(part), "{}", told(&output));
    }
    assert_same(folder, "extended");
}

#[test]
fn a_load_that_reaches_its_value_at_the_end_cannot_be_extended() {
    let lasting = |years: u32| {
        varied(
            &SCENE,
            &[
                With("stages[0].duration", &format!("{years} yr")),
                Without("events.stop_after"),
                With("stages[0].conditions[0].z", r#"{ to = "-1 m" }"#),
                With("stages[0].conditions[1].z", r#"{ to = "1 m" }"#),
            ],
        )
    };
    let folder = folder(&lasting(60));
    let folder = folder.path();
    let output = run(folder, "out", &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    fs::write(folder.join("s.toml"), lasting(120)).unwrap();
    let output = run(folder, "out", &["--resume"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("other loads"), "{}", told(&output));
}

#[test]
fn what_does_not_fit_the_checkpoint_is_refused() {
    let scene = events(1);
    let folder = folder(&scene);
    let folder = folder.path();
    let broken = run(folder, "out", &["--wall-time", "0 s"]);
    assert_eq!(broken.status.code(), Some(3), "{}", text(&broken.stderr));
    let refused = |part: &str| {
        let output = run(folder, "out", &["--resume"]);
        let told = told(&output);
        assert_eq!(output.status.code(), Some(1), "{told}");
        assert!(told.contains(part), "{part} is not in\n{told}");
    };
    fs::write(folder.join("s.toml"), varied(&scene, &[With("faults.main.normal", "51 MPa")])).unwrap();
    refused("of another scene");
    fs::write(folder.join("s.toml"), &scene).unwrap();
    let path = folder.join("out/checkpoint");
    let good = fs::read_to_string(&path).unwrap();
    fs::write(&path, &good[..good.len() / 2]).unwrap();
    refused("is damaged");
    let (head, rest) = good.split_once("version 6").unwrap();
    fs::write(&path, format!("{head}version 99{rest}")).unwrap();
    refused("has version 99");
    fs::write(&path, good).unwrap();
    let rows = folder.join("out/stations/main_dp075");
    let full = fs::read(&rows).unwrap();
    fs::write(&rows, &full[..full.len() - 1]).unwrap();
    refused("main_dp075 has");
    fs::write(&rows, full).unwrap();
    let output = run(folder, "out", &["--resume"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
}
