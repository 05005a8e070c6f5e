//! Factors of dense matrices, computed in the storage of the matrix.
//!
//! An interface is refactored in each iteration. Allocating storage for each factor leaves gaps between lasting allocations, and the same
//! run may then take up to twice as much more memory, by chance.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{self as llt, LltError};
use faer::linalg::lu::partial_pivoting::{factor as lu, solve as lu_solve};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::perm::Perm;
use faer::traits::ComplexField;
use faer::{Mat, MatMut, MatRef, Par};

/// Factors of a matrix.
#[derive(Debug)]
pub(super) enum DenseFactor {
    Cholesky(Cholesky),
    Lu(Lu),
}

impl DenseFactor {
    /// Solves in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        match self {
            Self::Cholesky(factor) => factor.solve(rhs),
            Self::Lu(factor) => factor.solve(rhs),
        }
    }

    /// The storage, for reuse.
    pub fn into_memory(self) -> Mat<f64> {
        match self {
            Self::Cholesky(Cholesky { lower }) => lower,
            Self::Lu(Lu { both, .. }) => both,
        }
    }
}

/// `K = L Lᵀ`.
#[derive(Debug)]
pub(super) struct Cholesky {
    /// L; entries above the diagonal are meaningless.
    lower: Mat<f64>,
}

/// A pivot that is not above its bound: the storage of the matrix, the equation of the pivot and its value, NaN if it is not
/// positive.
pub(super) struct PivotFailure {
    pub memory: Mat<f64>,
    pub equation: usize,
    pub pivot: f64,
}

impl Cholesky {
    /// Factors a matrix of which only the lower triangle is read; each pivot must exceed its bound.
    pub fn new(mut matrix: Mat<f64>, bound: impl Fn(usize) -> f64) -> Result<Self, PivotFailure> {
        let n = matrix.nrows();
        let mut memory =
            MemBuffer::new(llt::cholesky_in_place_scratch::<f64>(n, Par::Seq, Default::default()));
        let stack = MemStack::new(&mut memory);
        let outcome =
            llt::cholesky_in_place(matrix.as_mut(), Default::default(), Par::Seq, stack, Default::default());
        if let Err(LltError::NonPositivePivot { index: equation }) = outcome {
            return Err(PivotFailure { memory: matrix, equation, pivot: f64::NAN });
        }
        let failed = (0..n).map(|k| (k, matrix[(k, k)].powi(2))).find(|&(k, pivot)| pivot <= bound(k));
        match failed {
            Some((equation, pivot)) => Err(PivotFailure { memory: matrix, equation, pivot }),
            None => Ok(Self { lower: matrix }),
        }
    }

    /// L, on and below the diagonal.
    pub fn lower(&self) -> MatRef<'_, f64> {
        self.lower.as_ref()
    }

    /// Solves in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        solve_lower_triangular_in_place(self.lower(), column(rhs), Par::Seq);
        solve_upper_triangular_in_place(self.lower().transpose(), column(rhs), Par::Seq);
    }
}

/// `P K = L U` with partial pivoting.
#[derive(Debug)]
pub(super) struct Lu<T = f64> {
    /// U, and L below the diagonal.
    both: Mat<T>,
    rows: Perm<usize>,
}

impl<T: ComplexField> Lu<T> {
    /// Factors a matrix.
    pub fn new(mut matrix: Mat<T>) -> Self {
        let n = matrix.nrows();
        let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
        let request = lu::lu_in_place_scratch::<usize, T>(n, n, Par::Seq, Default::default());
        let mut memory = MemBuffer::new(request);
        let stack = MemStack::new(&mut memory);
        lu::lu_in_place(matrix.as_mut(), &mut forward, &mut inverse, Par::Seq, stack, Default::default());
        Self { both: matrix, rows: Perm::new_checked(forward.into(), inverse.into(), n) }
    }

    /// Solves in place.
    pub fn solve(&self, rhs: &mut [T]) {
        let request = lu_solve::solve_in_place_scratch::<usize, T>(rhs.len(), 1, Par::Seq);
        let mut memory = MemBuffer::new(request);
        let (both, stack) = (self.both.as_ref(), MemStack::new(&mut memory));
        lu_solve::solve_in_place(both, both, self.rows.as_ref(), column(rhs), Par::Seq, stack);
    }
}

/// Values as a matrix of one column.
pub(super) fn column<T>(values: &mut [T]) -> MatMut<'_, T> {
    let n = values.len();
    MatMut::from_column_major_slice_mut(values, n, 1)
}

/// A copy in existing storage, if it fits.
pub(super) fn copied(matrix: &Mat<f64>, memory: Option<Mat<f64>>) -> Mat<f64> {
    match memory {
        Some(mut memory) if memory.shape() == matrix.shape() => {
            memory.copy_from(matrix);
            memory
        }
        _ => matrix.clone(),
    }
}
