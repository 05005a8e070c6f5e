//! Linear triangle on 0 ≤ ξ, η, ξ + η ≤ 1.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "tri3",
    dimension: 2,
    order: 1,
    linear: ElementKind::Tri3,
    corners: 3,
    nodes: NODES,
    faces: FACES,
    reversed: &[0, 2, 1],
    shape,
    quadrature: quadrature::triangle_1,
    mass_quadrature: quadrature::triangle_3,
    vtk: 5,
    gmsh: ForeignElement { names: 2, order: &[] },
    abaqus: ForeignElement {
        names: (Some("3"), &["STRI3", "S3", "S3R", "R3D3", "SFM3D3", "M3D3"]),
        order: &[],
    },
    abaqus_faces: &[&[0, 1], &[1, 2], &[2, 0]],
};

const NODES: &[[f64; 3]] = &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Seg2, nodes: &[0, 1] },
    Face { kind: FaceKind::Seg2, nodes: &[1, 2] },
    Face { kind: FaceKind::Seg2, nodes: &[2, 0] },
];

fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    s.n[..3].copy_from_slice(&[1.0 - x - y, x, y]);
    s.dn[..3].copy_from_slice(&[[-1.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    s
}
