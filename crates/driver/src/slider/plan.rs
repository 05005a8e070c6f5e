//! What is integrated, and what is doubtful about it.

use crate::warning::Warning;
use asperity_cycles::slider::Problem;

/// What is to be integrated.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Sliders, springs and load, and how they are integrated.
    pub problem: Problem,
    /// What probably does not mean what the author of the scene wants.
    pub warnings: Vec<Warning>,
}

impl From<Problem> for Plan {
    fn from(problem: Problem) -> Self {
        Self { problem, warnings: Vec::new() }
    }
}
