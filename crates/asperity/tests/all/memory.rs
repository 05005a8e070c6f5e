//! The memory that a plan foresees is that of the run; a model that no machine can hold is refused before it is built.
#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use crate::common::varied;
use asperity_mechanics::solver::Analyses;
use asperity_plan::bodies::{self, AnyPlan};
use asperity_plan::reading::scene;
use asperity_vary::Change::{Add, With};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn asperity(arguments: &[&str], scene: &Path, out: Option<&Path>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(arguments).arg(scene).env("RAYON_NUM_THREADS", "2");
    if let Some(out) = out {
        command.arg("--out").arg(out);
    }
    command.output().unwrap()
}

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)
}

/// The number before a text.
fn before(text: &str, unit: &str) -> f64 {
    let end = text.find(unit).unwrap_or_else(|| panic!("{unit} is not in\n{text}"));
    text[..end].split_whitespace().next_back().unwrap().parse().unwrap()
}

/// Memory foreseen for a run, and memory used by it \[MB\].
fn memory(scene: &Path, arguments: &[&str]) -> [f64; 2] {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [&["run"], arguments].concat();
    let output = asperity(&arguments, scene, Some(&folder.path().join("out")));
    let text = String::from_utf8(output.stdout).unwrap();
    let size = text.lines().find(|l| l.trim_start().starts_with("size ")).unwrap();
    [before(size, " MB"), before(&text, " MB at most")]
}

#[test]
fn a_plan_foresees_the_memory_of_its_run_within_half_as_much_again() {
    let scenes: [(&str, &[&str]); 6] = [
        ("sandwich.toml", &[]),
        ("sandwich-3d.toml", &[]),
        ("hertz.toml", &[]),
        ("bp1.toml", &["--wall-time", "1 s"]),
        ("bp3.toml", &["--wall-time", "1 s"]),
        ("fault-3d.toml", &["--wall-time", "1 s"]),
    ];
    for (name, arguments) in scenes {
        foreseen(name, &shipped(name), arguments);
    }
}

/// Asserts that the foreseen memory is within a factor of 1.5 of that used.
fn foreseen(name: &str, scene: &Path, arguments: &[&str]) {
    let [foreseen, taken] = memory(scene, arguments);
    let ratio = foreseen / taken;
    println!("{name}: {foreseen} MB foreseen, {taken} MB taken");
    assert!((1.0 / 1.5..=1.5).contains(&ratio), "{name}: {foreseen} MB foreseen, {taken} MB taken");
}

#[test]
fn blocks_in_space_are_foreseen_by_analysis_and_by_counts_with_either_method() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    // 27 783 degrees of freedom are analysed, 65 910 are not.
    for cells in [20, 27] {
        for method in ["direct", "iterative"] {
            std::fs::write(&scene, block(cells, &format!("[solver]\nmethod = \"{method}\""))).unwrap();
            foreseen(&format!("{cells} {method}"), &scene, &["--no-plots"]);
        }
    }
}

#[test]
fn a_plan_of_a_million_cells_neither_assembles_nor_analyses() {
    let plan = bodies::plan(&scene::read(&block(100, "")).unwrap()).unwrap();
    let AnyPlan::Three(plan) = plan else { panic!("a scene in space") };
    let blocks: Vec<_> = plan.problem.model.blocks.iter().map(|b| b.linear().unwrap()).collect();
    assert_eq!(plan.problem.model.mesh.blocks.iter().map(|b| b.len()).sum::<usize>(), 1_000_000);
    assert!(blocks.iter().all(|b| !b.is_made()));
    assert!(matches!(plan.problem.solver.prepared, Analyses::Nothing), "{:?}", plan.problem.solver.method);
    // 576 numbers a cell at least.
    assert!(plan.summary.memory_bytes > 576 * 8 * 1_000_000);
}

#[test]
fn an_explicit_run_takes_the_memory_that_vectors_need_with_and_without_histories() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    let elastic = [
        Add("materials.rock.density", "2700"),
        With("stages[0].duration", "20 us"),
        With("time.stepper", "explicit"),
    ];
    let yielding = Add("materials.rock.plasticity", "{ hardening = \"perfect\", yield = \"9 GPa\" }");
    let plastic = [elastic.as_slice(), &[yielding]].concat();
    for changes in [elastic.as_slice(), &plastic] {
        std::fs::write(&scene, varied(&block(40, ""), changes)).unwrap();
        foreseen("explicit", &scene, &["--no-plots"]);
    }
}

/// A pressed block with this many cells along each axis.
fn block(cells: usize, solver: &str) -> String {
    format!(
        r#"schema = 1
title = "block"
kinematics = "3d"
{solver}
[materials.rock]
young = "50 GPa"
poisson = 0.25
[bodies.A]
mesh.block = {{ min = ["0 m", "0 m", "0 m"], max = ["1 m", "1 m", "1 m"], divisions = [{cells}, {cells}, {cells}], element = "hex8" }}
material = "rock"
[[stages]]
name = "press"
duration = "1 s"
conditions = [{{ set = "A.left", x = "0 m", y = "0 m", z = "0 m" }}, {{ set = "A.right", x = {{ to = "1 mm" }} }}]
[time]
stepper = "implicit"
"#
    )
}

fn refused(text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, text).unwrap();
    let output = asperity(&["check"], &scene, None);
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn what_no_memory_holds_is_refused_from_its_counts_with_its_place() {
    // Twenty-seven million cells: their matrices alone take 130 GB.
    let machine = refused(&block(300, ""));
    assert!(machine.contains("27000000 cells") && machine.contains("scene.toml:9"), "{machine}");
    let direct = refused(&block(120, "[solver]\nmethod = \"direct\""));
    assert!(direct.contains("8.0 GiB") && direct.contains("[solver]"), "{direct}");
    // A limit beyond the memory of any machine does not help.
    let large = refused(&block(120, "[solver]\nmethod = \"direct\"\nmemory = \"4000 GiB\""));
    assert!(large.contains("this machine has") && large.contains("scene.toml:6"), "{large}");
}
