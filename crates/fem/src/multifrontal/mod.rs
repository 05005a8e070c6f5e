//! Sparse Cholesky factorisation by the multifrontal method, parallel over the elimination tree.
//!
//! Reasons against the factorisation of a library: faer's is as fast on one thread, but its loop over supernodes is sequential,
//! and a second thread only enters large dense products. Here independent subtrees are independent tasks, and the few large
//! fronts near the root are cut into tiles. The factorisation can also stop at a chosen Schur complement: this is static
//! condensation without solving for hundreds of columns.
//!
//! [`SymbolicCholesky`] holds pattern, order and memory; [`Cholesky`] holds numbers.

mod dense;
mod extend;
mod kernel;
mod mode;
mod numeric;
mod schedule;
mod solve;
mod supernodes;
mod symbolic;
mod tasks;
mod tree;
mod triangle;

pub use crate::error::{DirectError, Pivot};
pub use mode::{FreeMode, free_mode};
pub use numeric::Cholesky;
pub use symbolic::SymbolicCholesky;
pub use triangle::Triangle;
