//! The coarsest level, solved by a dense Cholesky factorisation.

use crate::error::FemError;
use crate::iterative::csr::BlockCsr;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Ratio to its diagonal entry below which a pivot is rounding: that combination of rigid motions is not held. The pivots of a
/// held slender body decrease with powers of its length over its thickness; they stay above this ratio for slendernesses in the
/// hundreds.
const FREE: f64 = 1e-12;

/// See the module.
#[derive(Clone, Debug)]
pub struct CoarsestLevel {
    factor: Cholesky<f64, Dyn>,
}

impl CoarsestLevel {
    /// Factors the matrix.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] if it is not positive definite: a part of the body is free to move rigidly.
    pub fn new<const B: usize>(matrix: &BlockCsr<B, B>) -> Result<Self, FemError> {
        let n = matrix.rows() * B;
        let mut dense = DMatrix::<f64>::zeros(n, n);
        for row in 0..matrix.rows() {
            let (columns, values) = matrix.row(row);
            for (&column, block) in columns.iter().zip(values) {
                for (i, entries) in block.iter().enumerate() {
                    for (j, &entry) in entries.iter().enumerate() {
                        dense[(row * B + i, column as usize * B + j)] = entry;
                    }
                }
            }
        }
        let diagonal: Vec<f64> = (0..n).map(|i| dense[(i, i)]).collect();
        let refused = || {
            FemError::Factorisation(
                "the stiffness is not positive definite: a body, or a part of it, is free to move rigidly"
                    .into(),
            )
        };
        let factor = Cholesky::new(dense).ok_or_else(refused)?;
        let l = factor.l_dirty();
        if diagonal.iter().enumerate().any(|(i, &d)| l[(i, i)] * l[(i, i)] <= FREE * d) {
            return Err(refused());
        }
        Ok(Self { factor })
    }

    /// Solves into `x`.
    pub fn solve<const B: usize>(&self, b: &[[f64; B]], x: &mut [[f64; B]]) {
        let mut v = DVector::from_column_slice(b.as_flattened());
        self.factor.solve_mut(&mut v);
        x.as_flattened_mut().copy_from_slice(v.as_slice());
    }

    /// Bytes of the factor.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let l = self.factor.l_dirty();
        l.len() * size_of::<f64>()
    }
}
