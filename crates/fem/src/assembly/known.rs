//! What is known of the tangents before they are assembled.

use crate::term::Pattern;
use serde::{Deserialize, Serialize};

/// What the caller knows of the tangents of all terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Nothing: LU.
    General,
    /// Symmetric: Cholesky with half the entries; LU where their sum turns out not to be positive definite.
    Symmetric,
    /// Symmetric, and their sum positive definite on the free degrees of freedom: Cholesky, or an error.
    Positive,
}

/// Version and size of a pattern.
pub(super) type Version = (u64, usize);

/// The version and size of a pattern.
pub(super) fn version(pattern: &Pattern) -> Version {
    (pattern.version, pattern.dofs.len())
}

/// Equations of a dense system left over by an elimination, and of which terms the others were eliminated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Left {
    /// Whether each term is constant.
    pub constant: Vec<bool>,
    /// The equations, ascending.
    pub equations: Vec<usize>,
}
