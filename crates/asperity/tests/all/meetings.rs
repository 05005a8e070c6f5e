//! Bodies that meet where nothing joins them, and loads that act twice on one face.

use asperity_plan::ScenePlan;
use asperity_plan::reading::scene;

/// Two blocks of these kinematics and elements beside each other, the second at `from`; each is held at its bottom and pressed on
/// its top.
fn scene(space: bool, from: &str, joins: &str, conditions: &str) -> String {
    let (kinematics, element, zeros, size, far, divisions) = if space {
        ("3d", "hex8", r#", "0 m""#, r#", "1 m""#, ", z = 0", "[5, 4, 3]")
    } else {
        ("plane-strain", "quad4", "", "", "", "[5, 4]")
    };
    let block = |from: &str, to: &str| {
        format!(
            r#"mesh.block = {{ min = ["{from}", "0 m"{zeros}], max = ["{to}", "1 m"{size}], divisions = {divisions}, element = "{element}" }}"#
        )
    };
    let (a, b) = (block("0 m", "1 m"), block(from, "4 m"));
    format!(
        r#"
schema = 1
title = "blocks"
kinematics = "{kinematics}"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.A]
{a}
material = "rock"
[bodies.B]
{b}
material = "rock"
{joins}
[[stages]]
name = "press"
duration = "1 s"
conditions = [{{ set = "A.bottom", x = 0, y = 0{far} }}, {{ set = "B.bottom", x = 0, y = 0{far} }}, {conditions}]
[time]
stepper = "implicit"
"#
    )
}

fn warnings(text: &str) -> Vec<String> {
    let scene = scene::read(text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    match asperity_plan::plan_scene(&scene).unwrap_or_else(|e| panic!("{e}\n{text}")) {
        ScenePlan::Bodies(plan) => plan.summary().warnings.iter().map(ToString::to_string).collect(),
        _ => panic!("bodies in contact"),
    }
}

const PRESS: &str = r#"{ set = "A.top", pressure = "1 MPa" }"#;
const JOINS: &str = r#"[interfaces.seam]
slave = "A.right"
master = "B.left"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "coulomb", mu = 0.6 }
"#;

#[test]
fn bodies_that_meet_with_no_interface_are_warned_of() {
    for space in [false, true] {
        let told = |from: &str, joins: &str| warnings(&scene(space, from, joins, PRESS));
        for from in ["1 m", "900 mm", "600 mm"] {
            let found = told(from, "");
            let met = found.iter().filter(|w| w.contains("bodies `A` and `B` meet at")).count();
            assert_eq!((met, found.len()), (1, 1), "{from}: {found:?}");
        }
        assert_eq!(told("1.001 m", ""), Vec::<String>::new());
        let joined = told("1 m", JOINS);
        assert!(!joined.iter().any(|w| w.contains("meet at")), "{joined:?}");
    }
}

#[test]
fn loads_of_one_kind_on_faces_of_two_sets_are_warned_of() {
    let file = |conditions: &str| {
        format!(
            r#"
schema = 1
title = "two sets"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.B]
mesh.gmsh = {{ file = "overlapping-sets.msh" }}
material = "rock"
[[stages]]
name = "press"
duration = "1 s"
conditions = [{{ set = "B.bottom", x = 0, y = 0 }}, {conditions}]
[time]
stepper = "implicit"
"#
        )
    };
    let told = |conditions: &str| {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
        let scene = scene::read_in(&file(conditions), &folder).unwrap();
        match asperity_plan::plan_scene(&scene).unwrap() {
            ScenePlan::Bodies(plan) => {
                plan.summary().warnings.iter().map(ToString::to_string).collect::<Vec<_>>()
            }
            _ => panic!("bodies in contact"),
        }
    };
    let twice = told(r#"{ set = "B.top", pressure = "1 MPa" }, { set = "B.lid", pressure = "1 MPa" }"#);
    assert!(
        twice.len() == 1 && twice[0].contains("`B.top` and `B.lid` have faces in common (1)"),
        "{twice:?}"
    );
    let one = r#"{ set = "B.top", pressure = "1 MPa" }, { set = "B.lid", traction = ["1 MPa", 0] }"#;
    assert_eq!(told(one), Vec::<String>::new());
}
