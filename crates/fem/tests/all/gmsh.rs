//! Meshes of Gmsh: supported and refused content.
#![allow(clippy::disallowed_methods)]

use crate::reading::{face_measure, measure, nodes_lie_where_the_element_has_them, sample, total};
use asperity_fem::element::ElementKind;
use asperity_fem::mesh::{GroupTag, Mesh, MeshError, Options, Place, Shape, abaqus, gmsh};

/// The written coordinates have the rounding of Gmsh's transfinite curves.
const ROUNDING: f64 = 1e-10;

fn read<const D: usize>(name: &str, options: &Options) -> Result<Mesh<D>, MeshError> {
    gmsh::parse(&sample(name))?.into_mesh(options)
}

fn good<const D: usize>(name: &str) -> Mesh<D> {
    read(name, &Options::default()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn is(value: f64, expected: f64, what: &str) {
    assert!((value - expected).abs() < ROUNDING, "{what}: {value} is not {expected}");
}

fn two_blocks<const D: usize>(name: &str, faces: &[&str]) -> Mesh<D> {
    let mesh = good::<D>(name);
    is(total(&mesh), 4.0, name);
    for body in ["lower", "upper"] {
        is(measure(&mesh, mesh.cell_sets[body].iter().copied()), 2.0, body);
    }
    for face in faces {
        is(face_measure(&mesh, &mesh.side_sets[*face]), 2.0, face);
    }
    mesh
}

#[test]
fn two_blocks_have_the_area_four_and_boundaries_of_two() {
    for name in [
        "good_2d_quad4_shared_ascii.msh",
        "good_2d_quad4_shared_v22.msh",
        "good_2d_quad4_crack_plugin_ascii.msh",
        "mixed_2d_tri3_quad4.msh",
    ] {
        let mesh = two_blocks::<2>(name, &["bottom", "top", "left", "right"]);
        // The fault lies between cells: both sides are in the set.
        is(face_measure(&mesh, &mesh.side_sets["fault"]), 4.0, name);
        assert_eq!(mesh.side_sets["fault"].len(), 12);
    }
    let split = two_blocks::<2>(
        "good_2d_quad4_split_nonmatching_ascii.msh",
        &["bottom", "top", "fault_minus", "fault_plus"],
    );
    assert_eq!((split.side_sets["fault_minus"].len(), split.side_sets["fault_plus"].len()), (6, 9));
}

#[test]
fn two_blocks_in_space_have_the_volume_four_and_a_fault_of_two() {
    let hex = two_blocks::<3>("good_3d_hex8_shared_ascii.msh", &["bottom", "top"]);
    is(face_measure(&hex, &hex.side_sets["fault"]), 4.0, "fault");
    let tet = two_blocks::<3>("good_3d_tet4_shared_ascii.msh", &["bottom", "top"]);
    is(face_measure(&tet, &tet.side_sets["fault"]), 4.0, "fault");
}

#[test]
fn both_sides_of_an_inner_face_are_ascending_and_belong_to_the_two_bodies() {
    let mesh = good::<2>("good_2d_quad4_shared_ascii.msh");
    let fault = &mesh.side_sets["fault"];
    assert!(fault.is_sorted());
    for body in ["lower", "upper"] {
        assert_eq!(fault.iter().filter(|s| mesh.cell_sets[body].contains(&s.block)).count(), 6);
    }
}

#[test]
fn a_mixed_mesh_has_a_block_of_each_kind() {
    let mesh = good::<2>("mixed_2d_tri3_quad4.msh");
    let kinds: Vec<ElementKind> = mesh.blocks.iter().map(|b| b.kind).collect();
    assert_eq!(kinds, [ElementKind::Quad4, ElementKind::Tri3]);
    assert_eq!((&mesh.cell_sets["lower"][..], &mesh.cell_sets["upper"][..]), (&[0][..], &[1][..]));
}

#[test]
fn version_22_and_41_of_a_mesh_agree() {
    let (a, b) = (good::<2>("good_2d_quad4_shared_ascii.msh"), good::<2>("good_2d_quad4_shared_v22.msh"));
    assert_eq!(a, b);
}

#[test]
fn every_element_has_its_nodes_in_place() {
    for name in ["tri3", "tri6", "quad4", "quad8", "quad9"] {
        unit::<2>(&[format!("unit_{name}.msh"), format!("unit_{name}_v22.msh"), binary(name)]);
    }
    for name in ["tet4", "tet10", "hex8", "hex20", "hex27", "wedge6", "wedge15"] {
        unit::<3>(&[format!("unit_{name}.msh"), binary(name)]);
    }
}

fn binary(name: &str) -> String {
    format!("unit_{name}_v22_binary.msh")
}

/// A unit square or cube, the same in all files.
fn unit<const D: usize>(names: &[String]) {
    let meshes: Vec<Mesh<D>> = names.iter().map(|name| good(name)).collect();
    let first = &meshes[0];
    for (mesh, name) in meshes.iter().zip(names) {
        is(total(mesh), 1.0, name);
        is(measure(mesh, mesh.cell_sets["body"].iter().copied()), 1.0, name);
        is(face_measure(mesh, &mesh.side_sets["low"]), 1.0, name);
        is(face_measure(mesh, &mesh.side_sets["high"]), 1.0, name);
        if D == 3 {
            is(face_measure(mesh, &mesh.side_sets["hull"]), 6.0, name);
        }
        assert_eq!(mesh.node_sets["corner"].len(), 1);
        assert_eq!(mesh.nodes[mesh.node_sets["corner"][0]], [0.0; D]);
        nodes_lie_where_the_element_has_them(mesh);
        assert_eq!((&mesh.blocks, &mesh.side_sets), (&first.blocks, &first.side_sets), "{name}");
        assert_eq!((&mesh.cell_sets, &mesh.node_sets), (&first.cell_sets, &first.node_sets), "{name}");
    }
}

#[test]
fn partitioned_periodic_and_parametric_meshes_are_as_others() {
    for name in [
        "unit_parametric.msh",
        "unit_parametric_binary.msh",
        "unit_parametric_v22.msh",
        "unit_periodic_binary.msh",
        "unit_partitioned.msh",
        "unit_partitioned_binary.msh",
        "unit_partitioned_v22.msh",
        "unit_clockwise.msh",
    ] {
        let mesh = good::<2>(name);
        is(total(&mesh), 1.0, name);
        is(face_measure(&mesh, &mesh.side_sets["low"]), 1.0, name);
        assert_eq!((mesh.nodes.len(), mesh.blocks.len(), mesh.blocks[0].len()), (9, 1, 4), "{name}");
    }
}

#[test]
fn a_cell_in_two_groups_is_one_cell_in_both() {
    for name in ["unit_two_groups.msh", "unit_two_groups_v22.msh"] {
        let mesh = good::<2>(name);
        assert_eq!((mesh.blocks.len(), mesh.blocks[0].len()), (1, 4), "{name}");
        assert_eq!((&mesh.cell_sets["body"], &mesh.cell_sets["also"]), (&vec![0], &vec![0]), "{name}");
    }
}

#[test]
fn unnamed_groups_are_named_by_their_numbers_or_by_a_map() {
    let name = "unit_unnamed_tags.msh";
    let mesh = good::<2>(name);
    assert_eq!(mesh.cell_sets.keys().collect::<Vec<_>>(), ["7"]);
    assert_eq!(mesh.side_sets.keys().collect::<Vec<_>>(), ["1", "2"]);
    let mut options = Options::default().requiring(["rock", "wall"]);
    options.tags.insert("rock".to_string(), 7.into());
    options.tags.insert("wall".to_string(), GroupTag { tag: 2, dimension: Some(1) });
    let mesh = read::<2>(name, &options).unwrap();
    assert_eq!((&mesh.cell_sets["rock"], mesh.side_sets["wall"].len()), (&vec![0], 2));
    options.tags.insert("gouge".to_string(), 9.into());
    let error = read::<2>(name, &options).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`gouge` is declared as group 9, but no group has this number; there are 1, 2, 5, 7"
    );
}

#[test]
fn lengths_in_kilometres_become_metres() {
    let options = Options { length_unit: 1000.0, ..Options::default() };
    let mesh = read::<2>("unit_quad4.msh", &options).unwrap();
    assert!((total(&mesh) - 1e6).abs() < 1e-3);
    let options = Options { length_unit: 0.0, ..Options::default() };
    let error = read::<2>("unit_quad4.msh", &options).unwrap_err();
    assert_eq!(error, MeshError::LengthUnit { metres: 0.0 });
}

/// Two quadrilaterals over [0, 2] x [0, 1], in different groups. Their common edge is in a group with the name of the first;
/// nodes are unsorted with gaps, and one of them is unused and off the plane.
const DIALECT: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nof PyLith\n$EndComments\n\
    $PhysicalNames\n4\n2 24 \"material-id:24\"\n2 3 \"upper crust\"\n1 3 \"upper crust\"\n0 3 \"upper crust\"\n\
    $EndPhysicalNames\n$Nodes\n7\n900 2 1 0\n7 0 0 0\n30 1 0 0\n2 1 1 0\n8 5 5 0\n1 0 1 0\n31 2 0 0\n$EndNodes\n\
    $Elements\n4\n11 3 2 24 1 7 30 2 1\n12 3 2 3 2 30 31 900 2\n13 1 2 3 1 30 2\n14 15 2 3 1 7\n$EndElements\n";

#[test]
fn one_name_on_several_dimensions_stays_apart() {
    let mesh: Mesh<2> = gmsh::parse(DIALECT.as_bytes()).unwrap().into_mesh(&Options::default()).unwrap();
    assert_eq!(mesh.nodes, [[2.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.0]]);
    assert_eq!(mesh.blocks.len(), 2);
    assert_eq!(mesh.cell_sets["upper crust"], [0]);
    assert_eq!(mesh.cell_sets["material-id:24"], [1]);
    assert_eq!(mesh.side_sets["upper crust"].len(), 2);
    assert_eq!(mesh.node_sets["upper crust"], [1]);
}

#[test]
fn a_material_id_is_a_number_of_the_map() {
    let mut options = Options::default();
    options.tags.insert("granite".to_string(), 24.into());
    let mesh: Mesh<2> = gmsh::parse(DIALECT.as_bytes()).unwrap().into_mesh(&options).unwrap();
    assert_eq!(mesh.cell_sets["granite"], [1]);
}

/// Converts every number of a little-endian binary file of version 2.2 of quadrilaterals, lines and points to big-endian.
fn to_big_endian(bytes: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    let find = |what: &str| bytes.windows(what.len()).position(|w| w == what.as_bytes()).unwrap();
    let line = |from: usize| from + bytes[from..].iter().position(|&b| b == b'\n').unwrap() + 1;
    let header = line(line(find("$MeshFormat")));
    out[header..header + 4].reverse();
    let (nodes, end) = (line(line(find("$Nodes"))), find("$EndNodes") - 1);
    for node in out[nodes..end].chunks_exact_mut(28) {
        node[..4].reverse();
        node[4..].chunks_exact_mut(8).for_each(<[u8]>::reverse);
    }
    let (elements, end) = (line(line(find("$Elements"))), find("$EndElements") - 1);
    out[elements..end].chunks_exact_mut(4).for_each(<[u8]>::reverse);
    out
}

#[test]
fn both_orders_of_bytes_are_read() {
    let little = sample("unit_hex20_v22_binary.msh");
    let big = to_big_endian(&little);
    assert_ne!(little, big);
    assert_eq!(gmsh::parse(&little), gmsh::parse(&big));
    let mut neither = little;
    let at = neither.windows(4).position(|w| w == [1, 0, 0, 0]).unwrap();
    neither[at + 1] = 1;
    assert_eq!(gmsh::parse(&neither), Err(MeshError::ByteOrder { place: Place::Byte(at) }));
}

fn refused<const D: usize>(name: &str, options: &Options) -> String {
    read::<D>(name, options).unwrap_err().to_string()
}

#[test]
fn a_mesh_without_groups_is_refused() {
    let options = Options::default().requiring(["fault"]);
    assert_eq!(
        refused::<2>("bad_no_physical_groups.msh", &options),
        "the mesh has no groups (36 cells without any): name the bodies and boundaries as physical groups (Gmsh) or sets \
         (Abaqus) and write the file again; asked for: fault"
    );
}

#[test]
fn a_missing_group_is_named_beside_those_present_and_the_nearest() {
    let options = Options::default().requiring(["lower", "fault"]);
    assert_eq!(
        refused::<2>("bad_missing_fault_group.msh", &options),
        "there is no group `fault`; there are `upper` (surfaces), `lower` (surfaces)"
    );
    let options = Options::default().requiring(["Fualt"]);
    assert_eq!(
        refused::<2>("good_2d_quad4_shared_v22.msh", &options),
        "there is no group `Fualt`; did you mean `fault`?; there are `upper` (surfaces), `lower` (surfaces), \
         `top` (lines), `right` (lines), `left` (lines), `fault` (lines), `bottom` (lines)"
    );
}

#[test]
fn inverted_and_folded_elements_are_named() {
    let inverted = refused::<2>("bad_inverted_element.msh", &Options::default());
    assert!(inverted.starts_with("element 31 (quad4) is inverted"), "{inverted}");
    let folded = refused::<2>("bad_bowtie_element.msh", &Options::default());
    assert!(folded.starts_with("element 31 (quad4) is folded or flat"), "{folded}");
}

#[test]
fn a_reference_to_no_node_names_element_and_node() {
    assert_eq!(
        refused::<2>("bad_dangling_node_ref.msh", &Options::default()),
        "element 31 refers to node 99999, which does not exist"
    );
}

#[test]
fn a_part_that_hangs_free_is_named_with_its_coincident_nodes() {
    assert_eq!(
        refused::<2>("bad_duplicate_nodes_unwelded.msh", &Options::default()),
        "the part `upper` (18 cells, among them element 37) hangs free: 7 of its nodes coincide with nodes of the part \
         `lower` (18 cells, among them element 19), but the two share none, and no named face lies there on both sides. \
         Weld the nodes, or name the faces on both sides when they are an interface"
    );
    let options = Options { allow_free_parts: true, ..Options::default() };
    assert!(read::<2>("bad_duplicate_nodes_unwelded.msh", &options).is_ok());
}

/// The rungs of a layer one cell wide join nodes of both walls of its trough, and are no faces of the seam.
#[test]
fn a_thin_layer_with_named_sides_does_not_hang_free() {
    let mesh = good::<2>("good_2d_quad4_layer_in_a_trough.msh");
    assert_eq!((mesh.side_sets["trough"].len(), mesh.side_sets["filling"].len()), (5, 5));
}

#[test]
fn a_coordinate_that_is_no_number_names_the_node() {
    let error = read::<2>("bad_nan_coordinate.msh", &Options::default()).unwrap_err();
    assert!(matches!(error, MeshError::Coordinate { node: 1, axis: 0, value } if value.is_nan()), "{error}");
}

#[test]
fn a_truncated_file_is_refused_with_its_section() {
    let error = read::<3>("bad_truncated_binary.msh", &Options::default()).unwrap_err();
    assert!(matches!(&error, MeshError::Truncated { section, .. } if section == "$Elements"), "{error}");
}

#[test]
fn a_mesh_of_another_dimension_is_refused() {
    let error = read::<3>("good_2d_quad4_shared_v22.msh", &Options::default()).unwrap_err();
    assert_eq!(error, MeshError::Dimension { found: 2, wanted: 3 });
    let error = read::<2>("good_3d_hex8_shared_ascii.msh", &Options::default()).unwrap_err();
    assert_eq!(error, MeshError::Dimension { found: 3, wanted: 2 });
}

/// Reads the dialect file with some text replaced.
fn changed(from: &str, to: &str) -> MeshError {
    assert!(DIALECT.contains(from));
    let text = DIALECT.replacen(from, to, 1);
    gmsh::parse(text.as_bytes()).and_then(|raw| raw.into_mesh::<2>(&Options::default())).unwrap_err()
}

#[test]
fn small_faults_of_a_file_are_named_with_their_places() {
    for (from, to, message) in [
        ("2.2 0", "4.0 0", "MSH version 4.0 is not read; those that are: 2.2 and 4.1"),
        ("2.2 0 8", "2.2 0 4", "$MeshFormat: numbers of 4 bytes are not read, only those of 8"),
        ("900 2 1 0", "900 2 one 0", "$Nodes, line 16: expected coordinate, found `one`"),
        ("900 2 1 0", "900 2 1 1e-3", "node 900 of the plane mesh has z = 1e-3: a plane mesh lies in z = 0"),
        ("900 2 1 0", "7 2 1 0", "node 7 is defined twice"),
        ("13 1 2 3 1 30 2", "13 1 2 3 1 30 1", ORPHAN),
        ("14 15 2 3 1 7", "14 15 2 3 1 8", &ORPHAN.replace("13", "14")),
        (
            "12 3 2 3 2",
            "12 77 2 3 2",
            "$Elements, line 27: element 12 has the unsupported type 77 (no type of Gmsh that is known here)",
        ),
        ("$Nodes\n7", "$Nodes\n8", "$Nodes, line 23: expected the number of a node, found `$EndNodes`"),
        ("$Nodes\n7", "$Nodes\n999", TOO_MANY),
        (
            "$EndElements\n",
            "",
            "$Elements, line 30: 1 end of the section announced, but only 0 bytes follow: the file is \
          truncated or its header is damaged",
        ),
    ] {
        assert_eq!(changed(from, to).to_string(), message);
    }
}

const ORPHAN: &str = "1 of the elements of group `upper crust` belong to no cell of the mesh, the first is element 13: a \
    body beside them is missing in the file, or they lie off it";

const TOO_MANY: &str = "$Nodes, line 15: 999 nodes announced, but only 170 bytes follow: the file is truncated or its header \
    is damaged";

#[test]
fn a_count_of_a_header_is_bounded_before_anything_is_made_of_it() {
    let mut bytes = sample("unit_periodic_binary.msh");
    let at = bytes.windows(7).position(|w| w == b"$Nodes\n").unwrap() + 7 + 8;
    bytes[at..at + 8].copy_from_slice(&(1_u64 << 40).to_le_bytes());
    let error = gmsh::parse(&bytes).unwrap_err();
    assert!(matches!(error, MeshError::Truncated { count: 0x100_0000_0000, what: "nodes", .. }), "{error}");
}

/// Corners whose midpoint is the position of each node beyond the corners, in the order of VTK.
fn middles(shape: Shape) -> &'static [&'static [usize]] {
    match shape {
        Shape::Cell(ElementKind::Tet10) => &[&[0, 1], &[1, 2], &[2, 0], &[0, 3], &[1, 3], &[2, 3]],
        Shape::Cell(ElementKind::Wedge15) => {
            &[&[0, 1], &[1, 2], &[2, 0], &[3, 4], &[4, 5], &[5, 3], &[0, 3], &[1, 4], &[2, 5]]
        }
        Shape::Cell(ElementKind::Hex20) => &HEX27_MIDDLES[..12],
        Shape::Cell(ElementKind::Hex27) => &HEX27_MIDDLES,
        Shape::Cell(ElementKind::Quad8) => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
        Shape::Cell(ElementKind::Quad9) => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0], &[0, 1, 2, 3]],
        Shape::Cell(ElementKind::Tri6) => &[&[0, 1], &[1, 2], &[2, 0]],
        _ => &[],
    }
}

/// Edges below, above and between; faces x-, x+, y-, y+, z-, z+; centre.
const HEX27_MIDDLES: [&[usize]; 19] = [
    &[0, 1],
    &[1, 2],
    &[2, 3],
    &[3, 0],
    &[4, 5],
    &[5, 6],
    &[6, 7],
    &[7, 4],
    &[0, 4],
    &[1, 5],
    &[2, 6],
    &[3, 7],
    &[0, 3, 7, 4],
    &[1, 2, 6, 5],
    &[0, 1, 5, 4],
    &[2, 3, 7, 6],
    &[0, 1, 2, 3],
    &[4, 5, 6, 7],
    &[0, 1, 2, 3, 4, 5, 6, 7],
];

#[test]
fn mid_nodes_of_a_file_lie_between_their_corners_in_the_order_of_vtk() {
    for (name, shape) in [
        ("unit_tri6.msh", Shape::Cell(ElementKind::Tri6)),
        ("unit_quad8.msh", Shape::Cell(ElementKind::Quad8)),
        ("good_2d_quad8_shared_ascii.msh", Shape::Cell(ElementKind::Quad8)),
        ("unit_quad9.msh", Shape::Cell(ElementKind::Quad9)),
        ("unit_tet10.msh", Shape::Cell(ElementKind::Tet10)),
        ("unit_tet10_v22_binary.msh", Shape::Cell(ElementKind::Tet10)),
        ("unit_tet10.inp", Shape::Cell(ElementKind::Tet10)),
        ("good_3d_tet10_shared_binary.msh", Shape::Cell(ElementKind::Tet10)),
        ("unit_hex20.msh", Shape::Cell(ElementKind::Hex20)),
        ("unit_hex20_v22_binary.msh", Shape::Cell(ElementKind::Hex20)),
        ("unit_hex20.inp", Shape::Cell(ElementKind::Hex20)),
        ("unit_hex27.msh", Shape::Cell(ElementKind::Hex27)),
        ("unit_hex27.inp", Shape::Cell(ElementKind::Hex27)),
        ("unit_wedge15.msh", Shape::Cell(ElementKind::Wedge15)),
        ("unit_wedge15_v22_binary.msh", Shape::Cell(ElementKind::Wedge15)),
        ("unit_wedge15.inp", Shape::Cell(ElementKind::Wedge15)),
    ] {
        let read = if name.ends_with(".inp") { abaqus::parse } else { gmsh::parse };
        let raw = read(&sample(name)).unwrap();
        let x = |tag: u64| raw.nodes.iter().find(|n| n.tag == tag).unwrap().x;
        let blocks: Vec<_> = raw.blocks.iter().filter(|b| b.shape == shape).collect();
        assert!(!blocks.is_empty(), "{name}");
        for nodes in blocks.iter().flat_map(|b| b.nodes.chunks_exact(shape.nodes())) {
            assert_eq!(shape.corners() + middles(shape).len(), shape.nodes());
            for (corners, &node) in middles(shape).iter().zip(&nodes[shape.corners()..]) {
                for axis in 0..3 {
                    let mean = corners.iter().map(|&c| x(nodes[c])[axis]).sum::<f64>() / corners.len() as f64;
                    assert!((x(node)[axis] - mean).abs() < 1e-9, "{name}: node {node}");
                }
            }
        }
    }
}

/// A hexahedron of the volume `rock` under a pyramid of another, in version 2.2 and 4.1.
fn under_a_pyramid(volume: &str) -> [String; 2] {
    let names = format!("$PhysicalNames\n2\n3 1 \"rock\"\n3 2 \"{volume}\"\n$EndPhysicalNames\n");
    let x = ["0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1", "0.5 0.5 2"];
    let v22: String = x.iter().enumerate().map(|(n, x)| format!("{} {x}\n", n + 1)).collect();
    let v22 = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{names}$Nodes\n9\n{v22}$EndNodes\n$Elements\n2\n\
         1 5 2 1 1 1 2 3 4 5 6 7 8\n2 7 2 2 2 5 6 7 8 9\n$EndElements\n"
    );
    let v41 = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{names}$Entities\n0 0 0 2\n1 0 0 0 1 1 1 1 1 0\n2 0 0 1 1 1 2 1 2 0\n\
         $EndEntities\n$Nodes\n1 9 1 9\n3 1 0 9\n1\n2\n3\n4\n5\n6\n7\n8\n9\n{}\n$EndNodes\n$Elements\n2 2 1 2\n3 1 5 1\n\
         1 1 2 3 4 5 6 7 8\n3 2 7 1\n2 5 6 7 8 9\n$EndElements\n",
        x.join("\n")
    );
    [v22, v41]
}

#[test]
fn elements_that_no_body_asks_for_need_not_be_known() {
    let options = Options { only: Some(vec!["rock".to_string()]), ..Options::default() };
    for text in under_a_pyramid("cap") {
        let mesh: Mesh<3> = gmsh::parse(text.as_bytes()).unwrap().into_mesh(&options).unwrap();
        assert_eq!(mesh.nodes.len(), 8);
        let left = &mesh.left_out["cap"];
        assert_eq!((left.kind.as_str(), left.count, left.element), ("7 (pyramid of 5 nodes)", 1, 2));
    }
}

#[test]
fn a_body_that_asks_for_elements_that_are_not_read_would_have_a_hole() {
    let mut numbered = Options { only: Some(vec!["solid".to_string()]), ..Options::default() };
    numbered.tags.insert("solid".to_string(), 2.into());
    let named = Options { only: Some(vec!["rock".to_string()]), ..Options::default() };
    for (volume, options) in [("cap", Options::default()), ("cap", numbered), ("rock", named)] {
        for (text, line) in under_a_pyramid(volume).iter().zip([24, 40]) {
            let error = gmsh::parse(text.as_bytes()).unwrap().into_mesh::<3>(&options).unwrap_err();
            let wanted =
                format!("$Elements, line {line}: elements of type 7 (pyramid of 5 nodes) are not read");
            assert_eq!(error.to_string(), wanted);
        }
    }
}
