//! Trilinear hexahedron on [-1, 1]³.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "hex8",
    dimension: 3,
    order: 1,
    linear: ElementKind::Hex8,
    corners: 8,
    nodes: NODES,
    faces: FACES,
    reversed: &[],
    shape,
    quadrature: || quadrature::gauss(2, 3),
    mass_quadrature: || quadrature::gauss(2, 3),
    vtk: 12,
    gmsh: ForeignElement { names: 5, order: &[] },
    abaqus: ForeignElement { names: (Some("8"), &[]), order: &[] },
    abaqus_faces: &[&[0, 1, 2, 3], &[4, 7, 6, 5], &[0, 4, 5, 1], &[1, 5, 6, 2], &[2, 6, 7, 3], &[3, 7, 4, 0]],
};

const NODES: &[[f64; 3]] = &[
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Quad4, nodes: &[0, 3, 2, 1] },
    Face { kind: FaceKind::Quad4, nodes: &[4, 5, 6, 7] },
    Face { kind: FaceKind::Quad4, nodes: &[0, 1, 5, 4] },
    Face { kind: FaceKind::Quad4, nodes: &[1, 2, 6, 5] },
    Face { kind: FaceKind::Quad4, nodes: &[2, 3, 7, 6] },
    Face { kind: FaceKind::Quad4, nodes: &[3, 0, 4, 7] },
];

fn shape([x, y, z]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, za]) in NODES.iter().enumerate() {
        let (fx, fy, fz) = (1.0 + xa * x, 1.0 + ya * y, 1.0 + za * z);
        s.n[a] = 0.125 * fx * fy * fz;
        s.dn[a] = [0.125 * xa * fy * fz, 0.125 * ya * fx * fz, 0.125 * za * fx * fy];
    }
    s
}
