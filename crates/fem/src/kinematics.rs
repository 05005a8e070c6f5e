//! Assumptions on a displacement field: the idealisation of space, and the treatment of the dilatation.

use crate::element::ElementKind;
use crate::error::FemError;
use crate::quadrature::Point;
use std::f64::consts::TAU;

/// Idealisation of space. Degree of freedom = node * [`Idealisation::components`] + component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Idealisation {
    /// u_x(x, y), u_y(x, y), no strain along z; per metre of thickness.
    PlaneStrain,
    /// u_x(x, y), u_y(x, y), no stress along z; a sheet of thickness 1 m.
    PlaneStress,
    /// u_r(r, z), u_z(r, z) with x = r ≥ 0 and y = z, the axis of revolution; the hoop strain u_r/r is the component zz.
    /// Integrals extend over the full circle: weights 2πr.
    Axisymmetric,
    /// u_z(x, y) only; stresses yz and zx; per metre of thickness.
    Antiplane,
    /// u_x, u_y, u_z.
    ThreeD,
}

impl Idealisation {
    /// All idealisations.
    pub const ALL: [Self; 5] =
        [Self::PlaneStrain, Self::PlaneStress, Self::Axisymmetric, Self::Antiplane, Self::ThreeD];

    /// Plane strain or three dimensions: the default for a mesh of this dimension.
    #[must_use]
    pub fn from_dimension(dimension: usize) -> Self {
        if dimension == 2 { Self::PlaneStrain } else { Self::ThreeD }
    }

    /// Name in scenes.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PlaneStrain => "plane-strain",
            Self::PlaneStress => "plane-stress",
            Self::Axisymmetric => "axisymmetric",
            Self::Antiplane => "antiplane",
            Self::ThreeD => "3d",
        }
    }

    /// Degrees of freedom of a node.
    #[must_use]
    pub fn components(self) -> usize {
        match self {
            Self::PlaneStrain | Self::PlaneStress | Self::Axisymmetric => 2,
            Self::Antiplane => 1,
            Self::ThreeD => 3,
        }
    }

    /// Dimension of the mesh.
    #[must_use]
    pub fn dimension(self) -> usize {
        if self == Self::ThreeD { 3 } else { 2 }
    }

    /// Axis of space (0, 1, 2) of a component of the displacement.
    #[must_use]
    pub fn axis(self, component: usize) -> usize {
        if self == Self::Antiplane { 2 } else { component }
    }

    /// Component of the displacement along an axis of space, if there is one.
    #[must_use]
    pub fn component(self, axis: usize) -> Option<usize> {
        (0..self.components()).find(|&component| self.axis(component) == axis)
    }

    /// Number of motions without strain of an unconstrained connected body.
    #[must_use]
    pub fn rigid_motions(self) -> usize {
        match self {
            Self::PlaneStrain | Self::PlaneStress => 3,
            Self::Axisymmetric | Self::Antiplane => 1,
            Self::ThreeD => 6,
        }
    }

    /// Factor of volumes and areas at a position: 2πr \[m\] about an axis, otherwise 1 \[-\].
    #[must_use]
    pub fn weight<const D: usize>(self, x: &[f64; D]) -> f64 {
        if self == Self::Axisymmetric { TAU * x[0] } else { 1.0 }
    }

    /// Quadrature of stiffness and stress. About an axis, the factor r raises the degree needed on triangles: one point would
    /// leave tri3 with motions of zero energy.
    #[must_use]
    pub fn quadrature(self, kind: ElementKind) -> Vec<Point> {
        if self == Self::Axisymmetric { kind.mass_quadrature() } else { kind.quadrature() }
    }

    /// Checks that a mesh of dimension `dimension` can be used with this idealisation.
    ///
    /// # Errors
    /// [`FemError::Idealisation`] if it cannot.
    pub fn check_dimension(self, dimension: usize) -> Result<(), FemError> {
        if self.dimension() == dimension {
            return Ok(());
        }
        Err(FemError::Idealisation {
            idealisation: self.name(),
            reason: "it does not fit the dimension of the mesh",
        })
    }

    /// Checks that a vector has one entry per component.
    ///
    /// # Errors
    /// [`FemError::Components`] if it has not.
    pub fn check_components(self, given: usize) -> Result<(), FemError> {
        if self.components() == given {
            return Ok(());
        }
        Err(FemError::Components { idealisation: self.name(), expected: self.components(), given })
    }
}

/// Treatment of the dilatation θ = tr ε.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Formulation {
    /// As given by the shape functions. It locks as ν approaches 0.5.
    #[default]
    Standard,
    /// B-bar: θ replaced by its projection θ̄, cell by cell, on the polynomials of [`Dilatation`].
    BBar,
}

/// Effect of B-bar on the dilatation of an element.
///
/// The pair of displacement and dilatation has to satisfy the inf-sup condition as the body becomes incompressible, with a
/// constant β that does not decrease with refinement. Values were measured on irregular meshes with all boundaries held:
/// - quad9 and hex27 satisfy it with linear polynomials (β = 0.6 and 0.5), the optimal pair: no order is lost. The polynomials
///   are those of the positions; those of the natural coordinates would lose an order on general quadrilaterals (Boffi,
///   Gastaldi 2002).
/// - quad8 is unstable with linear polynomials (β = 0.07 to 0.13) and stable with constants (0.65), as is tri6 (0.63). This
///   costs an order: 2 in displacement and 1 in strain. hex20, tet10 and wedge15 also use constants, since linear polynomials
///   give β = 0.01 and less. Without a node inside their faces they reach β = 0.05 to 0.09 only, so that stresses are less
///   smooth than with hex27.
/// - quad4 and hex8 are unstable with constants (β = 0.03 and less, decreasing with h): a mean stress that alternates from cell
///   to cell meets almost no resistance. On uniform meshes and on those that follow a smooth map nothing excites it, whether the
///   boundary is held wholly or in part: order and level remain those at ν = 0.3. It is excited where the shape of the cells
///   itself alternates. Displacements then lose their order, though less than without B-bar; quad9 and hex27 do not.
/// - wedge6 is refused. Two wedges share the freedom of one hexahedron, so that one dilatation each is too many to follow, and
///   the alternating ones are unstable as well. With ν = 0.4999 and the boundary held, the measured error was ten times that of
///   the standard formulation; with a free part of the boundary, both lock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Dilatation {
    /// Assumed strain (Hughes 1980): ε̄ = ε + (θ̄ - θ) I/3 with θ̄ the mean over the cell; σ = C ε̄.
    Constant,
    /// As [`Dilatation::Constant`] with θ̄ the projection on linear polynomials of the position.
    Linear,
    /// Mean pressure: σ = 2G ε + λ θ̄ I with θ̄ the mean over the cell. It is for elements of second order, for which the
    /// assumed strain of a single element would leave some fields without energy. These are fields without deviator whose
    /// dilatation has zero mean over a cell (u = 2 (b·x) x - |x|² b in space; u_r = r z, u_z = (z² - r²)/2 about an axis).
    ConstantPressure,
}

impl Formulation {
    /// All formulations.
    pub const ALL: [Self; 2] = [Self::Standard, Self::BBar];

    /// Name in scenes.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::BBar => "b-bar",
        }
    }

    /// The projection of the dilatation, or `None` if there is none.
    ///
    /// # Errors
    /// [`FemError::Formulation`] if B-bar would have no effect, with the formulation to use instead.
    pub fn dilatation(
        self,
        kind: ElementKind,
        idealisation: Idealisation,
    ) -> Result<Option<Dilatation>, FemError> {
        let refuse = |reason| Err(FemError::Formulation { element: kind.name(), reason });
        match (self, idealisation, kind) {
            (Self::Standard, ..) => Ok(None),
            (_, Idealisation::PlaneStress, _) => refuse(
                "in plane stress the thickness follows, so nothing locks: take the standard formulation",
            ),
            (_, Idealisation::Antiplane, _) => {
                refuse("antiplane motion has no dilatation: take the standard formulation")
            }
            (_, _, ElementKind::Tri3) => refuse(
                "its dilatation is constant already, so that projecting changes nothing: take tri6, quad4 or quad9",
            ),
            (_, _, ElementKind::Tet4) => refuse(
                "its dilatation is constant already, so that projecting changes nothing: take tet10, hex8 or hex27",
            ),
            (_, _, ElementKind::Wedge6) => refuse(
                "two wedges in the place of one hexahedron have too many dilatations for their nodes, so that it locks all \
                 the same: take wedge15 or hex8",
            ),
            (_, _, ElementKind::Quad9 | ElementKind::Hex27) => Ok(Some(Dilatation::Linear)),
            _ if kind.order() == 2 => Ok(Some(Dilatation::ConstantPressure)),
            _ => Ok(Some(Dilatation::Constant)),
        }
    }
}
