//! Finding the closest point of a surface: boxes in a tree for candidates, projections for the answer.

pub mod patch;
pub mod project;
pub(crate) mod smooth;
pub mod surface;
pub mod tree;
