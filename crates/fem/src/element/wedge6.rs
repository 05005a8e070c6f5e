//! Linear wedge (prism): the triangle ξ, η ≥ 0, ξ + η ≤ 1 times -1 ≤ ζ ≤ 1. Nodes 0, 1, 2 at the lower end run
//! counter-clockwise seen from the upper one, nodes 3, 4, 5 lie above them: N = λ_i (1 ± ζ)/2.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "wedge6",
    dimension: 3,
    order: 1,
    linear: ElementKind::Wedge6,
    corners: 6,
    nodes: NODES,
    faces: FACES,
    reversed: &[],
    shape,
    quadrature: || quadrature::wedge(quadrature::triangle_3(), 2),
    mass_quadrature: || quadrature::wedge(quadrature::triangle_3(), 2),
    vtk: 13,
    gmsh: ForeignElement { names: 6, order: &[] },
    abaqus: ForeignElement { names: (Some("6"), &[]), order: &[] },
    abaqus_faces: super::wedge15::DEFINITION.abaqus_faces,
};

const NODES: &[[f64; 3]] = super::wedge15::NODES.split_at(6).0;

const FACES: &[Face] = &[
    Face { kind: FaceKind::Tri3, nodes: &[0, 2, 1] },
    Face { kind: FaceKind::Tri3, nodes: &[3, 4, 5] },
    Face { kind: FaceKind::Quad4, nodes: &[0, 1, 4, 3] },
    Face { kind: FaceKind::Quad4, nodes: &[1, 2, 5, 4] },
    Face { kind: FaceKind::Quad4, nodes: &[2, 0, 3, 5] },
];

fn shape([x, y, z]: [f64; 3]) -> Shape {
    let l = [1.0 - x - y, x, y];
    let dl = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let mut s = Shape::default();
    for (layer, end) in [-1.0, 1.0].into_iter().enumerate() {
        let f = 0.5 * (1.0 + end * z);
        for i in 0..3 {
            s.n[3 * layer + i] = l[i] * f;
            s.dn[3 * layer + i] = [dl[i][0] * f, dl[i][1] * f, 0.5 * end * l[i]];
        }
    }
    s
}
