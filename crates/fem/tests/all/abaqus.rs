//! Abaqus input files: supported and refused content.
#![allow(clippy::disallowed_methods)]

use crate::reading::{face_measure, measure, nodes_lie_where_the_element_has_them, sample, total};
use asperity_fem::mesh::{Mesh, MeshError, Options, abaqus};

/// The written coordinates have the rounding of Gmsh's transfinite curves.
const ROUNDING: f64 = 1e-10;

fn read<const D: usize>(text: &str) -> Result<Mesh<D>, MeshError> {
    abaqus::parse(text.as_bytes())?.into_mesh(&Options::default())
}

fn is(value: f64, expected: f64, what: &str) {
    assert!((value - expected).abs() < ROUNDING, "{what}: {value} is not {expected}");
}

#[test]
fn the_files_that_gmsh_writes_are_read_with_their_groups() {
    for name in ["tet4", "tet10", "hex8", "hex20", "hex27", "wedge6", "wedge15"] {
        let text = String::from_utf8(sample(&format!("unit_{name}.inp"))).unwrap();
        let mesh: Mesh<3> = read(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        is(total(&mesh), 1.0, name);
        is(measure(&mesh, mesh.cell_sets["body"].iter().copied()), 1.0, name);
        is(face_measure(&mesh, &mesh.side_sets["low"]), 1.0, name);
        is(face_measure(&mesh, &mesh.side_sets["hull"]), 6.0, name);
        nodes_lie_where_the_element_has_them(&mesh);
        // The curve of the group `edge` is not a face of a cell: its nodes form a set.
        assert!(mesh.node_sets["edge"].iter().all(|&n| mesh.nodes[n][0] == 0.0 && mesh.nodes[n][2] == 0.0));
    }
}

/// Two squares over [0, 2] x [0, 1].
const SQUARES: &str = "*Heading
 of two squares
** a comment
*Node, nset=All
1, 0., 0.
2, 1.0D0, 0.
3, 2., 0.
4, 0., 1.
5, 1., 1.
6, 2., 1.
*ELEMENT, TYPE=CPE4R,
 ELSET=West
10, 1, 2,
 5, 4
*Element, type=cax4, elset=East
20, 2, 3, 6, 5
*Elset, elset=Both
west, 20
*ElSet, elset=range, generate
10, 20, 10
*Nset, nset=Bottom, generate
1, 3
*Nset, nset=Corners
1, 3, 4, 6,
*Surface, name=Top, type=ELEMENT
Both, S3
*Surface, name=Middle
10, S2
*Material, name=granite
*Elastic
44.8e9, 0.12
";

#[test]
fn sets_surfaces_and_spellings_are_understood() {
    let mesh: Mesh<2> = read(SQUARES).unwrap();
    is(total(&mesh), 2.0, "all");
    for (set, area) in [("West", 1.0), ("East", 1.0), ("Both", 2.0), ("range", 2.0)] {
        is(measure(&mesh, mesh.cell_sets[set].iter().copied()), area, set);
    }
    assert_eq!(mesh.node_sets["All"], [0, 1, 2, 3, 4, 5]);
    assert_eq!(mesh.node_sets["Bottom"], [0, 1, 2]);
    assert_eq!(mesh.node_sets["Corners"], [0, 2, 3, 5]);
    is(face_measure(&mesh, &mesh.side_sets["Top"]), 2.0, "Top");
}

#[test]
fn a_surface_has_only_the_side_of_its_element() {
    let mesh: Mesh<2> = read(SQUARES).unwrap();
    let [side] = mesh.side_sets["Middle"][..] else { panic!("{:?}", mesh.side_sets["Middle"]) };
    assert!(mesh.cell_sets["West"].contains(&side.block));
}

/// One element of each kind on the reference corners, with the faces numbered as in Abaqus.
#[test]
fn numbered_faces_lie_where_abaqus_has_them() {
    let hex = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
    let hex = format!("{hex}*ELEMENT,TYPE=C3D8I\n1,1,2,3,4,5,6,7,8\n");
    faces(&hex, &[(2, 0.0), (2, 1.0), (1, 0.0), (0, 1.0), (1, 1.0), (0, 0.0)]);
    let tet = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4H\n1,1,2,3,4\n";
    faces(tet, &[(2, 0.0), (1, 0.0)]);
}

/// Face S(k+1) of element 1 lies on the plane x_axis = value.
fn faces(text: &str, planes: &[(usize, f64)]) {
    for (k, &(axis, value)) in planes.iter().enumerate() {
        let text = format!("{text}*SURFACE, NAME=face\n1, S{}\n", k + 1);
        let mesh: Mesh<3> = read(&text).unwrap();
        let [side] = mesh.side_sets["face"][..] else { panic!("S{}", k + 1) };
        for node in asperity_fem::mesh::face_nodes(&mesh, &side) {
            assert_eq!(mesh.nodes[node][axis], value, "S{}", k + 1);
        }
    }
}

/// Reads the squares with some text replaced.
fn changed(from: &str, to: &str) -> String {
    assert!(SQUARES.contains(from), "{from}");
    read::<2>(&SQUARES.replacen(from, to, 1)).unwrap_err().to_string()
}

#[test]
fn small_faults_of_a_file_are_named_with_their_lines() {
    for (from, to, message) in [
        ("CPE4R", "CPE5", "*ELEMENT, line 11: elements of type CPE5 are not read"),
        ("2, 1.0D0, 0.", "2, one, 0.", "*NODE, line 6: expected a coordinate, found `one`"),
        ("3, 2., 0.", "2, 2., 0.", "node 2 is defined twice"),
        ("3, 2., 0.", "3, nan, 0.", "node 3 has the coordinate x = NaN"),
        ("3, 2., 0.", "3, 2., 0., 1.", "node 3 of the plane mesh has z = 1e0: a plane mesh lies in z = 0"),
        ("20, 2, 3, 6, 5", "20, 2, 3, 7, 5", "element 20 refers to node 7, which does not exist"),
        ("20, 2, 3, 6, 5", "10, 2, 3, 6, 5", "element 10 is defined twice"),
        (
            "20, 2, 3, 6, 5",
            "20, 2, 3",
            "*ELEMENT, line 15: expected further nodes of the last element, found `element 20`",
        ),
        ("20, 2, 3, 6, 5", "20, 2, 3, 6, 5, 1", TOO_MANY),
        ("20, 2, 3, 6, 5", "20, 5, 6, 3, 2", INVERTED),
        ("west, 20", "west, 21", "the set `Top` refers to element 21, which does not exist"),
        (
            "west, 20",
            "wets, 20",
            "*ELSET, line 18: there is no set `wets`; did you mean `West`?; there are Both, East, West",
        ),
        ("1, 3, 4, 6,", "1, 3, 4, 9", "the set `Corners` refers to node 9, which does not exist"),
        (
            "10, S2",
            "10, S5",
            "*SURFACE, line 28: expected a face that the element has, found `S5 of element 10`",
        ),
        ("10, S2", "10", "*SURFACE, line 28: expected an element or set, and a face S1 to S6, found `10`"),
        ("*Material", "*Include, input=other.inp", INCLUDE),
        ("*Material, name=granite", "*Part", PARTS),
        ("*Heading", "*NGEN", GENERATED),
    ] {
        assert_eq!(changed(from, to), message);
    }
}

const TOO_MANY: &str =
    "*ELEMENT, line 16: expected as many nodes as the type of element has, found `20, 2, 3, 6, 5, 1`";
const INVERTED: &str = "element 20 (quad4) is inverted: its Jacobian determinant, relative to its greatest, falls to -1.000 \
    (it must be positive)";
const INCLUDE: &str = "*INCLUDE, line 29: other files are not read: put their lines into this one";
const PARTS: &str = "*PART, line 29: expected NAME=name, found `*PART`";
const GENERATED: &str = "*NGEN, line 1: nodes and elements must be written out, in one system of axes";

#[test]
fn sets_of_sets_are_bounded_by_the_file() {
    let mut text = SQUARES.to_string();
    let numbers: Vec<String> = (0..1000).map(|n: usize| n.to_string()).collect();
    text.push_str(&format!("*ELSET, ELSET=s0\n{}\n", numbers.join(",")));
    for k in 1..1000 {
        text.push_str(&format!("*ELSET, ELSET=s{k}\ns{}\n", k - 1));
    }
    let error = abaqus::parse(text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("sets of sets grow beyond all measure of the file"), "{error}");
}

#[test]
fn elements_that_lie_over_each_other_are_refused() {
    // A square twice, its nodes turned; a triangle over a half of it; a square over an edge that two have.
    for (more, elements) in [
        ("21, 3, 6, 5, 2", "elements 20 and 21"),
        ("*Element, type=cax3, elset=East\n21, 2, 3, 6", "elements 20 and 21"),
        (
            "*Node\n7, 1.5, 0.\n8, 1.5, 1.\n*Element, type=cax4, elset=East\n21, 2, 7, 8, 5",
            "elements 10 and 20",
        ),
    ] {
        let told = changed("20, 2, 3, 6, 5", &format!("20, 2, 3, 6, 5\n{more}"));
        assert!(told.starts_with(elements) && told.contains("lie over each other"), "{told}");
    }
}

#[test]
fn the_middle_of_a_line_of_three_nodes_is_its_second() {
    let text = "*Node
1, 0, 0
2, 1, 0
3, 1, 1
4, 0, 1
5, 0.5, 0
6, 1, 0.5
7, 0.5, 1
8, 0, 0.5
*Element, type=CPS8, elset=All
1, 1, 2, 3, 4, 5, 6, 7, 8
*Element, type=T3D3, elset=Right
2, 2, 6, 3
";
    let mesh: Mesh<2> = read(text).unwrap();
    is(face_measure(&mesh, &mesh.side_sets["Right"]), 1.0, "the right side");
}
