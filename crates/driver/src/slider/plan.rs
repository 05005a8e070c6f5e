//! The problem to integrate, and doubts about it.

use crate::warning::Warning;
use asperity_cycles::slider::Problem;

/// The problem to integrate.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Sliders, springs and load, and how they are integrated.
    pub problem: Problem,
    /// Settings that are probably not meant as they stand in the scene.
    pub warnings: Vec<Warning>,
}

impl From<Problem> for Plan {
    fn from(problem: Problem) -> Self {
        Self { problem, warnings: Vec::new() }
    }
}
