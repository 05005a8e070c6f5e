//! Element types, and Gmsh's order of nodes in terms of VTK's.

use crate::element::ElementKind;
use crate::mesh::raw::Shape;

/// The shape of a supported type.
pub(super) fn shape(kind: i64) -> Option<Shape> {
    match kind {
        1 => Some(Shape::Line2),
        8 => Some(Shape::Line3),
        15 => Some(Shape::Point),
        _ => ElementKind::ALL.into_iter().find(|e| e.definition().gmsh.names == kind).map(Shape::Cell),
    }
}

/// Name of a type, for those that are not supported.
pub(super) fn name(kind: i64) -> String {
    let name = match kind {
        7 => "pyramid of 5 nodes",
        13 => "wedge of 18 nodes",
        14 => "pyramid of 14 nodes",
        19 => "pyramid of 13 nodes",
        20 => "triangle of 9 nodes",
        21 => "triangle of 10 nodes",
        22 => "triangle of 12 nodes",
        23 => "triangle of 15 nodes",
        24 => "triangle of 15 nodes, incomplete",
        25 => "triangle of 21 nodes",
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

/// Position of each node, in the order of VTK, in the order of Gmsh; empty if both agree. Both list the mid-nodes by edges, but
/// with the edges in different orders; the tests compare them with the midpoints.
pub(super) fn order(shape: Shape) -> &'static [usize] {
    shape.element().map_or(&[], |element| element.definition().gmsh.order)
}
