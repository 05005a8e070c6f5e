//! Requirements on a mesh before anybody computes on it.

mod jacobian;
mod near;
mod parts;

pub(crate) use jacobian::{Sense, least, sense};
pub(crate) use near::nearest;
pub(crate) use parts::{Extent, free_part};
