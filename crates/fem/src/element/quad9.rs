//! Biquadratic quadrilateral on [-1, 1]²: corners, mid-nodes of edges 01, 12, 23, 30, centre. Products of the
//! one-dimensional quadratic Lagrange functions.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "quad9",
    dimension: 2,
    order: 2,
    linear: ElementKind::Quad4,
    corners: 4,
    nodes: NODES,
    faces: FACES,
    reversed: &[0, 3, 2, 1, 7, 6, 5, 4, 8],
    shape,
    quadrature: || quadrature::gauss(3, 2),
    mass_quadrature: || quadrature::gauss(3, 2),
    vtk: 28,
    gmsh: ForeignElement { names: 10, order: &[] },
    abaqus: ForeignElement { names: (None, &["S9R5", "M3D9", "M3D9R"]), order: &[] },
    abaqus_faces: super::quad4::DEFINITION.abaqus_faces,
};

pub(super) const NODES: &[[f64; 3]] = &[
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0],
];

pub(super) const FACES: &[Face] = &[
    Face { kind: FaceKind::Seg3, nodes: &[0, 1, 4] },
    Face { kind: FaceKind::Seg3, nodes: &[1, 2, 5] },
    Face { kind: FaceKind::Seg3, nodes: &[2, 3, 6] },
    Face { kind: FaceKind::Seg3, nodes: &[3, 0, 7] },
];

/// Lagrange function that is 1 at `node` in {-1, 0, 1}, and its derivative.
pub(super) fn lagrange(node: f64, x: f64) -> (f64, f64) {
    if node == 0.0 { (1.0 - x * x, -2.0 * x) } else { (0.5 * x * (x + node), x + 0.5 * node) }
}

fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, _]) in NODES.iter().enumerate() {
        let ((fx, dx), (fy, dy)) = (lagrange(xa, x), lagrange(ya, y));
        s.n[a] = fx * fy;
        s.dn[a] = [dx * fy, fx * dy, 0.0];
    }
    s
}
