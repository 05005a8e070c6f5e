//! Sparse matrices: assembly into a fixed pattern, and factorisations.

mod factor;
mod mirror;
mod scatter;

pub use factor::Factor;
pub use mirror::Mirror;
pub use scatter::{Part, ScatterMap, lower_matrix, lower_pattern};
