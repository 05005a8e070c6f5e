//! Input files as Abaqus/CAE writes them: bodies from instances of parts, conditions on sets of nodes, and what no body is made
//! of.

use crate::common::{close, displacements, planned, simulate, varied};
use asperity_plan::bodies;
use asperity_plan::reading::diagnostic::Diagnostics;
use asperity_plan::reading::scene;
use asperity_vary::Change::{self, With};
use std::path::Path;

/// Two cubes in contact, the upper one moved down by 1 mm.
const SCENE: &str = r#"
schema = 1
title = "cubes of CAE"
kinematics = "3d"
[materials.rock]
young = "10 GPa"
poisson = 0
[bodies.low]
mesh.abaqus = { file = "cae.inp", elsets = ["Lower"], unit = "m" }
material = "rock"
[bodies.up]
mesh.abaqus = { file = "cae.inp", elsets = ["Upper.Set-1"], unit = "m" }
material = "rock"
[interfaces.between]
slave = "up.Bottom"
master = "low.Top"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h" }
[[stages]]
name = "press"
duration = 1
steps = 1
conditions = [{ set = "low.Foot", x = 0, y = 0, z = 0 }, { set = "up.Head", x = 0, y = 0, z = { to = "-1 mm" } }]
[time]
stepper = "implicit"
[output]
forces.head = { set = "up.Head" }
"#;

/// Message and help of the refusal of a scene.
fn refused(changes: &[Change<'_>]) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    let error = match scene::read_in(&varied(SCENE, changes), &folder) {
        Err(errors) => errors,
        Ok(scene) => Diagnostics::from(bodies::plan(&scene).map(|_| ()).unwrap_err()),
    };
    let first = &error.0[0];
    format!("{}; {}", first.message, first.help.clone().unwrap_or_default())
}

#[test]
fn bodies_of_two_instances_are_pressed_by_their_sets_of_nodes() {
    let (_, record) = simulate(SCENE);
    // Two cubes of 1 m, and a penalty of 100 E/h between them.
    let stress = 10e9 * 1e-3 / 2.01;
    for (x, u) in displacements(&record, |x| x[2] > 1.5) {
        assert!(x[2] == 2.0 && x[0] * (1.0 - x[0]) == 0.0, "{x:?}");
        close(u[2], -1e-3, 1e-12);
    }
    displacements(&record, |x| x[2] == 1.0).iter().for_each(|(_, u)| {
        let [low, up] = [-stress / 10e9, -1e-3 + stress / 10e9];
        assert!((u[2] - low).abs() < 1e-12 || (u[2] - up).abs() < 1e-12, "{u:?}");
    });
    close(record.samples()[0].forces[0][2], -stress, 1e-9);
}

#[test]
fn what_no_body_asks_for_is_left_out_with_a_note() {
    let plan = planned(SCENE);
    let remarks = plan.summary().remarks.join("\n");
    for note in [
        "the file of body `low` has in `Glue` 1 element of type COH3D8 (element 1), which is not read: they are left out",
        "in `Rod` 1 element of type line2",
        "in `Springs/Dashpots-1-spring` 1 element of type SPRINGA (element 2)",
    ] {
        assert!(remarks.contains(note), "{note} is not in\n{remarks}");
    }
    assert_eq!(remarks.matches("`Rod`").count(), 1, "once, not for each body:\n{remarks}");
    let checks = format!("{:?}", plan.checks().sets);
    assert!(checks.contains("set: \"low.Foot\"") && checks.contains("nodes: Some(4)"), "{checks}");
}

#[test]
fn sets_of_nodes_and_of_beams_are_refused_where_faces_are_needed() {
    let head = "{ set = \"up.Head\", x = 0, y = 0, pressure = \"1 MPa\" }";
    let foot = "{ set = \"low.Foot\", x = 0, y = 0, z = 0 }";
    for (change, message) in [
        (
            With("stages[0].conditions", &format!("[{foot}, {head}]")),
            "`up.Head` is a set of 4 nodes, and faces are needed here; motions and springs",
        ),
        (With("interfaces.between.slave", "\"up.Head\""), "`up.Head` is a set of 4 nodes"),
        (
            With("bodies.up.mesh.abaqus.elsets", "[\"Glue\"]"),
            "has no cells in a group `Glue`, but 1 element of type COH3D8",
        ),
        (
            With("output.forces.head.set", "\"up.Glue\""),
            "there is no set `up.Glue`: the file has 1 element of type COH3D8",
        ),
        (
            With("output.forces.head.set", "\"up.Rod\""),
            "the set `up.Rod` of a mesh file has 1 element of type line2",
        ),
        (
            With("output.forces.head.set", "\"up.Upper\""),
            "there is no set `up.Upper`: it is a group of cells",
        ),
    ] {
        let told = refused(&[change]);
        assert!(told.contains(message), "{message} is not in\n{told}");
    }
}
