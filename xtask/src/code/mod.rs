//! Sources of Rust as masked characters, and the parts of them.

pub mod mask;
pub mod regions;
pub mod tokens;
