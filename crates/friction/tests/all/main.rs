//! Tests of friction, in one binary.
#![allow(clippy::unwrap_used)]

mod forward;
mod laws;
mod point;
mod slider;
mod two_step;
mod yield_laws;
