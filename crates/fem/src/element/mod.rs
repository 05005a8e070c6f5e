//! Elements: shape functions, faces and quadrature. Local node orders are those of VTK. The base of wedges is counter-clockwise
//! seen from the opposite end, as in VTK's shape functions, Gmsh and Abaqus.

mod definition;
pub mod face;
mod hex20;
mod hex27;
mod hex8;
mod kind;
mod quad4;
mod quad8;
mod quad9;
mod shape;
mod tet10;
mod tet4;
mod tri3;
mod tri6;
mod wedge15;
mod wedge6;

pub use definition::{Definition, Face, ForeignElement};
pub use face::FaceKind;
pub use kind::ElementKind;
pub use shape::{MOST_NODES, Shape};

use crate::error::FemError;
use crate::quadrature::{self, Point};
use std::str::FromStr;

impl ElementKind {
    /// The definition of the element.
    #[must_use]
    pub fn definition(self) -> &'static Definition {
        match self {
            Self::Tri3 => &tri3::DEFINITION,
            Self::Tri6 => &tri6::DEFINITION,
            Self::Quad4 => &quad4::DEFINITION,
            Self::Quad8 => &quad8::DEFINITION,
            Self::Quad9 => &quad9::DEFINITION,
            Self::Tet4 => &tet4::DEFINITION,
            Self::Tet10 => &tet10::DEFINITION,
            Self::Hex8 => &hex8::DEFINITION,
            Self::Hex20 => &hex20::DEFINITION,
            Self::Hex27 => &hex27::DEFINITION,
            Self::Wedge6 => &wedge6::DEFINITION,
            Self::Wedge15 => &wedge15::DEFINITION,
        }
    }

    /// Name in scenes.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.definition().name
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        self.definition().nodes.len()
    }

    /// Number of corners: the first of the nodes.
    #[must_use]
    pub fn corners(self) -> usize {
        self.definition().corners
    }

    /// Dimension of the element.
    #[must_use]
    pub fn dimension(self) -> usize {
        self.definition().dimension
    }

    /// Degree of the complete polynomials contained in the shape functions: 1 or 2.
    #[must_use]
    pub fn order(self) -> usize {
        self.definition().order
    }

    /// The element of first order on the same corners.
    #[must_use]
    pub fn linear(self) -> Self {
        self.definition().linear
    }

    /// Cell type number of VTK.
    #[must_use]
    pub fn vtk_type(self) -> u8 {
        self.definition().vtk
    }

    /// Shape functions at natural coordinates `xi`.
    #[must_use]
    pub fn shape(self, xi: [f64; 3]) -> Shape {
        (self.definition().shape)(xi)
    }

    /// Faces: local nodes, ordered so that the body lies to the left of an edge and a face runs counter-clockwise seen from
    /// outside. Corners come first, then the mid-nodes of the edges between them in the same order, then the centre.
    #[must_use]
    pub fn faces(self) -> &'static [Face] {
        self.definition().faces
    }

    /// Quadrature that integrates the stiffness of the undistorted element exactly. Degree of the rule (and degree needed):
    /// tri3, tet4 1 (0); tri6, tet10 2 (2); quad4, hex8 3 in each variable (2); quad8, quad9, hex20, hex27 5 in each variable
    /// (4); wedge6 2 in the triangle and 3 along it (2 and 2); wedge15 4 and 5 (4 and 4).
    #[must_use]
    pub fn quadrature(self) -> Vec<Point> {
        (self.definition().quadrature)()
    }

    /// Quadrature that integrates products N_a N_b over the undistorted element exactly: for mass matrices, body forces, and
    /// everything that contains a factor of the position. The degree of the rule is at least twice the order of the element.
    #[must_use]
    pub fn mass_quadrature(self) -> Vec<Point> {
        (self.definition().mass_quadrature)()
    }

    /// Quadrature for measuring errors: degree 7 in each variable; on simplices, a collapsed cube.
    #[must_use]
    pub fn fine_quadrature(self) -> Vec<Point> {
        match self.linear() {
            Self::Tri3 => quadrature::collapsed_triangle(4),
            Self::Tet4 => quadrature::collapsed_tetrahedron(4),
            Self::Wedge6 => quadrature::wedge(quadrature::collapsed_triangle(4), 4),
            _ => quadrature::gauss(4, self.dimension()),
        }
    }

    /// Natural coordinates of the nodes.
    #[must_use]
    pub fn node_coordinates(self) -> &'static [[f64; 3]] {
        self.definition().nodes
    }
}

impl FromStr for ElementKind {
    type Err = FemError;

    fn from_str(name: &str) -> Result<Self, FemError> {
        Self::ALL
            .into_iter()
            .find(|k| k.name() == name)
            .ok_or_else(|| FemError::UnknownElement(name.to_string()))
    }
}
