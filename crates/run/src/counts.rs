//! Counts of operations.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Counts of a run, which do not depend on the machine: its steps, its size, and operations `O` of its kind.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[schemars(rename = "CountsOf{O}")]
pub struct Counts<O> {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Points of faults.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// Cells of bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<usize>,
    /// Operations of its kind.
    #[serde(flatten)]
    pub operations: O,
}

/// Counts of the operations of an integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Integration {
    /// Evaluations of the right-hand side; with faults, each applies the operator once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right_hand_sides: Option<u64>,
    /// Evaluations of the Jacobian.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jacobians: Option<u64>,
    /// Factorisations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factorisations: Option<u64>,
    /// Solutions with these factorisations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solves: Option<u64>,
    /// Restarts after events.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restarts: Option<u64>,
}

/// Counts of the operations of steps of bodies.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Operations {
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
    /// Factorisations among them by LU because a symmetric system was not positive definite.
    pub indefinite: usize,
    /// Solves with factorisations of the step's system.
    pub solves: usize,
    /// Iterations of conjugate gradients, if the method is iterative.
    pub linear_iterations: usize,
    /// Factorisations of bodies (condensation).
    pub body_factorisations: usize,
    /// Right-hand sides solved with the factorisations of bodies.
    pub body_solves: usize,
    /// Searches for contact pairs.
    pub searches: usize,
    /// Searches skipped because a bound on the motion proved that no pairing had changed.
    pub searches_skipped: usize,
    /// Projections onto single segments in searches.
    pub projections: usize,
}
