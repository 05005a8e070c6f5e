//! Runs of spring-sliders that are interrupted at each restart and resumed: their results are those of an uninterrupted
//! run, bit for bit.
#![allow(clippy::disallowed_methods)]

use crate::common::sliders::{CYCLE, plan};
use crate::common::told;
use crate::resume::{assert_same, files, folder, run, text};
use asperity::checkpoint::{self, Pauses};
use asperity::keep::{Keeper, Place};
use asperity::kinds::sliders::Outputs;
use asperity_cycles::slider::{Problem, SliderRun, resume};
use asperity_ode::{Method, Outcome};
use asperity_output::figures::FigureRequest;
use asperity_vary::Change::{self, Add, With, WithOrSame};
use asperity_vary::SceneText;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// A second block on a spring to the first one.
const CHAIN: [Change<'_>; 2] = [
    Add(
        "sliders.far",
        r#"{ normal = "4 MPa", stiffness = "0.8 GPa/m", damping = "5 MPa s/m", law = { kind = "rate-and-state", evolution = "slip", mu0 = 0.6, a = 0.010, b = 0.014, l = "20 um", v_ref = "1 um/s", v_initial = "1 um/s" }, start = "0.5 um/s" }"#,
    ),
    Add("springs", r#"[{ between = ["block", "far"], stiffness = "0.3 GPa/m" }]"#),
];
/// Jumps of the rate of the load point: the integration restarts at each of them, and the displacement continues.
const JUMPS: Change<'_> = With(
    "load.rate",
    r#"{ table = [["0 s", "1 um/s"], ["600 s", "1 um/s"], ["600 s", "3 um/s"], ["1200 s", "3 um/s"], ["1200 s", "0.5 um/s"]] }"#,
);
const IMPOSED: [Change<'_>; 2] = [
    Add(
        "sliders.machine",
        r#"{ normal = "1 MPa", rate = { mean = "1 um/s", amplitude = "0.5 um/s", period = "90 s" }, law = { kind = "rate", mu0 = 0.6, a = 0.01, v_ref = "1 um/s" } }"#,
    ),
    Add("springs", r#"[{ between = ["block", "machine"], stiffness = "0.5 GPa/m" }]"#),
];
const ROWS: Change<'_> = Add("output", r#"{ interval = "12.5 s", times = ["7 s", "1111 s"], change = 0.5 }"#);
const RESTS: Change<'_> = Add("sliders.block.mass", "3000 kg/m^2");
const MANY: [Change<'_>; 3] =
    [With("time.end", "60000 s"), With("events.stop_after", "40"), Add("time.tolerance", "1e-10")];

fn scene(changes: &[&[Change<'_>]]) -> String {
    let varied = changes.iter().fold(SceneText::new(CYCLE), |scene, changes| scene.changed(changes));
    varied.text().unwrap()
}

fn pauses(wall: Option<Duration>) -> Pauses {
    let stop = Arc::new(AtomicBool::new(false));
    Pauses { every: Duration::MAX, wall, stop, begun: Instant::now() }
}

/// Runs a part of a run into `out`, until the next restart or to the end. Returns the run, and true if it was
/// interrupted.
fn part(problem: &Problem, out: &Path, wall: Option<Duration>) -> Result<(SliderRun, bool), String> {
    let place = Place { out, physics: "", drawn: true, pauses: pauses(wall) };
    let resumed = Keeper::<Outputs>::resume(problem, place.clone()).map_err(|e| e.to_string())?;
    let (mut keeper, from) = match resumed {
        Some(resumed) => resumed,
        None => (Keeper::begin(problem, place).unwrap(), SliderRun::new(problem)),
    };
    let ended = resume(problem, from, &mut keeper).map_err(|e| e.to_string())?;
    let interrupted = keeper.interrupted().is_some();
    let sheet = keeper.finish(!interrupted).complete().unwrap().sheet(problem, &[], ended.at.seconds());
    sheet.draw(out, &out.join("plots"), &FigureRequest::default()).unwrap();
    if !interrupted {
        checkpoint::remove(out).unwrap();
    }
    Ok((ended, interrupted))
}

/// Runs a scene as a whole and in as many parts as it has restarts, and compares the results. Returns the number of
/// parts.
fn interrupted_everywhere(name: &str, text: &str) -> usize {
    let problem = Problem { restart: 4096, ..plan(text) };
    let folder = tempfile::tempdir().unwrap();
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    let (expected, _) = part(&problem, &whole, None).unwrap();
    assert!(!matches!(expected.outcome, Outcome::Failed { .. }), "{name}: {:?}", expected.outcome);
    // Errors of one tolerance of ln V per step, times a/f of a sixtieth, if all have the same sign.
    let imbalance = expected.progress.budget.unwrap().energy().imbalance();
    let most = problem.tolerance / 60.0 * expected.counts.steps as f64;
    assert!(imbalance < most, "{name}: energy closes to {imbalance:e} of {most:e}");
    let mut count = 1;
    let found = loop {
        let (run, interrupted) = part(&problem, &parts, Some(Duration::ZERO)).unwrap();
        if !interrupted {
            break run;
        }
        count += 1;
    };
    assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{name}");
    assert_eq!(files(&parts), files(&whole), "{name}");
    count
}

#[test]
fn every_method_resumes_bit_for_bit() {
    for method in Method::ALL {
        // Methods of low order take enough steps at a loose tolerance already.
        let tolerance = if matches!(method, Method::TrBdf2 | Method::Esdirk34) { "1e-6" } else { "1e-10" };
        let method = Add("time.method", &format!("\"{}\"", method.name()));
        let text = scene(&[&MANY, &[method, WithOrSame("time.tolerance", tolerance)]]);
        let parts = interrupted_everywhere(&format!("{method:?}"), &text);
        assert!(parts >= 2, "{method:?}: {parts} parts");
    }
}

#[test]
fn chains_breaks_imposed_rates_and_rows_at_times_resume_bit_for_bit() {
    for (name, changes, least) in [
        ("chain", [&MANY[..], &CHAIN, &[]], 3),
        ("jumps", [&MANY, &[JUMPS], &[]], 4),
        ("imposed", [&MANY, &IMPOSED, &[ROWS]], 2),
        ("rows", [&MANY, &[JUMPS, ROWS], &CHAIN], 4),
        ("mass", [&MANY, &[RESTS, ROWS], &[]], 3),
    ] {
        let parts = interrupted_everywhere(name, &scene(&changes));
        assert!(parts >= least, "{name}: {parts} parts");
    }
}

/// Replaces the value at a path of the checkpoint in `out`.
fn forget(out: &Path, pointer: &str, value: Value) {
    let file = out.join("checkpoint");
    let before = fs::read_to_string(&file).unwrap();
    let [kind, _, contents] = before.splitn(3, '\n').collect::<Vec<_>>()[..] else { panic!("{before}") };
    let mut json: Value = serde_json::from_str(contents).unwrap();
    let place = json.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer} in {contents}"));
    assert!(*place != value, "{pointer} is {value} already");
    *place = value;
    let contents = json.to_string();
    let sum: String = Sha256::digest(&contents).iter().map(|b| format!("{b:02x}")).collect();
    fs::write(&file, format!("{kind}\n{sum}\n{contents}\n")).unwrap();
}

#[test]
fn what_a_checkpoint_holds_is_needed() {
    let problem = Problem { restart: 4096, ..plan(&scene(&[&MANY, &[JUMPS, ROWS]])) };
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let (expected, _) = part(&problem, &whole, None).unwrap();
    let expected = (format!("{expected:?}"), files(&whole));
    let forgotten: [(&str, Value); 9] = [
        ("/state/run/next_step/length", 1e-3.into()),
        ("/state/run/progress/travelled/load", 0.into()),
        ("/state/run/progress/due/interval", 0.into()),
        ("/state/run/progress/due/listed", 0.into()),
        ("/state/run/counts/steps", 0.into()),
        ("/state/run/progress/budget/driven", 0.into()),
        ("/state/run/progress/budget/energy/radiated", 0.into()),
        ("/state/run/progress/detectors/0/least", 1.into()),
        ("/state/histories/sliders/0/thin/last", Value::Null),
    ];
    for (i, (pointer, value)) in forgotten.into_iter().enumerate() {
        let out = folder.path().join(i.to_string());
        // Beyond the jumps, and then to a restart between two of them.
        loop {
            assert!(part(&problem, &out, Some(Duration::ZERO)).unwrap().1, "{pointer}");
            let contents = fs::read_to_string(out.join("checkpoint")).unwrap();
            let json: Value = serde_json::from_str(contents.lines().nth(2).unwrap()).unwrap();
            if json["state"]["run"]["progress"]["passed"] == 2 && !json["state"]["run"]["next_step"].is_null()
            {
                break;
            }
        }
        forget(&out, pointer, value);
        let left = part(&problem, &out, None).map(|(run, _)| (format!("{run:?}"), files(&out)));
        assert!(left.is_err() || left.is_ok_and(|left| left != expected), "{pointer} is not needed");
    }
}

#[test]
fn the_command_interrupts_and_resumes_spring_sliders() {
    let longer: [&[Change<'_>]; 3] = [&MANY, &CHAIN, &[JUMPS]];
    let (scene, pressed) =
        (scene(&longer), scene(&[longer[0], longer[1], longer[2], &[With("sliders.far.normal", "4.5 MPa")]]));
    let folder = folder(&scene);
    let folder = folder.path();
    let output = run(folder, "whole", &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let output = run(folder, "out", &["--wall-time", "0 s"]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    assert!(told(&output).contains("the same command with --resume"), "{}", told(&output));
    // Another scene, and another kind of run.
    fs::write(folder.join("s.toml"), pressed).unwrap();
    let output = run(folder, "out", &["--resume"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("is of another scene"), "{}", told(&output));
    fs::write(folder.join("s.toml"), crate::common::cycles::SCENE).unwrap();
    let output = run(folder, "out", &["--resume"]);
    assert_eq!(output.status.code(), Some(1));
    let why = "is of a run of spring-sliders, and the scene is of faults";
    assert!(told(&output).contains(why), "{}", told(&output));
    fs::write(folder.join("s.toml"), scene).unwrap();
    let output = run(folder, "out", &["--resume"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("resumed at"), "{}", text(&output.stdout));
    assert_same(folder, "out");
    let output = run(folder, "out", &["--resume"]);
    assert!(text(&output.stdout).contains("is complete: nothing to resume"), "{}", text(&output.stdout));
}
