//! Kernels of dislocations against other programs, against each other, and against the equations that they solve.
#![allow(clippy::unwrap_used)]

mod agreement;
mod common;
mod equations;
mod plane;
mod references;
mod singular;
