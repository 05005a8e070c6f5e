//! Serendipity hexahedron on [-1, 1]³: corners, mid-nodes of edges 01, 12, 23, 30, 45, 56, 67, 74, 04, 15, 26, 37. With
//! s = x x_a and so on, corners have ⅛ (1+s)(1+t)(1+u)(s+t+u-2), the mid-node of an edge along x ¼ (1-x²)(1+t)(1+u).
//!
//! Like [`super::quad8`], it contains all quadratic polynomials of the positions only if it is a parallelepiped.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "hex20",
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
    vtk: 25,
    gmsh: ForeignElement { names: 17, order: super::hex27::GMSH.split_at(20).0 },
    abaqus: ForeignElement { names: (Some("20"), &[]), order: &[] },
    abaqus_faces: super::hex8::DEFINITION.abaqus_faces,
};

const NODES: &[[f64; 3]] = super::hex27::NODES.split_at(20).0;

const FACES: &[Face] = &[
    Face { kind: FaceKind::Quad8, nodes: &[0, 3, 2, 1, 11, 10, 9, 8] },
    Face { kind: FaceKind::Quad8, nodes: &[4, 5, 6, 7, 12, 13, 14, 15] },
    Face { kind: FaceKind::Quad8, nodes: &[0, 1, 5, 4, 8, 17, 12, 16] },
    Face { kind: FaceKind::Quad8, nodes: &[1, 2, 6, 5, 9, 18, 13, 17] },
    Face { kind: FaceKind::Quad8, nodes: &[2, 3, 7, 6, 10, 19, 14, 18] },
    Face { kind: FaceKind::Quad8, nodes: &[3, 0, 4, 7, 11, 16, 15, 19] },
];

fn shape(x: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, node) in NODES.iter().enumerate() {
        let f: [f64; 3] = std::array::from_fn(|m| 1.0 + node[m] * x[m]);
        if let Some(along) = (0..3).find(|&m| node[m] == 0.0) {
            let (p, q) = ((along + 1) % 3, (along + 2) % 3);
            let bubble = 1.0 - x[along] * x[along];
            s.n[a] = 0.25 * bubble * f[p] * f[q];
            s.dn[a][along] = -0.5 * x[along] * f[p] * f[q];
            s.dn[a][p] = 0.25 * bubble * node[p] * f[q];
            s.dn[a][q] = 0.25 * bubble * node[q] * f[p];
        } else {
            let bracket = f[0] + f[1] + f[2] - 5.0;
            s.n[a] = 0.125 * f[0] * f[1] * f[2] * bracket;
            for m in 0..3 {
                let others = f[(m + 1) % 3] * f[(m + 2) % 3];
                s.dn[a][m] = 0.125 * node[m] * others * (bracket + f[m]);
            }
        }
    }
    s
}
