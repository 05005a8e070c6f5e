//! What a system does not hold.

use super::{Store, System};
use crate::multifrontal::{Cholesky, DirectError, FreeMode, Pivot, Symbolic, free_mode};
use crate::ordering::Ordering;
use faer::Mat;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use std::sync::Arc;

/// Largest entry times solution over load beyond which LU may have divided by rounding. The product bounds the condition from
/// below; stiff contact on flexible bodies reaches 1e8.
const SUSPECT: f64 = 1e12;

impl System {
    /// The motion that the matrix assembled last does not resist, where it is singular and has no negative modes. Of a matrix
    /// that is not symmetric its symmetric part counts: where nothing resists, there is nothing unsymmetric. Degree of
    /// freedom = node * D + component, positions in `nodes` \[m\]. Costs some factorisations; the iterative method keeps no
    /// matrix that could be factored, and has no answer.
    #[must_use]
    pub fn free_mode<const D: usize>(&self, nodes: &[[f64; D]]) -> Option<FreeMode<D>> {
        if self.equations.number.len() != nodes.len() * D {
            return None;
        }
        let lower = self.lower()?;
        let pivot = lower.singular()?;
        let matrix = SparseColMatRef::new(lower.pattern.as_ref(), &lower.values);
        free_mode(matrix, pivot.equation, &self.equations, nodes).ok()
    }

    /// Whether the matrix assembled last is singular where the solution `x` of `rhs` makes that probable: LU does not tell a
    /// pivot that is rounding from one that is small.
    pub(super) fn suspect(&self, x: f64, rhs: f64) -> Option<Pivot> {
        if x * self.largest_entry <= SUSPECT * rhs {
            return None;
        }
        self.lower()?.singular()
    }

    /// Lower triangle of the symmetric part of the matrix.
    fn lower(&self) -> Option<SymmetricPart> {
        match &self.store {
            Store::Dense(store) => Some(SymmetricPart::of_dense(&store.matrix())),
            Store::Sparse(store) => store.map.as_ref().map(|map| SymmetricPart::of_sparse(map.matrix())),
            Store::Iterative(_) => None,
        }
    }
}

/// Lower triangle of the symmetric part of a matrix.
pub(super) struct SymmetricPart {
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
}

impl SymmetricPart {
    pub fn of_dense(matrix: &Mat<f64>) -> Self {
        let n = matrix.nrows();
        let column =
            |col: usize| (col..n).map(move |row| (row, 0.5 * (matrix[(row, col)] + matrix[(col, row)])));
        Self::new(n, column)
    }

    fn of_sparse(matrix: SparseColMatRef<'_, usize, f64>) -> Self {
        let column = |col: usize| {
            let entries = matrix.row_idx_of_col(col).zip(matrix.val_of_col(col));
            entries.filter(move |(row, _)| *row >= col).map(move |(row, &value)| {
                let other = if row > col { matrix.get(col, row).copied() } else { None };
                (row, other.map_or(value, |other| 0.5 * (value + other)))
            })
        };
        Self::new(matrix.ncols(), column)
    }

    /// Zeros, those of open contact among them, would connect what they do not hold: they are left out.
    fn new<I: Iterator<Item = (usize, f64)>>(n: usize, column: impl Fn(usize) -> I) -> Self {
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for col in 0..n {
            for (row, value) in column(col).filter(|&(row, value)| row == col || value != 0.0) {
                rows.push(row);
                values.push(value);
            }
            starts.push(rows.len());
        }
        Self { pattern: SymbolicSparseColMat::new_checked(n, n, starts, None, rows), values }
    }

    /// Factors it.
    pub fn factor(&self) -> Result<Cholesky, DirectError> {
        let symbolic = Symbolic::new(self.pattern.as_ref(), Ordering::Automatic)?;
        Cholesky::new(Arc::new(symbolic), &self.values)
    }

    /// The pivot where it is singular, without negative modes before.
    fn singular(&self) -> Option<Pivot> {
        match self.factor() {
            Err(DirectError::Singular(pivot)) => Some(pivot),
            _ => None,
        }
    }
}
