//! Types of elements, and Gmsh's order of nodes in terms of VTK's.

use crate::element::ElementKind;
use crate::mesh::raw::Shape;

/// The shape of a type that is read.
pub(super) fn shape(kind: i64) -> Option<Shape> {
    Some(match kind {
        1 => Shape::Line2,
        2 => Shape::Cell(ElementKind::Tri3),
        3 => Shape::Cell(ElementKind::Quad4),
        4 => Shape::Cell(ElementKind::Tet4),
        5 => Shape::Cell(ElementKind::Hex8),
        6 => Shape::Cell(ElementKind::Wedge6),
        8 => Shape::Line3,
        9 => Shape::Cell(ElementKind::Tri6),
        10 => Shape::Cell(ElementKind::Quad9),
        11 => Shape::Cell(ElementKind::Tet10),
        12 => Shape::Cell(ElementKind::Hex27),
        15 => Shape::Point,
        16 => Shape::Cell(ElementKind::Quad8),
        17 => Shape::Cell(ElementKind::Hex20),
        18 => Shape::Cell(ElementKind::Wedge15),
        _ => return None,
    })
}

/// What a type is called, for those that are not read.
pub(super) fn name(kind: i64) -> String {
    let name = match kind {
        7 => "pyramid of 5 nodes",
        13 => "wedge of 18 nodes",
        14 => "pyramid of 14 nodes",
        19 => "pyramid of 13 nodes",
        20 => "triangle of 9 nodes",
        21 => "triangle of 10 nodes",
        22 => "triangle of 12 nodes",
        23 | 25 => "triangle of 15 nodes",
        24 => "triangle of 15 nodes, incomplete",
        26 => "line of 4 nodes",
        27 => "line of 5 nodes",
        28 => "line of 6 nodes",
        29 => "tetrahedron of 20 nodes",
        30 => "tetrahedron of 35 nodes",
        31 => "tetrahedron of 56 nodes",
        36 => "quadrilateral of 16 nodes",
        37 => "quadrilateral of 25 nodes",
        38 => "quadrilateral of 36 nodes",
        92 => "hexahedron of 64 nodes",
        93 => "hexahedron of 125 nodes",
        _ => return format!("{kind} (no type of Gmsh that is known here)"),
    };
    format!("{kind} ({name})")
}

/// For each node in the order of VTK, its place in the order of Gmsh; empty where both agree. Both run through the mid-nodes
/// of edges, but through the edges in different orders; the tests compare them with the midpoints.
pub(super) fn order(shape: Shape) -> &'static [usize] {
    match shape {
        Shape::Cell(ElementKind::Tet10) => &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
        Shape::Cell(ElementKind::Hex20) => &HEX27[..20],
        Shape::Cell(ElementKind::Hex27) => &HEX27,
        Shape::Cell(ElementKind::Wedge15) => &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
        _ => &[],
    }
}

/// Corners, edges, faces, centre; the first 20 are those of the hexahedron of 20 nodes.
const HEX27: [usize; 27] =
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26];
