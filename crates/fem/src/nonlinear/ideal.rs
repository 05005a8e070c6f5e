//! Idealisations and element formulations.

/// How a body in space is reduced to its mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Idealisation {
    /// ε_zz = ε_xz = ε_yz = 0; per metre of thickness.
    PlaneStrain,
    /// σ_zz = σ_xz = σ_yz = 0; per metre of thickness.
    PlaneStress,
    /// x is the radius, y the axis, zz the hoop direction; over the full turn.
    Axisymmetric,
    /// u_z(x, y) alone.
    Antiplane,
    /// No reduction.
    ThreeD,
}

impl Idealisation {
    /// Degrees of freedom of a node.
    #[must_use]
    pub fn components(self) -> usize {
        match self {
            Self::Antiplane => 1,
            Self::ThreeD => 3,
            _ => 2,
        }
    }

    /// Dimension of the mesh.
    #[must_use]
    pub fn dimension(self) -> usize {
        if self == Self::ThreeD { 3 } else { 2 }
    }
}

/// How the dilatation of a cell is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulation {
    /// At each quadrature point.
    Standard,
    /// Projected on low polynomials of each cell, so that incompressible flow does not lock.
    BBar,
}
