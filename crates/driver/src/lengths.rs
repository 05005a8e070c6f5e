//! Lengths in words, as scenes write them.

pub(crate) use crate::scene::check::brief;
