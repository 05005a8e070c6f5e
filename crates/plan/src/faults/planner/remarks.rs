//! Warnings and notes of a plan.

use asperity_run::Warning;

/// Remarks of a plan about a scene.
#[derive(Debug, Default)]
pub(crate) struct Remarks {
    /// Settings that are probably not intended.
    pub warnings: Vec<Warning>,
    /// Decisions of the plan.
    pub notes: Vec<String>,
}
