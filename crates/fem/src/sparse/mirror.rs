//! Both triangles of a symmetric matrix of which the lower one is stored.

use super::{Factor, ScatterMap};
use crate::error::FemError;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};

/// Pattern and LU analysis of a symmetric matrix, and the position of each entry in the lower triangle.
#[derive(Debug)]
pub struct Mirror {
    pattern: SymbolicSparseColMat<usize>,
    source: Vec<usize>,
    symbolic: SymbolicLu<usize>,
}

impl Mirror {
    /// Mirrors a map built with [`Part::Lower`](super::Part::Lower).
    ///
    /// # Errors
    /// If memory does not suffice for the analysis.
    pub fn new(map: &ScatterMap) -> Result<Self, FemError> {
        let (n, lower) = (map.order(), map.symbolic());
        let (from, rows) = (lower.col_ptr(), lower.row_idx());
        let mut count = vec![0_usize; n + 1];
        for col in 0..n {
            for &row in &rows[from[col]..from[col + 1]] {
                count[col + 1] += 1;
                count[row + 1] += usize::from(row != col);
            }
        }
        for col in 0..n {
            count[col + 1] += count[col];
        }
        let (mut next, total) = (count.clone(), count[n]);
        let (mut row_of, mut source) = (vec![0; total], vec![0; total]);
        // Columns are visited in order: above the diagonal the rows of each column come out ascending. They precede the
        // column's own rows, which are written when the column itself is visited.
        for col in 0..n {
            for (k, &row) in (from[col]..).zip(&rows[from[col]..from[col + 1]]) {
                for (c, r) in [(col, row), (row, col)].into_iter().take(if row == col { 1 } else { 2 }) {
                    row_of[next[c]] = r;
                    source[next[c]] = k;
                    next[c] += 1;
                }
            }
        }
        let pattern = SymbolicSparseColMat::new_checked(n, n, count, None, row_of);
        let symbolic = SymbolicLu::try_new(pattern.as_ref())
            .map_err(|e| FemError::Factorisation(format!("symbolic LU: {e:?}")))?;
        Ok(Self { pattern, source, symbolic })
    }

    /// LU of the matrix whose lower triangle has these values.
    ///
    /// # Errors
    /// If the matrix is structurally singular.
    pub fn lu(&self, lower: &[f64]) -> Result<Factor, FemError> {
        let values: Vec<f64> = self.source.iter().map(|&k| lower[k]).collect();
        Lu::try_new_with_symbolic(self.symbolic.clone(), SparseColMatRef::new(self.pattern.as_ref(), &values))
            .map(|f| Factor::Lu(Box::new(f)))
            .map_err(|e| FemError::Factorisation(format!("the tangent is singular ({e:?})")))
    }
}
