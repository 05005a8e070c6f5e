//! A dense system, for condensed bodies.

use super::Symmetry;
use super::held::SymmetricPart;
use crate::dof::Equations;
use crate::error::FemError;
use crate::multifrontal::{DirectError, Pivot};
use crate::term::Pattern;
use faer::linalg::solvers::{Llt, LltError, PartialPivLu, SolveCore};
use faer::{Conj, Mat, MatMut, Side};

/// Rounding of a pivot relative to its diagonal entry, times the square root of the number of pivots, as in the sparse
/// factorisation.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

#[derive(Debug)]
pub(super) struct DenseStore {
    pub matrix: Mat<f64>,
    factor: Option<DenseFactor>,
}

#[derive(Debug)]
enum DenseFactor {
    Cholesky(Llt<f64>),
    Lu(PartialPivLu<f64>),
}

impl DenseStore {
    pub fn new(n: usize) -> Self {
        Self { matrix: Mat::zeros(n, n), factor: None }
    }

    pub fn clear(&mut self) {
        self.matrix.fill(0.0);
        self.factor = None;
    }

    /// Adds blocks on the free equations.
    pub fn add(&mut self, equations: &Equations, pattern: &Pattern, values: &[f64]) {
        let mut offset = 0;
        for block in pattern.blocks() {
            let n = block.len();
            for (j, &c) in block.iter().enumerate() {
                let col = equations.number[c];
                if col == Equations::FIXED {
                    continue;
                }
                let column = self.matrix.col_as_slice_mut(col);
                for (i, &r) in block.iter().enumerate() {
                    let row = equations.number[r];
                    if row != Equations::FIXED {
                        column[row] += values[offset + i * n + j];
                    }
                }
            }
            offset += n * n;
        }
    }

    /// The diagonal, by equation.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.matrix.nrows()).map(|k| self.matrix[(k, k)]).collect()
    }

    /// The first column all of whose entries are zero.
    pub fn empty_column(&self) -> Option<usize> {
        let empty = |k: usize| self.matrix.col_as_slice(k).iter().all(|&v| v == 0.0);
        (0..self.matrix.ncols()).position(empty)
    }

    /// Whether LU had to stand in for Cholesky.
    pub fn factor(&mut self, symmetry: Symmetry) -> Result<bool, FemError> {
        let general = |matrix: &Mat<f64>| Some(DenseFactor::Lu(matrix.partial_piv_lu()));
        if symmetry == Symmetry::General {
            self.factor = general(&self.matrix);
            return Ok(false);
        }
        match self.cholesky() {
            Ok(factor) => {
                self.factor = Some(DenseFactor::Cholesky(factor));
                Ok(false)
            }
            Err(DirectError::NotPositive(_)) if symmetry == Symmetry::Symmetric => {
                self.factor = general(&self.matrix);
                Ok(true)
            }
            Err(error) => Err(error.into()),
        }
    }

    /// Cholesky, and where that fails the reason from the factorisation that tells a singular matrix from one with negative
    /// modes.
    fn cholesky(&self) -> Result<Llt<f64>, DirectError> {
        let n = self.matrix.nrows();
        let smallest = ROUNDING * (n as f64).sqrt();
        let factor = self.matrix.llt(Side::Lower);
        let failed = match &factor {
            Err(LltError::NonPositivePivot { index }) => Some((*index, f64::NAN)),
            Ok(factor) => {
                let l = factor.L();
                (0..n).map(|k| (k, l[(k, k)].powi(2))).find(|&(k, p)| p <= smallest * self.matrix[(k, k)])
            }
        };
        match (failed, factor) {
            (None, Ok(factor)) => Ok(factor),
            (failed, _) => {
                SymmetricPart::of_dense(&self.matrix).factor()?;
                let (equation, pivot) = failed.unwrap_or((0, f64::NAN));
                let diagonal = self.matrix[(equation, equation)];
                Err(DirectError::NotPositive(Pivot { equation, pivot, diagonal }))
            }
        }
    }

    /// Solves in place; false without a factor.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        let n = rhs.len();
        let columns = MatMut::from_column_major_slice_mut(rhs, n, 1);
        match &self.factor {
            Some(DenseFactor::Lu(f)) => f.solve_in_place_with_conj(Conj::No, columns),
            Some(DenseFactor::Cholesky(f)) => f.solve_in_place_with_conj(Conj::No, columns),
            None => return false,
        }
        true
    }
}
