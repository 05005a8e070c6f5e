//! Factorisations of assembled matrices, split into the symbolic part, done once per pattern, and the numeric part.

use super::ScatterMap;
use crate::error::FemError;
use crate::multifrontal::{Cholesky, SymbolicCholesky};
use crate::ordering::Ordering;
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::{Conj, MatMut};
use std::sync::Arc;

impl ScatterMap {
    /// Symbolic Cholesky analysis of a pattern built with [`Part::Lower`](super::Part::Lower). Its [`bytes`](Symbolic::bytes)
    /// give the memory of the numeric part in advance.
    ///
    /// # Errors
    /// If memory does not suffice or the pattern is too large to be ordered.
    pub fn analyse_cholesky(&self) -> Result<Arc<SymbolicCholesky>, FemError> {
        Ok(Arc::new(SymbolicCholesky::new(self.symbolic(), Ordering::Automatic)?))
    }

    /// Numeric Cholesky factorisation.
    ///
    /// # Errors
    /// [`FemError::Direct`] with the equation if the matrix is not positive definite.
    pub fn cholesky(&self, symbolic: &Arc<SymbolicCholesky>) -> Result<Factor, FemError> {
        Ok(Factor::Cholesky(Cholesky::new(symbolic.clone(), self.values())?))
    }

    /// Symbolic LU analysis (column ordering) of a pattern built with [`Part::Whole`](super::Part::Whole).
    ///
    /// # Errors
    /// If memory does not suffice.
    pub fn analyse_lu(&self) -> Result<SymbolicLu<usize>, FemError> {
        SymbolicLu::try_new(self.symbolic())
            .map_err(|e| FemError::Factorisation(format!("symbolic LU: {e:?}")))
    }

    /// Numeric LU factorisation.
    ///
    /// # Errors
    /// If the matrix is structurally singular.
    pub fn lu(&self, symbolic: &SymbolicLu<usize>) -> Result<Factor, FemError> {
        Lu::try_new_with_symbolic(symbolic.clone(), self.matrix())
            .map(|f| Factor::Lu(Box::new(f)))
            .map_err(|e| FemError::Factorisation(format!("the tangent is singular ({e:?})")))
    }
}

/// A numeric factorisation, tied to the values from which it was computed.
#[derive(Clone, Debug)]
pub enum Factor {
    /// Symmetric positive definite.
    Cholesky(Cholesky),
    /// General.
    Lu(Box<Lu<usize, f64>>),
}

impl Factor {
    /// Solves in place for the columns of `rhs`.
    pub fn solve(&self, rhs: MatMut<'_, f64>) {
        match self {
            Self::Cholesky(f) => f.solve(rhs),
            Self::Lu(f) => f.solve_in_place_with_conj(Conj::No, rhs),
        }
    }
}
