//! Errors of an operator that is compressed from its entries.

use asperity_cycles::operator::{Errors, Operator};
use schemars::JsonSchema;
use serde::Serialize;

/// Errors of tractions, relative to the tractions of the same slip, found at some points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Compression {
    /// Memory of the operator \[bytes\].
    pub bytes: usize,
    /// Number of points.
    pub points: usize,
    /// Error for slip that is random from point to point.
    pub random: f64,
    /// Error for slip that is the same everywhere.
    pub uniform: f64,
}

impl Compression {
    /// Errors of an operator, where they have been found.
    pub(super) fn from_operator(operator: &dyn Operator) -> Option<Self> {
        let Errors { points, random, uniform } = operator.errors()?;
        Some(Self { bytes: operator.bytes(), points, random, uniform })
    }
}
