//! The problem to integrate, with warnings.

use crate::warning::Warning;
use asperity_cycles::slider::Problem;

/// The problem to integrate, with warnings.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Sliders, springs and load, and the settings of the integration.
    pub problem: Problem,
    /// Warnings about settings that are probably not intended.
    pub warnings: Vec<Warning>,
}

impl From<Problem> for Plan {
    fn from(problem: Problem) -> Self {
        Self { problem, warnings: Vec::new() }
    }
}
