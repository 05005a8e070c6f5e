//! Checks of a mesh before any computation.

mod hanging;
mod jacobian;
mod parts;
mod suggestion;

pub(crate) use hanging::{Hanging, hanging};
pub(crate) use jacobian::{Sense, least, sense};
pub(crate) use parts::{Extent, Parts, free_part};
pub(crate) use suggestion::nearest;
