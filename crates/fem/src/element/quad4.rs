//! Bilinear quadrilateral on [-1, 1]².

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "quad4",
    dimension: 2,
    order: 1,
    linear: ElementKind::Quad4,
    corners: 4,
    nodes: NODES,
    faces: FACES,
    reversed: &[0, 3, 2, 1],
    shape,
    quadrature: || quadrature::gauss(2, 2),
    mass_quadrature: || quadrature::gauss(2, 2),
    vtk: 9,
    gmsh: ForeignElement { names: 3, order: &[] },
    abaqus: ForeignElement {
        names: (Some("4"), &["S4", "S4R", "S4R5", "R3D4", "SFM3D4", "SFM3D4R", "M3D4", "M3D4R"]),
        order: &[],
    },
    abaqus_faces: &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
};

const NODES: &[[f64; 3]] = &[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Seg2, nodes: &[0, 1] },
    Face { kind: FaceKind::Seg2, nodes: &[1, 2] },
    Face { kind: FaceKind::Seg2, nodes: &[2, 3] },
    Face { kind: FaceKind::Seg2, nodes: &[3, 0] },
];

fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, _]) in NODES.iter().enumerate() {
        s.n[a] = 0.25 * (1.0 + xa * x) * (1.0 + ya * y);
        s.dn[a] = [0.25 * xa * (1.0 + ya * y), 0.25 * ya * (1.0 + xa * x), 0.0];
    }
    s
}
