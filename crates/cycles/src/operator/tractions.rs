//! Matrices of the tractions that slip causes.

use super::dense::Dense;

/// Tractions caused by slip, component by component.
#[derive(Debug)]
pub enum Tractions {
    /// Slip along one direction.
    One(Dense),
    /// Slip along two directions: the operators of each component on itself, and those between the components where
    /// slip in one loads the other.
    Two {
        /// Operators of each component on itself, with normal tractions.
        along: Box<[Dense; 2]>,
        /// Operators of the second component on the first and of the first on the second, without normal tractions.
        across: Option<Box<[Dense; 2]>>,
    },
}
