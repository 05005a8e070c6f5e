//! Material and options of a block, as values, and the combinations that exist.

use crate::element::ElementKind;
use crate::error::FemError;
use crate::kinematics::{Dilatation, Formulation, Idealisation};
use crate::material::constitutive::ConstitutiveLaw;
use crate::material::elastic::Elastic;
use crate::material::j2::J2;
use crate::material::maxwell::Maxwell;

/// Materials a block can have.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Linear elasticity; hypoelastic under [`Kinematics::UpdatedLagrangian`].
    Elastic(Elastic),
    /// J2 plasticity.
    J2(J2),
    /// Linear viscoelasticity.
    Maxwell(Maxwell),
}

/// Evaluates an expression with the material as a concrete type: the choice is made once for a whole block.
macro_rules! with_material {
    ($material:expr, $m:ident => $body:expr) => {
        match $material {
            $crate::nonlinear::Material::Elastic($m) => $body,
            $crate::nonlinear::Material::J2($m) => $body,
            $crate::nonlinear::Material::Maxwell($m) => $body,
        }
    };
}
pub(super) use with_material;

impl Material {
    /// Number of tensors and of numbers in the history of a point, without stress.
    #[must_use]
    pub fn history(&self) -> (usize, usize) {
        with_material!(self, m => (m.tensors(), m.scalars()))
    }
}

/// Strains and configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinematics {
    /// Small strain on the reference geometry.
    Small,
    /// Current geometry at each evaluation. The Jaumann rate of the Kirchhoff stress τ = J σ (J from the start of the run) is
    /// the material's response to the rate of deformation.
    UpdatedLagrangian,
}

/// Bounds on the increments of a step under [`Kinematics::UpdatedLagrangian`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest strain increment √(Δε:Δε) of a forward step (r2) \[-\].
    pub strain: f64,
    /// Largest rotation of a forward step (r3) \[rad\].
    pub rotation: f64,
    /// Strain increment √(Δε:Δε) above which an implicit step is refused \[-\].
    pub refused: f64,
}

/// Largest strain increment of a forward step, from the model's source.
const STRAIN: f64 = 2.0e-3;
/// Largest rotation of a forward step in degrees, from the model's source.
const ROTATION_DEGREES: f64 = 0.5;
/// The error of the midpoint strain is Δε³/12: an implicit step beyond this limit is no longer small.
const REFUSED: f64 = 0.5;

impl Default for Limits {
    fn default() -> Self {
        Self { strain: STRAIN, rotation: ROTATION_DEGREES.to_radians(), refused: REFUSED }
    }
}

/// A block's material, kinematics and element formulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Material.
    pub material: Material,
    /// Plane strain, plane stress, axisymmetric, antiplane or three-dimensional.
    pub idealisation: Idealisation,
    /// Small strain or updated Lagrangian.
    pub kinematics: Kinematics,
    /// Standard, or with averaged dilatation.
    pub formulation: Formulation,
    /// Limits of forward steps.
    pub limits: Limits,
}

/// Reasons why a block cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// Error of the mesh, element or material.
    #[error(transparent)]
    Fem(#[from] FemError),
    /// A combination that does not exist.
    #[error("{combination}: {reason}")]
    Combination {
        /// Requested combination.
        combination: &'static str,
        /// Reason, and existing alternatives.
        reason: &'static str,
    },
}

impl Model {
    /// True if the consistent tangent of an implicit step is symmetric. At small strain it is `∫ B'CB` with the algorithmic
    /// moduli C, which have major symmetry for all materials here. The objective update of large deformation is not the
    /// derivative of an energy of the step.
    #[must_use]
    pub fn symmetric_tangent(&self) -> bool {
        self.kinematics == Kinematics::Small
    }

    /// True if the rate tangent of a forward step is symmetric: Σ of the Jaumann rate of the Kirchhoff stress has major
    /// symmetry if the continuum moduli have it.
    #[must_use]
    pub fn symmetric_rate(&self) -> bool {
        true
    }

    /// Number of polynomials on which the dilatation of each cell is projected: 0 for the standard formulation, otherwise 1, or
    /// 1 and the positions. If the linear block averages only the mean pressure, the strain increment is averaged here, since a
    /// plastic deviator has no pressure of its own. The motions of a single cell that this leaves without energy (conformal
    /// ones, on cells of second order) are held by its neighbours.
    pub(super) fn modes(&self, kind: ElementKind) -> Result<usize, ModelError> {
        Ok(match self.formulation.dilatation(kind, self.idealisation)? {
            None => 0,
            Some(Dilatation::Constant | Dilatation::ConstantPressure) => 1,
            Some(Dilatation::Linear) => 1 + kind.dimension(),
        })
    }

    pub(super) fn check(&self, dimension: usize) -> Result<(), ModelError> {
        self.idealisation.check_dimension(dimension)?;
        if self.idealisation == Idealisation::Antiplane && self.kinematics == Kinematics::UpdatedLagrangian {
            return Err(ModelError::Combination {
                combination: "antiplane shear, updated Lagrangian",
                reason: "use small strain, or three dimensions",
            });
        }
        Ok(())
    }
}
