//! Serendipity wedge (prism): corners as [`super::wedge6`], then mid-nodes of edges 01, 12, 20, 34, 45, 53, 03, 14, 25. With
//! area coordinates λ and the end ζ_a = ±1, corners have ½ λ [(2λ-1)(1+ζ_a ζ) - (1-ζ²)], mid-nodes of triangles
//! 2 λ_i λ_j (1+ζ_a ζ), mid-nodes between them λ_i (1-ζ²).
//!
//! Like [`super::quad8`], it contains all quadratic polynomials of the positions only if it is an affine image of the
//! reference.

use super::definition::{Definition, Face, ForeignElement};
use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "wedge15",
    dimension: 3,
    order: 2,
    linear: ElementKind::Wedge6,
    corners: 6,
    nodes: NODES,
    faces: FACES,
    reversed: &[],
    shape,
    quadrature: || quadrature::wedge(quadrature::triangle_6(), 3),
    mass_quadrature: || quadrature::wedge(quadrature::triangle_6(), 3),
    vtk: 26,
    gmsh: ForeignElement { names: 18, order: &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11] },
    abaqus: ForeignElement { names: (Some("15"), &[]), order: &[] },
    abaqus_faces: &[&[0, 1, 2], &[3, 5, 4], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]],
};

pub(super) const NODES: &[[f64; 3]] = &[
    [0.0, 0.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.5, 0.0, -1.0],
    [0.5, 0.5, -1.0],
    [0.0, 0.5, -1.0],
    [0.5, 0.0, 1.0],
    [0.5, 0.5, 1.0],
    [0.0, 0.5, 1.0],
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
];

const FACES: &[Face] = &[
    Face { kind: FaceKind::Tri6, nodes: &[0, 2, 1, 8, 7, 6] },
    Face { kind: FaceKind::Tri6, nodes: &[3, 4, 5, 9, 10, 11] },
    Face { kind: FaceKind::Quad8, nodes: &[0, 1, 4, 3, 6, 13, 9, 12] },
    Face { kind: FaceKind::Quad8, nodes: &[1, 2, 5, 4, 7, 14, 10, 13] },
    Face { kind: FaceKind::Quad8, nodes: &[2, 0, 3, 5, 8, 12, 11, 14] },
];

fn shape([x, y, z]: [f64; 3]) -> Shape {
    let l = [1.0 - x - y, x, y];
    let dl = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let bubble = 1.0 - z * z;
    let mut s = Shape::default();
    for (layer, end) in [-1.0, 1.0].into_iter().enumerate() {
        let f = 1.0 + end * z;
        for i in 0..3 {
            let j = (i + 1) % 3;
            let (corner, middle) = (3 * layer + i, 6 + 3 * layer + i);
            s.n[corner] = 0.5 * l[i] * ((2.0 * l[i] - 1.0) * f - bubble);
            s.n[middle] = 2.0 * l[i] * l[j] * f;
            for (m, (own, next)) in dl[i].into_iter().zip(dl[j]).enumerate() {
                s.dn[corner][m] = 0.5 * own * ((4.0 * l[i] - 1.0) * f - bubble);
                s.dn[middle][m] = 2.0 * (own * l[j] + l[i] * next) * f;
            }
            s.dn[corner][2] = 0.5 * l[i] * ((2.0 * l[i] - 1.0) * end + 2.0 * z);
            s.dn[middle][2] = 2.0 * l[i] * l[j] * end;
        }
    }
    for i in 0..3 {
        s.n[12 + i] = l[i] * bubble;
        s.dn[12 + i] = [dl[i][0] * bubble, dl[i][1] * bubble, -2.0 * l[i] * z];
    }
    s
}
