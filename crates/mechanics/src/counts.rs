//! Counts of the operations of steppers.

use serde::{Deserialize, Serialize};

/// Counts of operations.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Newton iterations, or forward solves.
    pub iterations: usize,
    /// Augmentations of multipliers (Uzawa's method).
    pub augmentations: usize,
    /// Residual evaluations.
    pub residuals: usize,
    /// Tangent evaluations.
    pub tangents: usize,
    /// Factorisations of the step's system.
    pub factorisations: usize,
    /// Number of these that were LU because a symmetric system was not positive definite.
    pub indefinite: usize,
    /// Solves with factorisations of the step's system.
    pub solves: usize,
    /// Iterations of conjugate gradients, if the method is iterative.
    pub linear_iterations: usize,
    /// Factorisations of bodies (condensation).
    pub body_factorisations: usize,
    /// Right-hand sides solved with body factorisations.
    pub body_solves: usize,
    /// Searches of contact pairs.
    pub searches: usize,
    /// Searches skipped because a bound on the motion proved that no pairing had changed.
    pub searches_skipped: usize,
    /// Projections onto single segments in searches.
    pub projections: usize,
}
