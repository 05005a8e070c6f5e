//! Faults in homogeneous rock without bodies, and patches of parameters.

use crate::resume::{assert_same, folder, run, text};
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::SceneText;
use std::fs;
use std::path::Path;

const BP1: &str = include_str!("../../../../scenes/bp1-half-space.toml");
const BP5: &str = include_str!("../../../../scenes/bp5.toml");

fn plan(scene: SceneText) -> Plan {
    match plan_scene(&scene::read(&scene.text().unwrap()).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

/// BP5 with cells of 4 km.
fn coarse() -> SceneText {
    SceneText::new(BP5)
        .with("faults.main.rectangle.size", "4 km")
        .add("faults.main.under_resolved", "allow")
        .with("output.stations", "{ main = [[0, 0, 0]] }")
}

/// Tractions at all points of uneven slip: shear, component by component, then normal.
fn tractions(plan: &Plan) -> Vec<f64> {
    let operator = &plan.problem.fault.operator;
    let (n, parts) = (operator.points(), operator.components());
    let smooth = |k: usize| {
        let [x, y, z] = plan.points[k % n].at;
        (1e-4 * (x + 2.0 * y - 3.0 * z) + (k / n) as f64).sin()
    };
    let slip: Vec<f64> = (0..parts * n).map(smooth).collect();
    [operator.shear_of(&slip), operator.normal_of(&slip)].concat()
}

/// Largest difference of the tractions of points at the same positions, over the largest traction.
fn difference(a: &Plan, b: &Plan) -> f64 {
    let (ta, tb, n) = (tractions(a), tractions(b), a.points.len());
    assert_eq!(n, b.points.len());
    let same = |p: usize| {
        let close = |q: &usize| a.points[p].at.iter().zip(b.points[*q].at).all(|(x, y)| (x - y).abs() < 1e-6);
        (0..n).find(close).unwrap()
    };
    let scale = ta.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let off = |p: usize| {
        let q = same(p);
        (0..ta.len() / n).map(move |part| (part * n + p, part * n + q))
    };
    (0..n).flat_map(off).map(|(k, j)| (ta[k] - tb[j]).abs()).fold(0.0, f64::max) / scale
}

#[test]
fn a_rectangle_in_two_parts_that_meet_is_the_whole_one() {
    let dipping = || {
        let scene = coarse().without("output.platform").with("faults.main.patches", "[]");
        scene.add("faults.main.rectangle.dip", "40 deg")
    };
    let half = |name: &str, scene: SceneText, from: &str, to: &str| {
        let path = |key: &str| format!("faults.{name}.rectangle.{key}");
        scene
            .with_or_same(&path("from"), format!("[\"0 km\", \"0 km\", \"{from}\"]"))
            .with_or_same(&path("to"), format!("[\"0 km\", \"0 km\", \"{to}\"]"))
    };
    let whole = half("main", dipping(), "48 km", "-48 km");
    let first = half("main", dipping(), "48 km", "-12 km").text().unwrap();
    // The table of the second part, with a name of its own.
    let second = half("main", dipping(), "-12 km", "-48 km").text().unwrap();
    let table = second.split("[faults.main]").nth(1).unwrap().split("[[stages]]").next().unwrap();
    let two = first.split("[[stages]]").collect::<Vec<_>>();
    let two = format!("{}[faults.more]{table}[[stages]]{}", two[0], two[1]);
    let (whole, two) = (plan(whole), plan(SceneText::new(&two)));
    assert_eq!(two.faults.len(), 2);
    // Rounding of positions, some 1e-12 m, over the distance of cells, and the tolerance of the compressed operator.
    let off = difference(&whole, &two);
    assert!(off < 1e-9, "{off:e}");
}

#[test]
fn an_operator_of_lines_does_not_depend_on_the_direction_of_the_trace() {
    let line = |trace: &str| {
        let scene =
            SceneText::new(BP1).with("kinematics", "plane-strain").with("faults.main.line.spacing", "1 km");
        let scene = scene.add("faults.main.line.interpolation", "polyline");
        plan(scene.with("faults.main.line.trace", trace).add("faults.main.under_resolved", "allow"))
    };
    let down = line("[[0, 0], [\"8 km\", \"-14 km\"], [\"30 km\", \"-20 km\"]]");
    let up = line("[[\"30 km\", \"-20 km\"], [\"8 km\", \"-14 km\"], [0, 0]]");
    let along = |plan: &Plan| plan.points.iter().map(|p| (p.along, p.normal)).collect::<Vec<_>>();
    assert!(along(&down).windows(2).all(|w| w[0].0 < w[1].0));
    // The plus side is the hanging wall from either direction.
    assert!(along(&up).iter().chain(&along(&down)).all(|p| p.1[1] > 0.0 && p.1[0] > 0.0));
    let off = difference(&down, &up);
    assert!(off < 1e-6, "{off:e}");
}

#[test]
fn patches_give_bp5_the_tractions_of_its_description() {
    let plan = plan(coarse().with("faults.main.rectangle.size", "2 km"));
    let at = |y: f64, z: f64| {
        let close =
            |p: &&asperity_plan::faults::PointView| (p.at[1] - y).abs() < 1.0 && (p.at[2] - z).abs() < 1.0;
        let point = plan.points.iter().find(close).unwrap();
        let p = plan.points.iter().position(|q| q == point).unwrap();
        let fault = &plan.problem.fault;
        let friction = fault.normal[p] * fault.law.scale(p) * plan.problem.start[p];
        let rate = fault.slip_rates(&plan.problem.start).component(0)[p];
        let (a, length) = (fault.law.scale(p), fault.law.length(p).unwrap());
        (1e-6 * (friction + fault.damping[p] * rate), a, length, rate)
    };
    // The published initial tractions in MPa: core, rim and seed. Between core and rim a is linear.
    for ((y, z), traction, a, length, rate) in [
        ((-9.0, 1.0), 19.490_041, 0.004, 0.14, 1e-9),
        ((-25.0, 1.0), 13.273_061, 0.04, 0.14, 1e-9),
        ((-9.0, -23.0), 21.350_445, 0.004, 0.13, 0.03),
        ((-17.0, 1.0), f64::NAN, 0.022, 0.14, 1e-9),
        ((-3.0, 31.0), f64::NAN, 0.022, 0.14, 1e-9),
    ] {
        let found = at(1e3 * y, 1e3 * z);
        assert!(traction.is_nan() || (found.0 - traction).abs() < 5e-7, "{found:?}");
        assert!((found.1 / a - 1.0).abs() < 1e-12 && (found.2 / length - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.3 / rate - 1.0).abs() < 1e-9, "{found:?}");
    }
}

#[test]
fn patches_combine_by_their_order_or_their_size() {
    let a_of = |patches: &str| {
        let scene =
            SceneText::new(BP1).with("faults.main.line.spacing", "2 km").without("faults.main.profiles");
        let plan = plan(scene.add("faults.main.patches", patches).add("faults.main.under_resolved", "allow"));
        (0..plan.points.len()).map(|p| plan.problem.fault.law.scale(p)).collect::<Vec<f64>>()
    };
    let upper = "box = { y = { from = \"-10 km\" } }";
    let disc = "disc = { centre = [0, \"-10 km\"], radius = \"4.5 km\" }";
    // Points at 1, 3, .. km; those at 7, 9, 11 and 13 km lie in the disc.
    let found = a_of(&format!("[{{ {upper}, a = 0.02 }}, {{ {disc}, a = 0.015 }}]"));
    assert_eq!(found[..8], [0.02, 0.02, 0.02, 0.015, 0.015, 0.015, 0.015, 0.01]);
    let found = a_of(&format!("[{{ {upper}, a = 0.02 }}, {{ {disc}, a = 0.015, combine = \"largest\" }}]"));
    assert_eq!(found[..8], [0.02, 0.02, 0.02, 0.02, 0.02, 0.015, 0.015, 0.01]);
    let found = a_of(&format!("[{{ {upper}, a = 0.02 }}, {{ {disc}, a = 0.005, combine = \"smallest\" }}]"));
    assert_eq!(found[..8], [0.02, 0.02, 0.02, 0.005, 0.005, 0.005, 0.005, 0.01]);
    // From 10 km down, 4 km wide.
    let found = a_of(&format!("[{{ {upper}, a = 0.02, edge = \"4 km\" }}]"));
    for (found, wanted) in found[4..8].iter().zip([0.02, 0.0175, 0.0125, 0.01]) {
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
    }
}

#[test]
fn a_run_in_a_medium_is_gone_on_with() {
    let scene = coarse().with("events.stop_after", "2").text().unwrap();
    let place = folder(&scene);
    let whole = run(place.path(), "whole", &[]);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    fs::write(place.path().join("s.toml"), coarse().with("events.stop_after", "1").text().unwrap()).unwrap();
    assert!(run(place.path(), "parts", &[]).status.success());
    fs::write(place.path().join("s.toml"), &scene).unwrap();
    let resumed = run(place.path(), "parts", &["--resume"]);
    assert!(resumed.status.success(), "{}", text(&resumed.stderr));
    assert_same(place.path(), "parts");
}

/// Numbers of the last row of a file of the platform.
fn last_row(place: &Path, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(place.join("out/platform").join(name)).unwrap();
    let row = text.lines().last().unwrap();
    row.split(' ').map(|word| word.parse().unwrap()).collect()
}

#[test]
fn files_of_the_platform_do_not_change_when_the_scene_turns() {
    let scene = coarse()
        .with("events.stop_after", "1")
        .with("output.stations", "{ main = [[0, \"-10 km\", \"-24 km\"]] }")
        .with("output.receivers", "{ a = [\"8 km\", 0, \"-16 km\"] }");
    // About the vertical by 180 degrees.
    let turned = scene
        .clone()
        .with("faults.main.rectangle.from", "[0, 0, \"-50 km\"]")
        .with("faults.main.rectangle.to", "[0, 0, \"50 km\"]")
        .with("faults.main.rake", "[0, 0, -1]")
        .with("faults.main.patches[1].box.z", "{ from = \"18 km\", to = \"30 km\" }")
        .with("output.stations", "{ main = [[0, \"-10 km\", \"24 km\"]] }")
        .with("output.receivers", "{ a = [\"-8 km\", 0, \"16 km\"] }");
    let places = [scene, turned].map(|scene| {
        let place = folder(&scene.text().unwrap());
        let done = run(place.path(), "out", &["--no-plots"]);
        assert!(done.status.success(), "{}", text(&done.stderr));
        place
    });
    let names = ["fltst_strk-24dp+10.txt", "blkst_strk-16fn+08dp+00.txt", "global.dat", "rupture.dat"];
    for name in names {
        let [a, b] = places.each_ref().map(|place| last_row(place.path(), name));
        let near = a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= 1e-4 * a.abs().max(1e-3));
        assert!(a.len() == b.len() && near, "{name}: {a:?} {b:?}");
    }
    // Both sides move along strike, the plus side forwards.
    let [on, beside] = [names[0], names[1]].map(|name| last_row(places[0].path(), name));
    assert!(on[1] > 1.0 && beside[2] > 0.1 * on[1], "{on:?} {beside:?}");
    assert_eq!([on.len(), beside.len()], [8, 7]);
}

/// A fault of triangles that slips at once.
fn triangle_scene() -> SceneText {
    let page = include_str!("../../../../docs/src/messages/triangles.md");
    let base = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    SceneText::new(base)
        .with("faults.main.rate", "1e-3 m/s")
        .with("stages[0].duration", "20 s")
        .add("output", "{ stations = { main = [[0, \"-1 km\", 0]] } }")
}

#[test]
fn a_fault_of_triangles_writes_fields_in_its_triangles_and_resumes() {
    let scene = triangle_scene().with("stages[0].duration", "2000 yr").text().unwrap();
    let here = folder(&scene);
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    fs::copy(meshes.join("fault.stl"), here.path().join("fault.stl")).unwrap();
    let whole = run(here.path(), "whole", &[]);
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    let report = fs::read_to_string(here.path().join("whole/report.json")).unwrap();
    assert!(report.contains("\"inputs/fault.stl\""), "{report}");
    let fields = fs::read(here.path().join("whole/fields/main_end.vtu")).unwrap();
    assert!(text(&fields).contains("NumberOfPoints=\"6\" NumberOfCells=\"4\""));
    assert_eq!(run(here.path(), "part", &["--wall-time", "0 s"]).status.code(), Some(3));
    let rest = run(here.path(), "part", &["--resume"]);
    assert!(rest.status.success(), "{}", text(&rest.stderr));
    assert_same(here.path(), "part");
}

#[test]
fn the_plus_side_of_triangles_is_the_hanging_wall_however_the_file_orients_them() {
    let of = |swap: bool| {
        let here = tempfile::tempdir().unwrap();
        let corners = [[0, 0, 2000], [1000, -1000, 2000], [1000, -1000, 0], [0, 0, 0]];
        let mut file = "solid s\n".to_string();
        for (k, [a, b, c]) in [[0, 1, 2], [0, 2, 3]].into_iter().enumerate() {
            let order = if swap == (k == 0) { [a, b, c] } else { [b, a, c] };
            file += "facet\n";
            for [x, y, z] in order.map(|n: usize| corners[n]) {
                file += &format!("vertex {x} {y} {z}\n");
            }
            file += "endfacet\n";
        }
        fs::write(here.path().join("fault.stl"), file + "endsolid s\n").unwrap();
        let scene = triangle_scene().text().unwrap();
        match plan_scene(&scene::read_in(&scene, here.path()).unwrap()).unwrap() {
            ScenePlan::Faults(plan) => *plan,
            ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
        }
    };
    for swap in [false, true] {
        let plan = of(swap);
        assert!(plan.points.iter().all(|p| p.normal[0] > 0.7 && p.normal[1] > 0.7));
        assert!(plan.notes.iter().any(|note| note.ends_with("against the others: 1")), "{:?}", plan.notes);
    }
}
