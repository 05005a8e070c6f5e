//! Serendipity quadrilateral on [-1, 1]²: corners, mid-nodes of edges 01, 12, 23, 30. With s = x x_a, t = y y_a corners have
//! ¼ (1+s)(1+t)(s+t-1), mid-nodes ½ (1-x²)(1+t) or ½ (1-y²)(1+s).
//!
//! The space contains all quadratic polynomials of the natural coordinates, but those of the positions only if the element is a
//! parallelogram (Arnold, Boffi, Falk 2002). On general quadrilaterals the order falls to that of quad4.

use super::definition::{Definition, Face, ForeignElement};
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature;

pub(super) const DEFINITION: Definition = Definition {
    name: "quad8",
    dimension: 2,
    order: 2,
    linear: ElementKind::Quad4,
    corners: 4,
    nodes: NODES,
    faces: FACES,
    reversed: &[0, 3, 2, 1, 7, 6, 5, 4],
    shape,
    quadrature: || quadrature::gauss(3, 2),
    mass_quadrature: || quadrature::gauss(3, 2),
    vtk: 23,
    gmsh: ForeignElement { names: 16, order: &[] },
    abaqus: ForeignElement {
        names: (Some("8"), &["S8R", "S8R5", "SFM3D8", "SFM3D8R", "M3D8", "M3D8R"]),
        order: &[],
    },
    abaqus_faces: super::quad4::DEFINITION.abaqus_faces,
};

const NODES: &[[f64; 3]] = super::quad9::NODES.split_at(8).0;

const FACES: &[Face] = super::quad9::FACES;

fn shape([x, y, _]: [f64; 3]) -> Shape {
    let mut s = Shape::default();
    for (a, &[xa, ya, _]) in NODES.iter().enumerate() {
        let (fx, fy) = (1.0 + xa * x, 1.0 + ya * y);
        (s.n[a], s.dn[a]) = if xa == 0.0 {
            (0.5 * (1.0 - x * x) * fy, [-x * fy, 0.5 * ya * (1.0 - x * x), 0.0])
        } else if ya == 0.0 {
            (0.5 * (1.0 - y * y) * fx, [0.5 * xa * (1.0 - y * y), -y * fx, 0.0])
        } else {
            let bracket = xa * x + ya * y - 1.0;
            (
                0.25 * fx * fy * bracket,
                [0.25 * xa * fy * (bracket + fx), 0.25 * ya * fx * (bracket + fy), 0.0],
            )
        };
    }
    s
}
