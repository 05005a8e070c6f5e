//! Elements: shape functions, faces and quadrature. Local node orders are those of VTK.

mod hex8;
mod quad4;
mod quad9;
mod tet4;
mod tri3;
mod tri6;

use crate::error::FemError;
use crate::quadrature;
use std::str::FromStr;

/// Most nodes an element has.
pub const MOST_NODES: usize = 9;

/// Shape functions and their natural derivatives at one point.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// N_a \[-\].
    pub n: [f64; MOST_NODES],
    /// ∂N_a/∂ξ_m \[-\].
    pub dn: [[f64; 3]; MOST_NODES],
}

impl Default for Shape {
    fn default() -> Self {
        Self { n: [0.0; MOST_NODES], dn: [[0.0; 3]; MOST_NODES] }
    }
}

/// Kinds of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ElementKind {
    /// Linear triangle.
    Tri3,
    /// Quadratic triangle.
    Tri6,
    /// Bilinear quadrilateral.
    Quad4,
    /// Biquadratic quadrilateral.
    Quad9,
    /// Linear tetrahedron.
    Tet4,
    /// Trilinear hexahedron.
    Hex8,
}

/// A quadrature point: natural coordinates and weight.
pub type Point = ([f64; 3], f64);

impl ElementKind {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Tri3, Self::Tri6, Self::Quad4, Self::Quad9, Self::Tet4, Self::Hex8];

    /// Name as a scene spells it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tri3 => "tri3",
            Self::Tri6 => "tri6",
            Self::Quad4 => "quad4",
            Self::Quad9 => "quad9",
            Self::Tet4 => "tet4",
            Self::Hex8 => "hex8",
        }
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        match self {
            Self::Tri3 => 3,
            Self::Tri6 => 6,
            Self::Quad4 | Self::Tet4 => 4,
            Self::Quad9 => 9,
            Self::Hex8 => 8,
        }
    }

    /// Dimension of the element.
    #[must_use]
    pub fn dimension(self) -> usize {
        match self {
            Self::Tri3 | Self::Tri6 | Self::Quad4 | Self::Quad9 => 2,
            Self::Tet4 | Self::Hex8 => 3,
        }
    }

    /// Cell type number of VTK.
    #[must_use]
    pub fn vtk_type(self) -> u8 {
        match self {
            Self::Tri3 => 5,
            Self::Tri6 => 22,
            Self::Quad4 => 9,
            Self::Quad9 => 28,
            Self::Tet4 => 10,
            Self::Hex8 => 12,
        }
    }

    /// Shape functions at natural coordinates `xi`.
    #[must_use]
    pub fn shape(self, xi: [f64; 3]) -> Shape {
        match self {
            Self::Tri3 => tri3::shape(xi),
            Self::Tri6 => tri6::shape(xi),
            Self::Quad4 => quad4::shape(xi),
            Self::Quad9 => quad9::shape(xi),
            Self::Tet4 => tet4::shape(xi),
            Self::Hex8 => hex8::shape(xi),
        }
    }

    /// Faces: local nodes, ordered so that the body lies to the left of an edge and a face runs counter-clockwise seen
    /// from outside; corners first.
    #[must_use]
    pub fn faces(self) -> &'static [&'static [usize]] {
        match self {
            Self::Tri3 => tri3::FACES,
            Self::Tri6 => tri6::FACES,
            Self::Quad4 => quad4::FACES,
            Self::Quad9 => quad9::FACES,
            Self::Tet4 => tet4::FACES,
            Self::Hex8 => hex8::FACES,
        }
    }

    /// Quadrature that integrates the stiffness of the undistorted element exactly.
    #[must_use]
    pub fn quadrature(self) -> Vec<Point> {
        match self {
            Self::Tri3 => quadrature::triangle_1(),
            Self::Tri6 => quadrature::triangle_3(),
            Self::Quad4 => quadrature::gauss(2, 2),
            Self::Quad9 => quadrature::gauss(3, 2),
            Self::Tet4 => quadrature::tetrahedron_1(),
            Self::Hex8 => quadrature::gauss(2, 3),
        }
    }

    /// Natural coordinates of the nodes.
    #[must_use]
    pub fn node_coordinates(self) -> &'static [[f64; 3]] {
        match self {
            Self::Tri3 => tri3::NODES,
            Self::Tri6 => tri6::NODES,
            Self::Quad4 => quad4::NODES,
            Self::Quad9 => quad9::NODES,
            Self::Tet4 => tet4::NODES,
            Self::Hex8 => hex8::NODES,
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
