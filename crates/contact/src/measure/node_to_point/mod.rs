//! Slave nodes against the closest point of a master segment.

mod column;
pub mod finite;
pub mod small;
