//! Types of elements: their shapes, order of nodes and numbered faces.

use crate::element::ElementKind;
use crate::mesh::raw::Shape;

/// The shape of an element type: continuum elements of any integration, and trusses, beams, shells, membranes and rigid
/// faces, whose shapes only name edges and faces here.
pub(super) fn shape(kind: &str) -> Option<Shape> {
    match kind {
        "T2D2" | "T3D2" | "B21" | "B31" | "R2D2" => return Some(Shape::Line2),
        "T2D3" | "T3D3" | "B22" | "B32" => return Some(Shape::Line3),
        "STRI3" | "S3" | "S3R" | "R3D3" | "SFM3D3" | "M3D3" => return Some(Shape::Cell(ElementKind::Tri3)),
        "STRI65" | "SFM3D6" | "M3D6" => return Some(Shape::Cell(ElementKind::Tri6)),
        "S4" | "S4R" | "S4R5" | "R3D4" | "SFM3D4" | "SFM3D4R" | "M3D4" | "M3D4R" => {
            return Some(Shape::Cell(ElementKind::Quad4));
        }
        "S8R" | "S8R5" | "SFM3D8" | "SFM3D8R" | "M3D8" | "M3D8R" => {
            return Some(Shape::Cell(ElementKind::Quad8));
        }
        "S9R5" | "M3D9" | "M3D9R" => return Some(Shape::Cell(ElementKind::Quad9)),
        _ => {}
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
    match (solid, &rest[..digits]) {
        (false, "3") => Some(Shape::Cell(ElementKind::Tri3)),
        (false, "4") => Some(Shape::Cell(ElementKind::Quad4)),
        (false, "6") => Some(Shape::Cell(ElementKind::Tri6)),
        (false, "8") => Some(Shape::Cell(ElementKind::Quad8)),
        (true, "4") => Some(Shape::Cell(ElementKind::Tet4)),
        (true, "6") => Some(Shape::Cell(ElementKind::Wedge6)),
        (true, "8") => Some(Shape::Cell(ElementKind::Hex8)),
        (true, "10") => Some(Shape::Cell(ElementKind::Tet10)),
        (true, "15") => Some(Shape::Cell(ElementKind::Wedge15)),
        (true, "20") => Some(Shape::Cell(ElementKind::Hex20)),
        (true, "27") => Some(Shape::Cell(ElementKind::Hex27)),
        _ => None,
    }
}

/// For each node in the order of VTK, its place in the order of Abaqus; empty where both agree, which they do but for the
/// hexahedron of 27 nodes: Abaqus puts the centre before the faces, and those in the order S1 to S6.
pub(super) fn order(shape: Shape) -> &'static [usize] {
    const HEX27: [usize; 27] =
        [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 26, 24, 23, 25, 21, 22, 20];
    if shape == Shape::Cell(ElementKind::Hex27) { &HEX27 } else { &[] }
}

/// Corners of the faces S1, S2, ... of a shape.
pub(super) fn faces(shape: Shape) -> &'static [&'static [usize]] {
    match shape {
        Shape::Cell(ElementKind::Tri3) | Shape::Cell(ElementKind::Tri6) => &[&[0, 1], &[1, 2], &[2, 0]],
        Shape::Cell(ElementKind::Quad4)
        | Shape::Cell(ElementKind::Quad8)
        | Shape::Cell(ElementKind::Quad9) => &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
        Shape::Cell(ElementKind::Tet4) | Shape::Cell(ElementKind::Tet10) => {
            &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]]
        }
        Shape::Cell(ElementKind::Wedge6) | Shape::Cell(ElementKind::Wedge15) => {
            &[&[0, 1, 2], &[3, 5, 4], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]]
        }
        Shape::Cell(ElementKind::Hex8)
        | Shape::Cell(ElementKind::Hex20)
        | Shape::Cell(ElementKind::Hex27) => {
            &[&[0, 1, 2, 3], &[4, 7, 6, 5], &[0, 4, 5, 1], &[1, 5, 6, 2], &[2, 6, 7, 3], &[3, 7, 4, 0]]
        }
        Shape::Point | Shape::Line2 | Shape::Line3 => &[],
    }
}
