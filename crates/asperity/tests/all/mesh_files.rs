//! Every sample mesh through a scene: good ones carry a load, bad ones are refused with their reason.

use crate::common::{close, displacements, simulate, varied};
use asperity_plan::bodies;
use asperity_plan::reading::diagnostic::Diagnostics;
use asperity_plan::reading::scene;
use asperity_vary::Change::With;
use std::path::Path;

/// A body of rock without lateral contraction, or several, with conditions.
fn scene(kinematics: &str, bodies: &str, conditions: &str) -> String {
    format!(
        r#"
schema = 1
title = "files"
kinematics = "{kinematics}"
[materials.rock]
young = "10 GPa"
poisson = 0
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

/// Samples of the readers, seen from the folder of the driver's own meshes.
fn sample(name: &str) -> String {
    format!("../../../fem/tests/meshes/{name}")
}

fn body(file: &str, more: &str) -> String {
    format!("[bodies.B]\nmesh.gmsh = {{ file = \"{}\"{more} }}\nmaterial = \"rock\"\n", sample(file))
}

#[test]
fn every_good_plane_mesh_is_stretched_and_pressed() {
    let files = [
        "good_2d_quad4_shared_ascii.msh",
        "good_2d_quad4_shared_v22.msh",
        "good_2d_quad8_shared_ascii.msh",
        "mixed_2d_tri3_quad4.msh",
        "good_2d_quad4_crack_plugin_ascii.msh",
    ];
    // Two blocks of 2 x 1 m, one on top of the other.
    let pull = r#"{ set = "B.left", x = 0 }, { set = "B.bottom", y = 0 }, { set = "B.right", traction = ["4 MPa", 0] }"#;
    let press = r#"{ set = "B.bottom", x = 0, y = 0 }, { set = "B.top", pressure = "3 MPa" }"#;
    for file in files {
        for (unit, factor) in [("", 1.0), (", unit = \"km\"", 1e3)] {
            let (_, record) = simulate(&scene("plane-strain", &body(file, unit), pull));
            for (x, u) in displacements(&record, |x| x[0] > 0.0) {
                assert!(x[0] <= 2.0 * factor, "{file}");
                close(u[0], 4e6 / 10e9 * x[0], 1e-9);
            }
        }
        // The crack of the last one would close on itself.
        if !file.contains("crack") {
            let (_, record) = simulate(&scene("plane-strain", &body(file, ""), press));
            displacements(&record, |x| x[1] == 1.0)
                .iter()
                .for_each(|(_, u)| close(u[1], -3e6 / 10e9 * 2.0, 1e-9));
        }
    }
}

#[test]
fn every_good_mesh_in_space_is_pressed() {
    let press = r#"{ set = "B.bottom", x = 0, y = 0, z = 0 }, { set = "B.top", pressure = "3 MPa" }"#;
    for file in
        ["good_3d_hex8_shared_ascii.msh", "good_3d_tet4_shared_ascii.msh", "good_3d_tet10_shared_binary.msh"]
    {
        for (more, height) in [("", 2.0), (", unit = \"km\"", 2e3)] {
            let (_, record) = simulate(&scene("3d", &body(file, more), press));
            let top = displacements(&record, |x| x[2] == 0.5 * height);
            top.iter().for_each(|(_, u)| close(u[2], -3e6 / 10e9 * height, 1e-8));
        }
    }
}

#[test]
fn a_mesh_of_two_bodies_that_do_not_match_carries_the_load_across() {
    let file = sample("good_2d_quad4_split_nonmatching_ascii.msh");
    let bodies = format!(
        r#"
[bodies.A]
mesh.gmsh = {{ file = "{file}", groups = ["lower"] }}
material = "rock"
[bodies.B]
mesh.gmsh = {{ file = "{file}", groups = ["upper"] }}
material = "rock"
[interfaces.fault]
slave = "A.fault_minus"
master = "B.fault_plus"
measure = "node-to-point"
sliding = "small"
enforcement = {{ kind = "penalty", normal = "100 E/h" }}
[output]
forces.below = {{ set = "A.bottom" }}
forces.fault = {{ set = "A.fault_minus" }}
"#
    );
    let conditions = r#"{ set = "A.bottom", x = 0, y = 0 }, { set = "B.left", x = 0 }, { set = "B.top", pressure = "3 MPa" }"#;
    let (_, record) = simulate(&scene("plane-strain", &bodies, conditions));
    let forces = &record.samples()[0].forces;
    close(forces[0][1], 6e6, 1e-8);
    close(forces[1][1], -6e6, 1e-8);
    let top = displacements(&record, |x| x[1] == 1.0);
    let mean = top.iter().map(|(_, u)| u[1]).sum::<f64>() / top.len() as f64;
    // Node-to-point contact of sides that do not match is uneven, the mean is not.
    close(mean, -3e6 / 10e9 * 2.0, 0.05);
}

#[test]
fn groups_without_names_are_named_by_number_and_dimension_in_the_scene() {
    let pull = r#"{ set = "B.foot", x = 0, y = 0 }, { set = "B.head", traction = [0, "4 MPa"] }"#;
    // Bottom and top of the unit square are groups 1 and 2 of lines, its cells group 7.
    for tags in [
        "foot = 1, head = 2, rocks = 7",
        "foot = { tag = 1, dimension = 1 }, head = { tag = 2, dimension = 1 }, rocks = { tag = 7, dimension = 2 }",
    ] {
        let more = format!(", groups = [\"rocks\"], tags = {{ {tags} }}");
        let text = varied(
            &scene("plane-strain", &body("unit_unnamed_tags.msh", &more), pull),
            &[With("bodies.B.material", "{ rocks = \"rock\" }")],
        );
        let (_, record) = simulate(&text);
        let top = displacements(&record, |x| (x[1] - 1.0).abs() < 1e-12 && x[0] > 0.4);
        assert!(!top.is_empty());
    }
}

const DIALECT: &str = "tests/meshes/material_id.msh";

#[test]
fn groups_called_material_id_are_named_by_their_number() {
    assert!(Path::new(env!("CARGO_MANIFEST_DIR")).join(DIALECT).exists());
    let pull = r#"{ set = "B.left", x = 0 }, { set = "B.bottom", y = 0 }, { set = "B.right", traction = ["4 MPa", 0] }"#;
    for (tags, groups) in [
        ("soft = 24, stiff = 25", ["soft", "stiff"]),
        ("soft = \"material-id:24\", stiff = \"material-id:25\"", ["soft", "stiff"]),
        ("soft = 24", ["soft", "material-id:25"]),
    ] {
        let bodies = format!(
            "[materials.clay]\nyoung = \"1 GPa\"\npoisson = 0\n[bodies.B]\nmesh.gmsh = {{ file = \"material_id.msh\", tags = {{ {tags} }} }}\n\
             material = {{ \"{}\" = \"clay\", \"{}\" = \"rock\" }}\n",
            groups[0], groups[1]
        );
        let (_, record) = simulate(&scene("plane-strain", &bodies, pull));
        // Soft and stiff in series, 1 m each.
        for (_, u) in displacements(&record, |x| x[0] == 2.0) {
            close(u[0], 4e6 * (1.0 / 1e9 + 1.0 / 10e9), 1e-9);
        }
    }
}

fn refused(text: &str) -> (String, std::ops::Range<usize>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    let error = match scene::read_in(text, &folder) {
        Err(errors) => errors,
        Ok(scene) => Diagnostics::from(bodies::plan(&scene).map(|_| ()).unwrap_err()),
    };
    let first = &error.0[0];
    (format!("{} ({})", first.message, first.help.clone().unwrap_or_default()), first.span.clone())
}

#[test]
fn every_bad_mesh_is_refused_with_its_file_and_what_is_wrong_in_it() {
    let plane = r#"{ set = "B.bottom", x = 0, y = 0 }, { set = "B.fault", pressure = "3 MPa" }"#;
    for (file, parts) in [
        ("bad_no_physical_groups.msh", &["no groups", "physical groups"][..]),
        ("bad_inverted_element.msh", &["element 31", "inverted"]),
        ("bad_bowtie_element.msh", &["element 31", "folded"]),
        ("bad_dangling_node_ref.msh", &["element ", "node 99999"]),
        ("bad_duplicate_nodes_unwelded.msh", &["hangs free", "of its nodes coincide"]),
        ("bad_nan_coordinate.msh", &["node ", "NaN"]),
        ("bad_hanging_node.msh", &["nodes hang (1)", "[1.0, 0.5]", "edge of element 1"]),
        ("bad_hanging_nodes_in_space.msh", &["nodes hang (3)", "edge of element 1"]),
        ("bad_two_orders_at_a_face.msh", &["nodes hang (1)", "[1.0, 0.5]", "edge of element 2", "one order"]),
        ("bad_doubled_nodes_of_one_cell.msh", &["hangs free", "2 of its nodes coincide"]),
    ] {
        let kinematics = if file.contains("space") { "3d" } else { "plane-strain" };
        let text = scene(kinematics, &body(file, ""), plane);
        let (message, place) = refused(&text);
        for part in parts.iter().chain(&[file]) {
            assert!(message.contains(part), "{file}: `{part}` is not in\n{message}");
        }
        assert!(text[place].contains(file), "{file}: the place is another");
    }
    let (message, _) = refused(&scene("3d", &body("bad_truncated_binary.msh", ""), plane));
    assert!(message.contains("bad_truncated_binary.msh") && message.contains("Elements"), "{message}");
}

#[test]
fn a_group_that_is_missing_is_named_with_those_there_are() {
    let with = |set: &str, more: &str, file: &str| {
        let conditions = format!(r#"{{ set = "B.{set}", x = 0, y = 0 }}"#);
        refused(&scene("plane-strain", &body(file, more), &conditions)).0
    };
    let missing = with("fault", "", "bad_missing_fault_group.msh");
    assert!(missing.contains("there is no set `B.fault`"), "{missing}");
    let near = with("fautl", "", "good_2d_quad4_shared_ascii.msh");
    assert!(near.contains("`B.fautl`") && near.contains("B.fault"), "{near}");
    let group = with("bottom", ", groups = [\"lowr\"]", "bad_missing_fault_group.msh");
    assert!(group.contains("`lowr`") && group.contains("`lower`"), "{group}");
    let tag = with("bottom", ", tags = { deep = 77 }", "good_2d_quad4_shared_ascii.msh");
    assert!(tag.contains("77") && tag.contains("20"), "{tag}");
    let dimension =
        with("bottom", ", tags = { deep = { tag = 20, dimension = 2 } }", "good_2d_quad4_shared_ascii.msh");
    assert!(dimension.contains("20"), "{dimension}");
}
