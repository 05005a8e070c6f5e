//! Materials.

pub mod elastic;
