//! Elements: shape functions, faces and quadrature. Local node orders are those of VTK; wedges have their base counter-clockwise
//! seen from the opposite end, as VTK's shape functions, Gmsh and Abaqus have it.

mod hex20;
mod hex27;
mod hex8;
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

pub use shape::{MOST_NODES, Shape};

use crate::error::FemError;
use crate::quadrature;
use std::str::FromStr;

/// Kinds of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ElementKind {
    /// Linear triangle.
    Tri3,
    /// Quadratic triangle.
    Tri6,
    /// Bilinear quadrilateral.
    Quad4,
    /// Serendipity quadrilateral.
    Quad8,
    /// Biquadratic quadrilateral.
    Quad9,
    /// Linear tetrahedron.
    Tet4,
    /// Quadratic tetrahedron.
    Tet10,
    /// Trilinear hexahedron.
    Hex8,
    /// Serendipity hexahedron.
    Hex20,
    /// Triquadratic hexahedron.
    Hex27,
    /// Linear wedge (prism).
    Wedge6,
    /// Serendipity wedge (prism).
    Wedge15,
}

/// A quadrature point: natural coordinates and weight.
pub type Point = ([f64; 3], f64);

impl ElementKind {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Tri3,
        Self::Tri6,
        Self::Quad4,
        Self::Quad8,
        Self::Quad9,
        Self::Tet4,
        Self::Tet10,
        Self::Hex8,
        Self::Hex20,
        Self::Hex27,
        Self::Wedge6,
        Self::Wedge15,
    ];

    /// Name as a scene spells it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tri3 => "tri3",
            Self::Tri6 => "tri6",
            Self::Quad4 => "quad4",
            Self::Quad8 => "quad8",
            Self::Quad9 => "quad9",
            Self::Tet4 => "tet4",
            Self::Tet10 => "tet10",
            Self::Hex8 => "hex8",
            Self::Hex20 => "hex20",
            Self::Hex27 => "hex27",
            Self::Wedge6 => "wedge6",
            Self::Wedge15 => "wedge15",
        }
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        match self {
            Self::Tri3 => 3,
            Self::Tri6 | Self::Wedge6 => 6,
            Self::Quad4 | Self::Tet4 => 4,
            Self::Quad8 | Self::Hex8 => 8,
            Self::Quad9 => 9,
            Self::Tet10 => 10,
            Self::Hex20 => 20,
            Self::Hex27 => 27,
            Self::Wedge15 => 15,
        }
    }

    /// Number of corners: the first of the nodes.
    #[must_use]
    pub fn corners(self) -> usize {
        match self {
            Self::Tri3 | Self::Tri6 => 3,
            Self::Quad4 | Self::Quad8 | Self::Quad9 | Self::Tet4 | Self::Tet10 => 4,
            Self::Hex8 | Self::Hex20 | Self::Hex27 => 8,
            Self::Wedge6 | Self::Wedge15 => 6,
        }
    }

    /// Dimension of the element.
    #[must_use]
    pub fn dimension(self) -> usize {
        match self {
            Self::Tri3 | Self::Tri6 | Self::Quad4 | Self::Quad8 | Self::Quad9 => 2,
            Self::Tet4
            | Self::Tet10
            | Self::Hex8
            | Self::Hex20
            | Self::Hex27
            | Self::Wedge6
            | Self::Wedge15 => 3,
        }
    }

    /// Degree of the complete polynomials the shape functions hold: 1 or 2.
    #[must_use]
    pub fn order(self) -> usize {
        match self {
            Self::Tri3 | Self::Quad4 | Self::Tet4 | Self::Hex8 | Self::Wedge6 => 1,
            Self::Tri6
            | Self::Quad8
            | Self::Quad9
            | Self::Tet10
            | Self::Hex20
            | Self::Hex27
            | Self::Wedge15 => 2,
        }
    }

    /// The element of first order on the same corners.
    #[must_use]
    pub fn linear(self) -> Self {
        match self {
            Self::Tri3 | Self::Tri6 => Self::Tri3,
            Self::Quad4 | Self::Quad8 | Self::Quad9 => Self::Quad4,
            Self::Tet4 | Self::Tet10 => Self::Tet4,
            Self::Hex8 | Self::Hex20 | Self::Hex27 => Self::Hex8,
            Self::Wedge6 | Self::Wedge15 => Self::Wedge6,
        }
    }

    /// Cell type number of VTK.
    #[must_use]
    pub fn vtk_type(self) -> u8 {
        match self {
            Self::Tri3 => 5,
            Self::Tri6 => 22,
            Self::Quad4 => 9,
            Self::Quad8 => 23,
            Self::Quad9 => 28,
            Self::Tet4 => 10,
            Self::Tet10 => 24,
            Self::Hex8 => 12,
            Self::Hex20 => 25,
            Self::Hex27 => 29,
            Self::Wedge6 => 13,
            Self::Wedge15 => 26,
        }
    }

    /// Shape functions at natural coordinates `xi`.
    #[must_use]
    pub fn shape(self, xi: [f64; 3]) -> Shape {
        match self {
            Self::Tri3 => tri3::shape(xi),
            Self::Tri6 => tri6::shape(xi),
            Self::Quad4 => quad4::shape(xi),
            Self::Quad8 => quad8::shape(xi),
            Self::Quad9 => quad9::shape(xi),
            Self::Tet4 => tet4::shape(xi),
            Self::Tet10 => tet10::shape(xi),
            Self::Hex8 => hex8::shape(xi),
            Self::Hex20 => hex20::shape(xi),
            Self::Hex27 => hex27::shape(xi),
            Self::Wedge6 => wedge6::shape(xi),
            Self::Wedge15 => wedge15::shape(xi),
        }
    }

    /// Faces: local nodes, ordered so that the body lies to the left of an edge and a face runs counter-clockwise seen
    /// from outside. Corners first, then the mid-nodes of the edges between them in the same order, then the centre.
    #[must_use]
    pub fn faces(self) -> &'static [&'static [usize]] {
        match self {
            Self::Tri3 => tri3::FACES,
            Self::Tri6 => tri6::FACES,
            Self::Quad4 => quad4::FACES,
            Self::Quad8 => quad8::FACES,
            Self::Quad9 => quad9::FACES,
            Self::Tet4 => tet4::FACES,
            Self::Tet10 => tet10::FACES,
            Self::Hex8 => hex8::FACES,
            Self::Hex20 => hex20::FACES,
            Self::Hex27 => hex27::FACES,
            Self::Wedge6 => wedge6::FACES,
            Self::Wedge15 => wedge15::FACES,
        }
    }

    /// Quadrature that integrates the stiffness of the undistorted element exactly. Degree of the rule: tri3, tet4 0 needed,
    /// 1 taken; tri6, tet10 2; quad4, hex8 3 in each variable (2 needed); quad8, quad9, hex20, hex27 5 in each variable (4
    /// needed); wedge6 2 in the triangle and 3 along it (2 and 2 needed); wedge15 4 and 5 (4 and 4 needed).
    #[must_use]
    pub fn quadrature(self) -> Vec<Point> {
        match self {
            Self::Tri3 => quadrature::triangle_1(),
            Self::Tri6 => quadrature::triangle_3(),
            Self::Quad4 => quadrature::gauss(2, 2),
            Self::Quad8 | Self::Quad9 => quadrature::gauss(3, 2),
            Self::Tet4 => quadrature::tetrahedron_1(),
            Self::Tet10 => quadrature::tetrahedron_4(),
            Self::Hex8 => quadrature::gauss(2, 3),
            Self::Hex20 | Self::Hex27 => quadrature::gauss(3, 3),
            Self::Wedge6 => quadrature::wedge(quadrature::triangle_3(), 2),
            Self::Wedge15 => quadrature::wedge(quadrature::triangle_6(), 3),
        }
    }

    /// Quadrature that integrates products N_a N_b over the undistorted element exactly: for mass matrices, body forces, and
    /// whatever carries a factor of the position. Degree of the rule: twice the order of the element or more.
    #[must_use]
    pub fn mass_quadrature(self) -> Vec<Point> {
        match self {
            Self::Tri3 => quadrature::triangle_3(),
            Self::Tri6 => quadrature::triangle_6(),
            Self::Quad4 => quadrature::gauss(2, 2),
            Self::Quad8 | Self::Quad9 => quadrature::gauss(3, 2),
            Self::Tet4 => quadrature::tetrahedron_4(),
            Self::Tet10 => quadrature::tetrahedron_14(),
            Self::Hex8 => quadrature::gauss(2, 3),
            Self::Hex20 | Self::Hex27 => quadrature::gauss(3, 3),
            Self::Wedge6 => quadrature::wedge(quadrature::triangle_3(), 2),
            Self::Wedge15 => quadrature::wedge(quadrature::triangle_6(), 3),
        }
    }

    /// Quadrature to measure errors with: degree 7 in each variable, on simplices a collapsed cube.
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
        match self {
            Self::Tri3 => tri3::NODES,
            Self::Tri6 => tri6::NODES,
            Self::Quad4 => quad4::NODES,
            Self::Quad8 => quad8::NODES,
            Self::Quad9 => quad9::NODES,
            Self::Tet4 => tet4::NODES,
            Self::Tet10 => tet10::NODES,
            Self::Hex8 => hex8::NODES,
            Self::Hex20 => hex20::NODES,
            Self::Hex27 => hex27::NODES,
            Self::Wedge6 => wedge6::NODES,
            Self::Wedge15 => wedge15::NODES,
        }
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
