//! The command line: exit codes, messages, and remaining files.
#![allow(clippy::disallowed_methods)]

use crate::common::{SANDWICH, coarse_sandwich as coarse, varied};
use asperity_vary::Change::{Add, With};
use asperity_vary::SceneText;
use std::path::Path;
use std::process::{Command, Output};

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_run_leaves_everything_it_promises() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), coarse()).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for file in [
        "report.json",
        "fields.pvd",
        "fields/bodies_00001.vtu",
        "fields/fault_00001.vtu",
        "profiles/fault_001.csv",
        "probes/fault.csv",
        "plots/mises_1_press.svg",
        "plots/mises_1_press.png",
        "plots/fault_relative_displacement.svg",
        "plots/fault_friction.png",
        "plots/fault_relative_velocity.svg",
    ] {
        assert!(folder.path().join("out/s").join(file).is_file(), "{file} is missing");
    }
    let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["outcome"], "completed");
    assert_eq!(report["scene_sha256"].as_str().unwrap().len(), 64);
    assert!(report["steps"].as_array().unwrap().len() > 10);
}

#[test]
fn without_plots_a_run_leaves_everything_else_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), coarse()).unwrap();
    for arguments in
        [&["run", "s.toml", "--out", "drawn"][..], &["run", "s.toml", "--out", "bare", "--no-plots"]]
    {
        let output = asperity(folder.path(), arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
    }
    let read = |out: &str, file: &str| std::fs::read(folder.path().join(out).join(file)).unwrap();
    for file in ["fields/bodies_00001.vtu", "fields.pvd", "probes/fault.csv", "profiles/fault_001.csv"] {
        assert_eq!(read("drawn", file), read("bare", file), "{file}");
    }
    assert!(folder.path().join("drawn/plots").is_dir());
    assert!(!folder.path().join("bare/plots").exists());
}

#[test]
fn a_scene_of_bodies_prints_its_points_and_forces() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), include_str!("../../../../scenes/cook.toml")).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    for part in [
        "point tip after `shear`: displacement (-10.68508, 23.94941, 0.00000) m",
        "force clamp on `panel.left`",
    ] {
        assert!(printed.contains(part), "{part} is not in\n{printed}");
    }
    assert!(!printed.contains("friction state"), "{printed}");
    for file in ["points/tip.csv", "forces/clamp.csv"] {
        assert!(folder.path().join("out/s").join(file).is_file(), "{file} is missing");
    }
}

#[test]
fn a_report_knows_the_mesh_files_by_their_hash() {
    let folder = tempfile::tempdir().unwrap();
    let scene = |pressure: &str| {
        format!(
            "schema = 1\ntitle = \"a file\"\nkinematics = \"plane-strain\"\n[materials.m]\nyoung = 1e9\npoisson = 0.2\n[bodies.B]\n\
             mesh.gmsh = {{ file = \"m.msh\" }}\nmaterial = \"m\"\n[[stages]]\nname = \"load\"\nduration = 1\nsteps = 1\n\
             conditions = [{{ set = \"B.bottom\", x = 0, y = 0 }}, {{ set = \"B.top\", pressure = {pressure} }}]\n\
             [time]\nstepper = \"implicit\"\n"
        )
    };
    let mesh = include_bytes!("../meshes/two_layers.msh");
    let hash = |mesh: &[u8], pressure: &str| {
        std::fs::write(folder.path().join("m.msh"), mesh).unwrap();
        std::fs::write(folder.path().join("s.toml"), scene(pressure)).unwrap();
        let output = asperity(folder.path(), &["run", "s.toml"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
        let report: serde_json::Value = serde_json::from_str(&report).unwrap();
        report["meshes_sha256"]["inputs/m.msh"].as_str().unwrap().to_string()
    };
    let first = hash(mesh, "1e6");
    assert_eq!(first.len(), 64);
    assert_eq!(hash(mesh, "2e6"), first);
    assert_ne!(hash(&[&mesh[..], b"\n"].concat(), "1e6"), first);
}

#[test]
fn a_report_knows_the_files_of_columns_by_their_hash() {
    let folder = tempfile::tempdir().unwrap();
    let scene = crate::messages::base("fields");
    std::fs::write(folder.path().join("s.toml"), scene).unwrap();
    let table = include_bytes!("../meshes/friction.csv");
    let hash = |table: &[u8]| {
        std::fs::write(folder.path().join("friction.csv"), table).unwrap();
        let output = asperity(folder.path(), &["run", "s.toml", "--force"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
        let report: serde_json::Value = serde_json::from_str(&report).unwrap();
        report["meshes_sha256"]["inputs/friction.csv"].as_str().unwrap().to_string()
    };
    let first = hash(table);
    assert_eq!(first.len(), 64);
    assert_ne!(hash(&[&table[..], b"\n"].concat()), first);
}

/// Two blocks that slip past each other at the rate of their plates, which neither weaken nor strengthen with time.
const STEADY: &str = r#"schema = 1
title = "steady slip"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.A]
material = "rock"
mesh.block = { min = ["-4 km", "-4 km"], max = [0, 0], divisions = [4, 4], element = "quad4" }
[bodies.B]
material = "rock"
mesh.block = { min = [0, "-4 km"], max = ["4 km", 0], divisions = [4, 4], element = "quad4" }
[faults.main]
minus = "A.right"
plus = "B.left"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.010, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
rate = 1e-9
damping = "radiation"
creep = { rate = 1e-9, loading = "backslip" }
[[stages]]
name = "creep"
duration = "100 yr"
conditions = [{ set = "A.left", z = 0 }, { set = "B.right", z = 0 }]
[time]
stepper = "fault-ode"
[output]
points.beside = { body = "B", at = [0, 0] }
forces.side = { set = "B.right" }
"#;

#[test]
fn bodies_beside_a_fault_that_slips_with_its_plates_stay_where_they_are() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), STEADY).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    // In 100 yr the plates move past each other by 3 m.
    let displacement = report["points"][0]["displacement"][2].as_f64().unwrap();
    assert!(displacement.abs() < 1e-6, "{displacement}");
}

#[test]
fn check_prints_the_plan_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), coarse()).unwrap();
    let output = asperity(folder.path(), &["check", "s.toml"]);
    assert!(output.status.success());
    assert!(text(&output.stdout).contains("condensed"));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn a_bad_scene_is_refused_with_its_line_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let negative = varied(&coarse(), &[With("materials.granite.young", "-44.8 GPa")]);
    std::fs::write(folder.path().join("s.toml"), negative).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert_eq!(output.status.code(), Some(1));
    let line = SANDWICH.lines().position(|l| l.contains("44.8 GPa")).unwrap() + 1;
    assert!(text(&output.stderr).contains(&format!("s.toml:{line}:")), "{}", text(&output.stderr));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn an_output_directory_that_cannot_be_written_is_named_before_anything_is_computed() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), coarse()).unwrap();
    std::fs::write(folder.path().join("file"), "no directory").unwrap();
    let output = asperity(folder.path(), &["run", "s.toml", "--out", "file/out"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("file/out"), "{}", text(&output.stderr));
    assert_eq!(std::fs::read_to_string(folder.path().join("file")).unwrap(), "no directory");
}

#[test]
fn a_run_that_cannot_go_on_keeps_its_last_good_state_and_says_so() {
    // The law weakens by sigma (b - a)/L = 2e13 Pa/m, twenty times the stiffness of the blocks: quasi-static equilibrium
    // ceases to exist when slip begins.
    let law = r#"{ kind = "rate-and-state", evolution = "slip", mu0 = 0.6, a = 0.005, b = 0.2, l = "0.1 um", v_ref = "1e-3 mm/s", v_initial = "1e-6 mm/s" }"#;
    let weak = varied(
        &coarse(),
        &[With("interfaces.fault.law", law), Add("interfaces.fault.under_resolved", "allow")],
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), weak).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("stopped: stage `shear`"), "{}", text(&output.stderr));
    let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
    assert!(report.contains("stopped"));
    assert!(folder.path().join("out/s/fields.pvd").is_file());
}

const SLIDER: &str = include_str!("../../../../scenes/spring-slider.toml");

#[test]
fn a_run_of_a_spring_slider_leaves_everything_it_promises() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SLIDER).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for file in [
        "report.json",
        "events.csv",
        "history/block.csv",
        "plots/sliders_friction_slip.svg",
        "plots/sliders_traction_load.png",
        "plots/sliders_friction.svg",
        "plots/sliders_friction.png",
        "plots/sliders_relative_displacement.svg",
        "plots/sliders_relative_velocity.png",
    ] {
        assert!(folder.path().join("out/s").join(file).is_file(), "{file} is missing");
    }
    let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["outcome"], "completed");
    assert_eq!(report["events"].as_array().unwrap().len(), 10);
}

#[test]
fn check_of_a_spring_slider_prints_the_plan_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SLIDER).unwrap();
    let output = asperity(folder.path(), &["check", "s.toml"]);
    assert!(output.status.success());
    assert!(text(&output.stdout).contains("spring-slider, quasi-static with radiation damping"));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn a_bad_output_directory_of_a_spring_slider_is_named_before_anything_is_computed() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SLIDER).unwrap();
    std::fs::write(folder.path().join("file"), "no directory").unwrap();
    let output = asperity(folder.path(), &["run", "s.toml", "--out", "file/out"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("file/out"), "{}", text(&output.stderr));
    assert!(!text(&output.stdout).contains("results"));
}

#[test]
fn a_block_that_friction_cannot_hold_stops_at_its_limit_with_that_state_in_the_files() {
    let folder = tempfile::tempdir().unwrap();
    let scene = include_str!("../../../../verification/cases/contact_hard/scene.toml");
    // The shear tractions of the sides, which balance.
    let more = [
        ("[0].traction[0].to", "0.55 MPa"),
        ("[1].traction[1].to", "0.55 MPa"),
        ("[2].traction[1].to", "-0.55 MPa"),
        ("[3].traction[1].to", "0.55 MPa"),
        ("[4].traction[1].to", "-0.55 MPa"),
    ];
    let beyond = |scene: SceneText, (path, value): (&str, &str)| {
        scene.with(&format!("stages[1].conditions{path}"), value)
    };
    let scene = more.into_iter().fold(SceneText::new(scene), beyond).text().unwrap();
    std::fs::write(folder.path().join("s.toml"), scene).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let told = text(&output.stderr);
    for part in ["stage `shear`", "body `upper`", "motion in x"] {
        assert!(told.contains(part), "{part} is not in\n{told}");
    }
    let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let time = report["outcome"]["stopped"]["time"].as_f64().unwrap();
    // The load reaches the strength of friction after 1/1.1 of the second stage.
    assert!((time - (1.0 + 1.0 / 1.1)).abs() < 1e-9, "{time}");
    let fields = std::fs::read_to_string(folder.path().join("out/s/fields.pvd")).unwrap();
    assert!(fields.contains(&format!("timestep=\"{time}\"")), "{time} is not in\n{fields}");
}

#[test]
fn a_slider_that_runs_away_keeps_its_last_good_state_and_is_told_what_it_needs() {
    let folder = tempfile::tempdir().unwrap();
    let undamped: Vec<&str> = SLIDER.lines().filter(|l| !l.starts_with("damping")).collect();
    std::fs::write(folder.path().join("s.toml"), undamped.join("\n")).unwrap();
    let output = asperity(folder.path(), &["run", "s.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let told = text(&output.stderr);
    assert!(told.contains("outruns shear waves") && told.contains("`damping = \"radiation\"`"), "{told}");
    let report = std::fs::read_to_string(folder.path().join("out/s/report.json")).unwrap();
    assert!(report.contains("stopped"));
    assert!(folder.path().join("out/s/history/block.csv").is_file());
}
