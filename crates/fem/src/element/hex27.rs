//! Triquadratic hexahedron on [-1, 1]³: the nodes of [`super::hex20`], then the centres of the faces x-, x+, y-, y+, z-, z+,
//! and the centre. Products of the one-dimensional quadratic Lagrange functions.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::quad9::lagrange;
use super::shape::Shape;
use crate::quadrature;

/// Position of each node in the order of Gmsh: corners, edges, faces, centre; the first 20 are those of [`super::hex20`].
pub(super) const GMSH: &[usize] =
    &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26];

pub(super) const DEFINITION: Definition = Definition {
    name: "hex27",
    dimension: 3,
    order: 2,
    linear: ElementKind::Hex8,
    corners: 8,
    nodes: NODES,
    faces: FACES,
    reversed: &[],
    shape,
    quadrature: || quadrature::gauss(3, 3),
    mass_quadrature: || quadrature::gauss(3, 3),
    vtk: 29,
    gmsh: ForeignElement { names: 12, order: GMSH },
    abaqus: ForeignElement {
        names: (Some("27"), &[]),
        order: &[
            0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 26, 24, 23, 25, 21, 22, 20,
        ],
    },
    abaqus_faces: super::hex8::DEFINITION.abaqus_faces,
};

pub(super) const NODES: &[[f64; 3]] = &[
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [-1.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, -1.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, 0.0],
];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Quad9, nodes: &[0, 3, 2, 1, 11, 10, 9, 8, 24] },
    Face { kind: FaceKind::Quad9, nodes: &[4, 5, 6, 7, 12, 13, 14, 15, 25] },
    Face { kind: FaceKind::Quad9, nodes: &[0, 1, 5, 4, 8, 17, 12, 16, 22] },
    Face { kind: FaceKind::Quad9, nodes: &[1, 2, 6, 5, 9, 18, 13, 17, 21] },
    Face { kind: FaceKind::Quad9, nodes: &[2, 3, 7, 6, 10, 19, 14, 18, 23] },
    Face { kind: FaceKind::Quad9, nodes: &[3, 0, 4, 7, 11, 16, 15, 19, 20] },
];

fn shape([x, y, z]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, za]) in NODES.iter().enumerate() {
        let ((fx, dx), (fy, dy), (fz, dz)) = (lagrange(xa, x), lagrange(ya, y), lagrange(za, z));
        s.n[a] = fx * fy * fz;
        s.dn[a] = [dx * fy * fz, fx * dy * fz, fx * fy * dz];
    }
    s
}
