//! Sparse Cholesky factorisation by the multifrontal method, parallel over the elimination tree.
//!
//! Reasons against the factorisation of a library: faer's is as fast on one thread, but its loop over supernodes is sequential,
//! and a second thread only enters large dense products. Here independent subtrees are independent tasks, and the few large
//! fronts near the root are cut into tiles. The factorisation can also stop at a chosen Schur complement: this is static
//! condensation without solving for hundreds of columns.
//!
//! [`Symbolic`] holds pattern, order and memory; [`Cholesky`] holds numbers.

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

pub use mode::{FreeMode, free_mode};
pub use numeric::Cholesky;
pub use symbolic::Symbolic;
pub use triangle::Triangle;

/// A pivot that cannot be used as a divisor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pivot {
    /// Equation, in the numbering of the matrix.
    pub equation: usize,
    /// Diagonal entry after the elimination.
    pub pivot: f64,
    /// Diagonal entry of the matrix.
    pub diagonal: f64,
}

/// Reasons why a matrix was not factored.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DirectError {
    /// A negative pivot, or one that is not a number.
    #[error(
        "the matrix is not positive definite: equation {} has the pivot {:e} (diagonal {:e})",
        .0.equation, .0.pivot, .0.diagonal
    )]
    NotPositive(Pivot),
    /// A pivot of the size of rounding: a motion that nothing resists.
    #[error(
        "the matrix is singular: equation {} is not held, its pivot {:e} is rounding of its diagonal {:e}",
        .0.equation, .0.pivot, .0.diagonal
    )]
    Singular(Pivot),
    /// More memory than allowed.
    #[error(
        "the direct solver needs {:.2} GiB for {equations} equations, {:.2} GiB are allowed",
        gibibytes(*.needed), gibibytes(*.allowed)
    )]
    Memory {
        /// Memory needed \[bytes\].
        needed: usize,
        /// Memory allowed \[bytes\].
        allowed: usize,
        /// Number of equations.
        equations: usize,
    },
    /// The operating system refused memory.
    #[error("the system has no memory left for the direct solver")]
    OutOfMemory,
    /// No order of elimination.
    #[error("{0}")]
    Ordering(String),
}

impl DirectError {
    /// The same error with the equation in another numbering.
    #[must_use]
    pub fn renumbered(self, number: impl Fn(usize) -> usize) -> Self {
        let other = |p: Pivot| Pivot { equation: number(p.equation), ..p };
        match self {
            Self::NotPositive(p) => Self::NotPositive(other(p)),
            Self::Singular(p) => Self::Singular(other(p)),
            same => same,
        }
    }

    /// The pivot in question.
    #[must_use]
    pub fn pivot(&self) -> Option<Pivot> {
        match self {
            Self::NotPositive(p) | Self::Singular(p) => Some(*p),
            _ => None,
        }
    }
}

fn gibibytes(bytes: usize) -> f64 {
    bytes as f64 / f64::from(1 << 30)
}
