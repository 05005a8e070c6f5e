//! Values that steppers keep between steps.

use asperity_fem::assembly::Memory;
use serde::{Deserialize, Serialize};

/// Values that a stepper keeps between steps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepperState {
    /// Displacement increment of the last implicit step \[m\] and its length \[s\], from which the next is predicted.
    pub(super) last: Option<(Vec<f64>, f64)>,
    /// Residual left by the last static-explicit step; empty before the first and in implicit steps.
    pub(super) left: Vec<f64>,
    /// Memory of the linear system.
    pub(super) system: Memory,
}
