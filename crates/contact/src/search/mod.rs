//! Search for the closest point of a surface: a tree of boxes for candidates, projections for the result.

pub mod patch;
pub mod project;
pub(crate) mod smooth;
pub mod surface;
pub mod tree;
