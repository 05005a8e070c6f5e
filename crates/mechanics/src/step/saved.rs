//! Values that steppers keep from step to step.

use asperity_fem::assembly::Memory;
use serde::{Deserialize, Serialize};

/// See the module.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepperState {
    /// Displacement increment of the last implicit step \[m\] and its length \[s\], with which the next is predicted.
    pub(super) last: Option<(Vec<f64>, f64)>,
    /// Residual that the last static-explicit step left; empty before the first, and in implicit steps.
    pub(super) left: Vec<f64>,
    /// Memory of the linear system.
    pub(super) system: Memory,
}
