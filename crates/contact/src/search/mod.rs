//! Finding the closest point of a surface: boxes in a tree for candidates, projections for the answer.

pub mod project;
pub mod surface;
pub mod tree;
