//! Node-to-point measures: slave nodes against the closest point of a master segment.

pub mod finite;
mod kernel;
mod local;
pub mod small;
mod track;
