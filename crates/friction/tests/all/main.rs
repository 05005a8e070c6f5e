//! Tests of friction, in one binary.
#![allow(clippy::unwrap_used)]

mod damping;
mod forward;
mod laws;
mod point;
mod pointwise;
mod slider;
mod two_step;
#[path = "../usual/mod.rs"]
mod usual;
mod yield_laws;
