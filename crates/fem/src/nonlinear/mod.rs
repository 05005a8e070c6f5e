//! Blocks of cells whose stress is not linear in the displacements: plastic or viscoelastic materials, large deformation.
//!
//! A [`Block`] is a [`crate::term::Term`] with a consistent tangent, the rate tangent and limits of forward steps, and a
//! history that can be saved. At small strain the geometry is that of the reference. Under [`Kinematics::UpdatedLagrangian`]
//! the current configuration is used at each evaluation, and the Jaumann rate of the Kirchhoff stress τ = J σ is integrated
//! objectively (`motion`). Two known consequences are asserted. In simple shear the hypoelastic shear stress is G sin γ. Under
//! a pure change of volume τ = K ln J 1, so that σ = K ln J/J 1, where the Jaumann rate of the Cauchy stress would give σ = K
//! ln J 1.

mod block;
mod body;
mod cell;
mod energy;
mod forward;
mod history;
mod model;
mod motion;
mod output;
mod tensor;
mod viscous;

pub use block::Block;
pub use model::{Kinematics, Limits, Material, Model, ModelError};
