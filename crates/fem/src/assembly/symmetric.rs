//! The symmetric part of a matrix, and a check of its singularity.

use crate::multifrontal::{Cholesky, DirectError, Pivot, SymbolicCholesky};
use crate::ordering::Ordering;
use faer::Mat;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use std::sync::Arc;

/// Lower triangle of the symmetric part of a matrix.
pub(super) struct SymmetricPart {
    pub pattern: SymbolicSparseColMat<usize>,
    pub values: Vec<f64>,
}

impl SymmetricPart {
    pub fn from_dense(matrix: &Mat<f64>) -> Self {
        let n = matrix.nrows();
        let column =
            |col: usize| (col..n).map(move |row| (row, 0.5 * (matrix[(row, col)] + matrix[(col, row)])));
        Self::new(n, column)
    }

    pub fn from_sparse(matrix: SparseColMatRef<'_, usize, f64>) -> Self {
        let column = |col: usize| {
            let entries = matrix.row_idx_of_col(col).zip(matrix.val_of_col(col));
            entries.filter(move |(row, _)| *row >= col).map(move |(row, &value)| {
                let other = if row > col { matrix.get(col, row).copied() } else { None };
                (row, other.map_or(value, |other| 0.5 * (value + other)))
            })
        };
        Self::new(matrix.ncols(), column)
    }

    /// Omits off-diagonal zeros, such as those of open contact: they would connect equations that they do not hold.
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

    /// Factors the matrix.
    pub fn factor(&self) -> Result<Cholesky, DirectError> {
        let symbolic = SymbolicCholesky::new(self.pattern.as_ref(), Ordering::Automatic)?;
        Cholesky::new(Arc::new(symbolic), &self.values)
    }

    /// The pivot at which the matrix is singular, if no negative modes come before it.
    pub fn singular(&self) -> Option<Pivot> {
        match self.factor() {
            Err(DirectError::Singular(pivot)) => Some(pivot),
            _ => None,
        }
    }
}
