//! Element types: their shapes, order of nodes and numbered faces.

use crate::element::ElementKind;
use crate::mesh::raw::Shape;

/// The shape of an element type: continuum elements with any integration; trusses, beams, shells, membranes and rigid faces,
/// whose shapes serve only to name edges and faces.
pub(super) fn shape(kind: &str) -> Option<Shape> {
    match kind {
        "T2D2" | "T3D2" | "B21" | "B31" | "R2D2" => return Some(Shape::Line2),
        "T2D3" | "T3D3" | "B22" | "B32" => return Some(Shape::Line3),
        _ => {}
    }
    let named = |e: &ElementKind| e.definition().abaqus.names.1.contains(&kind);
    if let Some(element) = ElementKind::ALL.into_iter().find(named) {
        return Some(Shape::Cell(element));
    }
    let plane = ["CPE", "CPS", "CAX"].iter().find_map(|family| kind.strip_prefix(family));
    let (rest, solid) = match plane {
        Some(rest) => (rest, false),
        None => (kind.strip_prefix("C3D")?, true),
    };
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    // Reduced, hybrid, incompatible, modified, and improved stress: the shape is the same.
    if !rest[digits..].bytes().all(|b| b"RHIMS".contains(&b)) {
        return None;
    }
    let dimension = if solid { 3 } else { 2 };
    let numbered = |e: &ElementKind| {
        let definition = e.definition();
        definition.dimension == dimension && definition.abaqus.names.0 == Some(&rest[..digits])
    };
    ElementKind::ALL.into_iter().find(numbered).map(Shape::Cell)
}

/// Position of each node, in the order of VTK, in the order of Abaqus; empty if both agree. They differ for lines of three nodes, of
/// which the second is the middle, and for the hexahedron of 27 nodes: Abaqus puts the centre before the faces, and those in the
/// order S1 to S6.
pub(super) fn order(shape: Shape) -> &'static [usize] {
    if shape == Shape::Line3 {
        return &[0, 2, 1];
    }
    shape.element().map_or(&[], |element| element.definition().abaqus.order)
}

/// Corners of the faces S1, S2, ... of a shape.
pub(super) fn faces(shape: Shape) -> &'static [&'static [usize]] {
    shape.element().map_or(&[], |element| element.definition().abaqus_faces)
}

/// Dimension of a type of continuum elements, which bodies are made of; `None` for other types.
pub(super) fn dimension(kind: &str) -> Option<usize> {
    let solid = kind.starts_with("C3D").then_some(3);
    let plane = ["CPE", "CPS", "CAX", "CGAX", "CCL"].iter().any(|family| kind.starts_with(family));
    solid.or_else(|| plane.then_some(2))
}
