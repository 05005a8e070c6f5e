//! Checks of a mesh before any computation.

mod jacobian;
mod near;
mod parts;

pub(crate) use jacobian::{Sense, least, sense};
pub(crate) use near::nearest;
pub(crate) use parts::{Extent, free_part};
