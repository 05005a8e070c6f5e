//! Bodies from mesh files and generators end to end, against closed forms.

use crate::common::{close, displacements, fields, planned, simulate, varied};
use asperity_output::bodies::Recorder;
use asperity_vary::Change::{Add, With};

/// Modulus of uniaxial strain over Young's modulus for a Poisson's ratio of a quarter.
const UNIAXIAL: f64 = 0.75 / (1.25 * 0.5);

/// A scene of rock and clay with these bodies and conditions, 1 s in one step.
fn scene(kinematics: &str, bodies: &str, conditions: &str) -> String {
    format!(
        r#"
schema = 1
title = "meshes"
kinematics = "{kinematics}"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[materials.clay]
young = "1 GPa"
poisson = 0.25
{bodies}
[[stages]]
name = "load"
duration = 1
steps = 1
conditions = [{conditions}]
[time]
stepper = "implicit"
"#
    )
}

/// Rollers at the sides and the bottom of `B`, and a pressure on top.
const PRESSED: &str = r#"{ set = "B.left", symmetry = true }, { set = "B.right", symmetry = true },
    { set = "B.bottom", symmetry = true }, { set = "B.top", pressure = "3 MPa" }"#;

/// Asserts that two layers carry 3 MPa across their interface, and that the end at 1 m moved by the shortening of both
/// and the closure of the interface.
fn assert_pressed(record: &Recorder, axis: usize) {
    for traction in &record.stage_ends()[0].interfaces[0].normal_traction {
        close(*traction, 3e6, 1e-9);
    }
    for (_, u) in displacements(record, |x| x[axis] == 1.0) {
        close(u[axis], -3e6 * (2.0 / (10e9 * UNIAXIAL) + 1e-13), 1e-9);
    }
}

#[test]
fn the_blocks_of_a_file_have_their_own_materials() {
    for file in ["two_layers.msh", "mixed.msh"] {
        let body = format!(
            "[bodies.B]\nmesh.gmsh = {{ file = \"{file}\" }}\nmaterial = {{ lower = \"rock\", upper = \"clay\" }}\n"
        );
        let (_, record) = simulate(&scene("plane-strain", &body, PRESSED));
        let (lower, upper) = (-3e6 / (10e9 * UNIAXIAL), -3e6 / (1e9 * UNIAXIAL));
        for (_, u) in displacements(&record, |x| x[1] == 0.0) {
            close(u[1], lower, 1e-9);
        }
        for (_, u) in displacements(&record, |x| x[1] == 1.0) {
            close(u[1], lower + upper, 1e-9);
        }
        assert!(fields(&record).cell_stress.iter().all(|s| (s[1] / -3e6 - 1.0).abs() < 1e-9));
        let kinds: Vec<u8> = record.setup().mesh.cells.iter().map(|c| c.kind).collect();
        assert!(kinds.contains(&9) && kinds.contains(&5) == (file == "mixed.msh"));
        assert!(record.setup().mesh.cell_body.iter().all(|b| *b == 0));
    }
}

#[test]
fn lengths_of_a_file_have_its_unit() {
    let body = "[bodies.B]\nmesh.gmsh = { file = \"two_layers.msh\", unit = \"km\" }\nmaterial = \"rock\"\n";
    let (_, record) = simulate(&scene("plane-strain", body, PRESSED));
    for (_, u) in displacements(&record, |x| x[1] == 1000.0) {
        close(u[1], -3e6 * 2000.0 / (10e9 * UNIAXIAL), 1e-9);
    }
}

fn interface(slave: &str, master: &str) -> String {
    format!(
        r#"
[interfaces.joint]
slave = "{slave}"
master = "{master}"
measure = "node-to-point"
sliding = "small"
enforcement = {{ kind = "penalty", normal = "1e13 Pa/m" }}
"#
    )
}

#[test]
fn a_face_group_between_two_bodies_of_a_file_gives_each_its_side() {
    let bodies = r#"
[bodies.A]
mesh.gmsh = { file = "two_layers.msh", groups = ["lower"], tags = { joint = 20 } }
material = "rock"
[bodies.B]
mesh.gmsh = { file = "two_layers.msh", groups = ["upper"] }
material = "rock"
"#;
    let conditions = r#"{ set = "A.left", symmetry = true }, { set = "A.right", symmetry = true },
    { set = "B.left", symmetry = true }, { set = "B.right", symmetry = true },
    { set = "A.bottom", symmetry = true }, { set = "B.top", pressure = "3 MPa" }"#;
    let text = scene("plane-strain", &format!("{bodies}{}", interface("A.joint", "B.fault")), conditions);
    let (_, record) = simulate(&text);
    assert_pressed(&record, 1);
}

#[test]
fn a_split_body_is_held_together_by_contact_alone() {
    let body =
        "[bodies.B]\nmesh.gmsh = { file = \"two_layers.msh\", split = [\"fault\"] }\nmaterial = \"rock\"\n";
    let split = format!("{body}{}", interface("B.fault.minus", "B.fault.plus"));
    let conditions = PRESSED;
    let text = scene("plane-strain", &split, conditions);
    let plan = planned(&text);
    let remarks = &plan.summary().remarks;
    assert!(remarks.iter().any(|r| r.contains("contact alone holds the translation in y")), "{remarks:?}");
    for path in ["condensed", "full"] {
        let text = varied(&text, &[Add("time.path", path)]);
        let (_, record) = simulate(&text);
        assert_pressed(&record, 1);
    }
}

#[test]
fn an_abaqus_mesh_is_a_body_with_its_element_sets() {
    // Without lateral contraction the ends may be clamped.
    let body =
        "[bodies.B]\nmesh.abaqus = { file = \"cube.inp\", elsets = [\"body\"] }\nmaterial = \"rock\"\n";
    let conditions =
        r#"{ set = "B.low", x = 0, y = 0, z = 0 }, { set = "B.high", traction = ["4 MPa", 0, 0] }"#;
    let text = varied(&scene("3d", body, conditions), &[With("materials.rock.poisson", "0")]);
    let (_, record) = simulate(&text);
    for (x, u) in displacements(&record, |x| x[0] > 0.0) {
        close(u[0], 4e6 / 10e9 * x[0], 1e-10);
    }
}

#[test]
fn a_rectangle_with_named_corners_is_a_block() {
    let column = |mesh: &str| {
        let body = format!("[bodies.B]\nmesh.{mesh}\nmaterial = \"rock\"\n");
        let (_, record) = simulate(&scene("plane-strain", &body, PRESSED));
        record.setup().mesh.clone()
    };
    for element in ["quad4", "quad8", "tri6"] {
        let block = column(&format!(
            "block = {{ min = [0, -1], max = [3, 1], divisions = [3, 4], grading = [2, 1], element = \"{element}\" }}"
        ));
        let patch = column(&format!(
            "quadrilateral = {{ corners = [[0, -1], [3, -1], [3, 1], [0, 1]], divisions = [3, 4], grading = [2, 1], element = \"{element}\" }}"
        ));
        assert_eq!(block.cells, patch.cells);
        for (a, b) in block.nodes.iter().zip(&patch.nodes) {
            assert!((0..2).all(|c| (a[c] - b[c]).abs() < 1e-14), "{a:?} {b:?}");
        }
    }
}

/// A box of 2 x 2 m pressed from the right, whose fault runs from the bottom to the top.
fn through(extra: &str) -> String {
    format!(
        "[bodies.B]\nmesh.fault = {{ trace = [[0, 1], [0, -1]], spacing = \"0.25 m\", min = [-1, -1], max = [1, 1], growth = 1.5, \
         element = \"quad4\" }}\nmaterial = \"rock\"\n{extra}{}",
        interface("B.fault.plus", "B.fault.minus")
    )
}

#[test]
fn a_generated_fault_passes_the_pressure_from_side_to_side() {
    let conditions = r#"{ set = "B.left", x = 0 }, { set = "B.bottom", y = 0 }, { set = "B.top", y = 0 },
        { set = "B.right", pressure = "3 MPa" }"#;
    for (kinematics, extra, more) in [
        ("plane-strain", "", ""),
        ("3d", "extrude = [0, 0.5, 1]\n", r#", { set = "B.back", z = 0 }, { set = "B.front", z = 0 }"#),
    ] {
        let (_, record) = simulate(&scene(kinematics, &through(extra), &format!("{conditions}{more}")));
        assert_pressed(&record, 0);
    }
}

#[test]
fn a_fault_with_tips_slips_like_a_crack() {
    // A vertical crack of half-length 1 in a wide box under antisymmetric shear: slip at its middle 2 (1 - nu) a tau/G.
    let body = format!(
        "[bodies.B]\nmesh.fault = {{ trace = [[0, 1], [0, -1]], spacing = \"0.05 m\", min = [-15, -15], max = [15, 15], growth = 1.2, \
         element = \"quad4\" }}\nmaterial = \"rock\"\ninitial_stress = [\"-10 MPa\", \"-10 MPa\", \"1 MPa\"]\n{}",
        interface("B.fault.plus", "B.fault.minus")
    );
    let side = |s: &str| format!("{{ set = \"B.{s}\", x = 0, y = 0 }}");
    let conditions = ["left", "right", "bottom", "top"].map(side).join(", ");
    let (_, record) = simulate(&scene("plane-strain", &body, &conditions));
    let middle = displacements(&record, |x| x[0] == 0.0 && x[1].abs() < 1e-9);
    assert_eq!(middle.len(), 2);
    let slip = (middle[0].1[1] - middle[1].1[1]).abs();
    let exact = 2.0 * 0.75 * 1e6 / (10e9 / 2.5);
    assert!((slip / exact - 1.0).abs() < 0.05, "{slip} {exact}");
}
