//! Knowledge of the tangents before they are assembled.

use serde::{Deserialize, Serialize};

/// Knowledge of the tangents of all terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Nothing: LU.
    General,
    /// Symmetric: Cholesky with half the entries; LU where their sum turns out not to be positive definite.
    Symmetric,
    /// Symmetric, and their sum positive definite on the free degrees of freedom: Cholesky, or an error.
    Positive,
}

/// Equations of a dense system left over by an elimination, and of which terms the others were eliminated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct RemainingEquations {
    /// True if each term is constant.
    pub constant: Vec<bool>,
    /// The equations, ascending.
    pub equations: Vec<usize>,
}
