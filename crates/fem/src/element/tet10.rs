//! Quadratic tetrahedron: corners, then mid-nodes of edges 01, 12, 20, 03, 13, 23. With volume coordinates λ, corners have
//! λ(2λ-1) and mid-nodes 4 λ_i λ_j.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "tet10",
    dimension: 3,
    order: 2,
    linear: ElementKind::Tet4,
    corners: 4,
    nodes: NODES,
    faces: FACES,
    reversed: &[],
    shape,
    quadrature: quadrature::tetrahedron_4,
    mass_quadrature: quadrature::tetrahedron_14,
    vtk: 24,
    gmsh: ForeignElement { names: 11, order: &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8] },
    abaqus: ForeignElement { names: (Some("10"), &[]), order: &[] },
    abaqus_faces: super::tet4::DEFINITION.abaqus_faces,
};

const NODES: &[[f64; 3]] = &[
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.0, 0.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.0],
    [0.0, 0.0, 0.5],
    [0.5, 0.0, 0.5],
    [0.0, 0.5, 0.5],
];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Tri6, nodes: &[0, 2, 1, 6, 5, 4] },
    Face { kind: FaceKind::Tri6, nodes: &[0, 1, 3, 4, 8, 7] },
    Face { kind: FaceKind::Tri6, nodes: &[1, 2, 3, 5, 9, 8] },
    Face { kind: FaceKind::Tri6, nodes: &[0, 3, 2, 7, 9, 6] },
];

/// Ends of the edges that carry nodes 4 to 9.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

fn shape([x, y, z]: [f64; 3]) -> Shape {
    let l = [1.0 - x - y - z, x, y, z];
    let dl = [[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut s = Shape::default();
    for i in 0..4 {
        s.n[i] = l[i] * (2.0 * l[i] - 1.0);
        s.dn[i] = dl[i].map(|d| (4.0 * l[i] - 1.0) * d);
    }
    for (k, [i, j]) in EDGES.into_iter().enumerate() {
        s.n[4 + k] = 4.0 * l[i] * l[j];
        s.dn[4 + k] = std::array::from_fn(|m| 4.0 * (dl[i][m] * l[j] + l[i] * dl[j][m]));
    }
    s
}
