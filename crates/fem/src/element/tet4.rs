//! Linear tetrahedron on 0 ≤ ξ, η, ζ, ξ + η + ζ ≤ 1.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "tet4",
    dimension: 3,
    order: 1,
    linear: ElementKind::Tet4,
    corners: 4,
    nodes: NODES,
    faces: FACES,
    reversed: &[],
    shape,
    quadrature: quadrature::tetrahedron_1,
    mass_quadrature: quadrature::tetrahedron_4,
    vtk: 10,
    gmsh: ForeignElement { names: 4, order: &[] },
    abaqus: ForeignElement { names: (Some("4"), &[]), order: &[] },
    abaqus_faces: &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]],
};

const NODES: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Tri3, nodes: &[0, 2, 1] },
    Face { kind: FaceKind::Tri3, nodes: &[0, 1, 3] },
    Face { kind: FaceKind::Tri3, nodes: &[1, 2, 3] },
    Face { kind: FaceKind::Tri3, nodes: &[0, 3, 2] },
];

fn shape([x, y, z]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    s.n[..4].copy_from_slice(&[1.0 - x - y - z, x, y, z]);
    s.dn[..4].copy_from_slice(&[[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    s
}
