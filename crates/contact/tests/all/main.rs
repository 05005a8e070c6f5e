//! Tests of contact in one binary. `allocation` counts allocations and needs a binary to itself.
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

mod curved;
mod enforcement;
mod forward;
mod iterates;
mod mirrors;
mod mortar;
mod normals;
mod physics;
mod search;
mod sliding;
mod tangent;
