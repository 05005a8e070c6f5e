//! Sparse Cholesky factorisation by the multifrontal method, parallel over the elimination tree.
//!
//! Reason not to take the factorisation of a library: faer's is as fast on one thread, but its loop over supernodes is sequential, and
//! a second thread only enters large dense products. Here independent subtrees are independent tasks, the few large fronts
//! near the root are cut into tiles, and the factorisation can stop at a chosen Schur complement, which is static
//! condensation without solving for hundreds of columns.
//!
//! Pattern, order and memory are in [`Symbolic`]; numbers in [`Cholesky`].

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

pub use mode::{FreeMode, free_mode};
pub use numeric::Cholesky;
pub use symbolic::Symbolic;

/// A pivot that cannot be divided by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pivot {
    /// Its equation, in the numbering of the matrix.
    pub equation: usize,
    /// Remainder of the diagonal entry after elimination.
    pub pivot: f64,
    /// The diagonal entry.
    pub diagonal: f64,
}

/// Reason why a matrix was not factored.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DirectError {
    /// A negative pivot, or one that is no number.
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
        /// Bytes needed.
        needed: usize,
        /// Bytes allowed.
        allowed: usize,
        /// Equations.
        equations: usize,
    },
    /// The system refused memory.
    #[error("the system has no memory left for the direct solver")]
    OutOfMemory,
    /// No order of elimination.
    #[error("{0}")]
    Ordering(String),
}

impl DirectError {
    /// The same with the equation in another numbering.
    #[must_use]
    pub fn renumbered(self, number: impl Fn(usize) -> usize) -> Self {
        let other = |p: Pivot| Pivot { equation: number(p.equation), ..p };
        match self {
            Self::NotPositive(p) => Self::NotPositive(other(p)),
            Self::Singular(p) => Self::Singular(other(p)),
            same => same,
        }
    }

    /// The pivot it is about.
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
