//! Quadratic triangle: corners, then mid-nodes of edges 01, 12, 20. With area coordinates λ, corners have λ(2λ-1) and
//! mid-nodes 4 λ_i λ_j.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "tri6",
    dimension: 2,
    order: 2,
    linear: ElementKind::Tri3,
    corners: 3,
    nodes: NODES,
    faces: FACES,
    reversed: &[0, 2, 1, 5, 4, 3],
    shape,
    quadrature: quadrature::triangle_3,
    mass_quadrature: quadrature::triangle_6,
    vtk: 22,
    gmsh: ForeignElement { names: 9, order: &[] },
    abaqus: ForeignElement { names: (Some("6"), &["STRI65", "SFM3D6", "M3D6"]), order: &[] },
    abaqus_faces: super::tri3::DEFINITION.abaqus_faces,
};

const NODES: &[[f64; 3]] =
    &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.0]];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Seg3, nodes: &[0, 1, 3] },
    Face { kind: FaceKind::Seg3, nodes: &[1, 2, 4] },
    Face { kind: FaceKind::Seg3, nodes: &[2, 0, 5] },
];

fn shape([x, y, _]: [f64; 3]) -> Shape {
    let l = [1.0 - x - y, x, y];
    let dl = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let mut s = Shape::default();
    for i in 0..3 {
        let j = (i + 1) % 3;
        s.n[i] = l[i] * (2.0 * l[i] - 1.0);
        s.n[3 + i] = 4.0 * l[i] * l[j];
        for (m, (di, dj)) in dl[i].iter().zip(&dl[j]).enumerate() {
            s.dn[i][m] = (4.0 * l[i] - 1.0) * di;
            s.dn[3 + i][m] = 4.0 * (di * l[j] + l[i] * dj);
        }
    }
    s
}
