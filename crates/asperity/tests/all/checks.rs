//! Checks of plans: what `asperity check` prints, and the numbers in it against closed forms.
#![allow(clippy::disallowed_methods)]

use crate::common::coarse_sandwich as coarse;
use asperity_plan::ScenePlan;
use asperity_plan::reading::scene;
use asperity_plan::shared::checks::Checks;
use asperity_plan::sliders::planner;
use asperity_vary::SceneText;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn check(folder: &Path, scene: &str, flags: &[&str]) -> Output {
    std::fs::write(folder.join("s.toml"), scene).unwrap();
    let arguments = ["check", "s.toml"].iter().chain(flags);
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn checks(text: &str) -> Checks {
    match asperity_plan::plan_scene(&scene::read(text).unwrap()).unwrap() {
        ScenePlan::Bodies(plan) => plan.checks().clone(),
        ScenePlan::Faults(plan) => plan.checks,
        ScenePlan::Dynamic(plan) => plan.checks().clone(),
    }
}

fn close(found: f64, expected: f64, share: f64) {
    assert!((found / expected - 1.0).abs() <= share, "{found} {expected}");
}

const STICK_SLIP: &str = include_str!("../../../../scenes/stick-slip.toml");
const MEDIUM: &str = include_str!("../../../../scenes/bp5.toml");
const SLIDER: &str = include_str!("../../../../scenes/spring-slider.toml");

#[test]
fn json_has_the_checks_and_strict_refuses_warnings() {
    let folder = tempfile::tempdir().unwrap();
    let output = check(folder.path(), &coarse(), &["--json", "--strict"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["kind"], "bodies");
    assert_eq!(found["checks"]["bodies"][0]["body"], "A");
    assert_eq!(found["warnings"].as_array().unwrap().len(), 0);
    let doubtful = include_str!("../doubtful_scenes/soft_penalty.toml");
    let output = check(folder.path(), doubtful, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let output = check(folder.path(), doubtful, &["--strict"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("`--strict` accepts none"), "{}", text(&output.stderr));
}

#[test]
fn meshes_are_drawn_into_files_of_a_known_kind() {
    let folder = tempfile::tempdir().unwrap();
    for (file, begins) in [("mesh.png", &b"\x89PNG"[..]), ("mesh.svg", b"<svg")] {
        let output = check(folder.path(), &coarse(), &["--plot", file]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(std::fs::read(folder.path().join(file)).unwrap().starts_with(begins), "{file}");
    }
    let refused = check(folder.path(), &coarse(), &["--plot", "mesh.pdf"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stderr).contains(".png or .svg"), "{}", text(&refused.stderr));
    let refused = check(folder.path(), SLIDER, &["--plot", "mesh.png"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stderr).contains("no mesh"), "{}", text(&refused.stderr));
}

#[test]
fn a_block_has_the_cells_faces_and_extent_that_it_was_given() {
    // 25 x 50 mm and 50 x 50 mm in squares of 2.5 mm.
    let found = checks(STICK_SLIP);
    let bodies: Vec<_> = found.bodies.iter().map(|b| (b.body.as_str(), b.nodes, b.cells)).collect();
    assert_eq!(bodies, [("left", 11 * 21, 200), ("middle", 21 * 21, 400), ("right", 11 * 21, 200)]);
    assert_eq!([&found.bodies[1].from, &found.bodies[1].to], [&[0.025, 0.0], &[0.075, 0.05]]);
    found.bodies.iter().flat_map(|b| b.edges).for_each(|edge| close(edge, 2.5e-3, 1e-12));
    let set = |name: &str| found.sets.iter().find(|s| s.set == name).unwrap();
    let top = set("middle.top");
    assert_eq!((top.faces, &top.used[..]), (20, &["held".to_string(), "drawn by a spring".into()][..]));
    close(top.area, 0.05, 1e-12);
    assert_eq!(set("left.left").faces, 20);
}

#[test]
fn a_machine_drives_all_interfaces_of_its_block_and_is_critical_at_k_l_over_b_minus_a() {
    // Two interfaces of 50 mm share the spring of 1e10 N/m per metre; b - a = 0.015, L = 2 um.
    let found = checks(STICK_SLIP);
    for interface in &found.interfaces {
        let machine = interface.machine.unwrap();
        close(machine.stiffness, 1e10 / 0.1, 1e-12);
        close(machine.critical_normal.unwrap(), 1e11 * 2e-6 / 0.015, 1e-12);
        assert_eq!(machine.critical, None);
    }
    // Without the spring there is no machine.
    let driven = SceneText::new(STICK_SLIP).with("stages[2].conditions[0].y", "{ rate = \"-1 um/s\" }");
    assert!(checks(&driven.text().unwrap()).interfaces.iter().all(|i| i.machine.is_none()));
}

#[test]
fn points_of_patches_and_stations_are_those_of_the_cells() {
    // Cells of 1 km around centres at half kilometres. The core is 12 x 60 km with an edge of 2 km, the seed 12 x 12 km.
    let found = checks(MEDIUM);
    let fault = &found.faults[0];
    let patches: Vec<_> = fault.patches.iter().map(|p| (p.points, p.edge)).collect();
    assert_eq!(patches, [(12 * 60, 16 * 64 - 12 * 60), (12 * 12, 0)]);
    assert_eq!((fault.points, fault.prescribed), (4000, 0));
    close(fault.area, 100e3 * 40e3, 1e-12);
    // b > a up to a share (0.03 - 0.004)/(0.04 - 0.004) = 0.72 of the edge, which includes centres 0.5 km out and not 1.5 km.
    assert_eq!(fault.weakening_points, 14 * 62);
    // Stations lie on corners of cells or between two, and at the surface half a cell above a centre.
    let off: Vec<f64> = fault.stations.iter().map(|s| s.off).collect();
    off.iter().for_each(|off| close(*off, 500.0 * 2f64.sqrt(), 1e-12));
    // Loads drive it along its rate.
    assert!(fault.loading.unwrap() > 0.0);
}

#[test]
fn a_slider_has_the_critical_stiffness_of_its_law() {
    let plan = planner::read(SLIDER).unwrap();
    let [slider] = &plan.checks.sliders[..] else { panic!() };
    close(slider.stiffness, 1.25e9, 1e-12);
    // f_n (b - a)/L = 5 MPa x 0.005/10 um, less the radiation damping at 1 um/s: 2e-4 of it.
    close(slider.critical, 2.5e9, 3e-4);
    assert!(slider.unstable);
}

#[test]
fn the_time_of_a_step_follows_from_counts_and_the_steps_are_those_of_the_run() {
    let waves = crate::dynamic::SCENE;
    let cost = checks(waves).cost;
    // 800 cells of eight degrees of freedom, and at most 21 points of the fault.
    let cells = 30e-6 + 6400.0 * 2.5e-9;
    let seconds = cost.step_seconds.unwrap();
    assert!((cells..cells + 21.0 * 300e-9).contains(&seconds), "{seconds}");
    let folder = crate::resume::folder(waves);
    let output = crate::resume::run(folder.path(), "out", &["--no-plots"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report = std::fs::read(folder.path().join("out/report.json")).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    // What happens at the end of the last step is known after one more.
    assert_eq!(report["counts"]["steps"].as_u64().unwrap() as usize, cost.steps.unwrap() + 1);
    for (scene, part) in [
        (SLIDER, "steps unknown, since errors decide them; time about 31 us a step, 31 ms per 1000 steps"),
        (waves, " a step, "),
        (include_str!("../../../../scenes/cook.toml"), "time unknown until the run shows its progress"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let output = check(folder.path(), scene, &[]);
        assert!(text(&output.stdout).contains(part), "{part}: {}", text(&output.stdout));
    }
    let faults = |size: &str| {
        let scene = SceneText::new(crate::common::cycles::SCENE);
        let scene = scene.with("bodies.crust.mesh.fault.spacing[0][1]", size);
        checks(&scene.text().unwrap()).cost.step_seconds.unwrap()
    };
    let [coarse, fine] = ["800 m", "400 m"].map(faults);
    assert!(fine > coarse && fine < 4.0 * coarse, "{coarse} {fine}");
}
