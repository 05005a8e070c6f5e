//! Surfaces that are none: faces inside a body, and faces on an axis of revolution.

use crate::common;
use asperity_plan::plan_scene;
use asperity_plan::reading::scene;
use asperity_vary::Change::{Add, With};

/// A cylinder that is pressed along its axis.
const CYLINDER: &str = r#"
schema = 1
title = "cylinder"
kinematics = "axisymmetric"
[materials.rock]
young = "10 GPa"
poisson = 0.25
density = 2700
[bodies.c]
material = "rock"
mesh.block = { min = [0, 0], max = ["1 m", "2 m"], size = "0.5 m", element = "quad4" }
[[stages]]
name = "press"
duration = "1 s"
conditions = [{ set = "c.bottom", y = 0 }, { set = "c.top", y = { to = "-1 mm" } }, { set = "c.left", x = 0 }]
[time]
stepper = "implicit"
"#;

/// Reason why a scene is refused; empty if it is not.
fn refusal(text: &str) -> String {
    match scene::read(text) {
        Err(errors) => format!("{errors:?}"),
        Ok(scene) => plan_scene(&scene).err().map_or(String::new(), |error| format!("{error:?}")),
    }
}

#[test]
fn nothing_moves_or_loads_an_axis_of_revolution() {
    let varied = |changes: &[_]| refusal(&common::varied(CYLINDER, changes));
    assert_eq!(refusal(CYLINDER), "");
    let x = "stages[0].conditions[2].x";
    assert_eq!(varied(&[With(x, "{ to = 0 }")]), "");
    for moved in ["\"1 um\"", "{ to = \"1 um\" }", "{ rate = \"1 um/s\" }"] {
        let found = varied(&[With(x, moved)]);
        assert!(found.contains("axis of revolution, which cannot leave it"), "{moved}: {found}");
    }
    let pressed = "{ set = \"c.left\", pressure = \"1 MPa\" }";
    let found = varied(&[With("stages[0].conditions[2]", pressed)]);
    assert!(found.contains("where faces have no area"), "{found}");
    let found = varied(&[Add("bodies.c.gravity", "[-9.81, 0]")]);
    assert!(found.contains("pulls towards the axis"), "{found}");
    assert_eq!(varied(&[Add("bodies.c.gravity", "[0, -9.81]")]), "");
}

/// A square of four cells, whose middle line is named.
const SQUARE: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"middle\"\n1 2 \"right\"\n2 3 \"rock\"\n$EndPhysicalNames\n\
    $Nodes\n9\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n7 0 2 0\n8 1 2 0\n9 2 2 0\n$EndNodes\n\
    $Elements\n8\n1 1 2 1 1 2 5\n2 1 2 1 1 5 8\n3 1 2 2 2 3 6\n4 1 2 2 2 6 9\n\
    5 3 2 3 3 1 2 5 4\n6 3 2 3 3 2 3 6 5\n7 3 2 3 3 4 5 8 7\n8 3 2 3 3 5 6 9 8\n$EndElements\n";

#[test]
fn faces_inside_a_body_are_no_surface() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("square.msh");
    std::fs::write(&file, SQUARE).unwrap();
    let scene = |condition: &str, stepper: &str| {
        format!(
            "schema = 1\ntitle = \"square\"\nkinematics = \"plane-strain\"\n[materials.rock]\nyoung = \"10 GPa\"\npoisson = 0.25\ndensity = 2700\n\
             [bodies.b]\nmaterial = \"rock\"\nmesh.gmsh = {{ file = {:?}, groups = [\"rock\"] }}\n[[stages]]\nname = \"load\"\nduration = \"1 ms\"\n\
             conditions = [{condition}]\n[time]\nstepper = \"{stepper}\"\n",
            file.display().to_string()
        )
    };
    let held = "{ set = \"b.right\", x = 0, y = 0 }";
    for load in ["traction = [\"1 MPa\", 0]", "pressure = \"1 MPa\""] {
        let found = refusal(&scene(&format!("{held}, {{ set = \"b.middle\", {load} }}"), "implicit"));
        assert!(found.contains("`b.middle` lies inside a body: 2 of its faces"), "{found}");
    }
    let found = refusal(&scene("{ set = \"b.middle\", absorbing = true }", "explicit"));
    assert!(found.contains("lies inside a body"), "{found}");
    // A motion acts on nodes, wherever they lie.
    let found =
        refusal(&scene(&format!("{held}, {{ set = \"b.middle\", x = {{ to = \"1 um\" }} }}"), "implicit"));
    assert_eq!(found, "");
}
