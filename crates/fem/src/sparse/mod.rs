//! Sparse matrices: assembly into a fixed pattern, and factorisations.

mod factor;
mod scatter;

pub use factor::Factor;
pub use scatter::{Part, ScatterMap};
