//! Equations of a dense system that appear only in constant terms, eliminated once for many factorisations of the others.
//!
//! With g for the eliminated and r for the remaining equations, `K_gg = L Lᵀ` and `X = L⁻¹ K_gr`, the remaining matrix is `S =
//! K_rr - Xᵀ X`, to which the changing terms are added. Contact changes only the rows of closed points, a small part of an
//! interface in most models.

use super::dense_factor::{Cholesky, column, copied};
use crate::dof::Equations;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Accum, Mat, Par};

/// Rounding of a pivot relative to its diagonal entry, times the square root of the number of pivots, as in the sparse
/// factorisation.
pub(super) const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// An entry of a changing term: row, column, value.
pub(super) type Entry = (usize, usize, f64);

#[derive(Debug)]
pub(super) struct SchurComplement {
    gone: Vec<usize>,
    rest: Vec<usize>,
    /// Position of each equation in `rest`, or [`Equations::FIXED`].
    place: Vec<usize>,
    factor: Cholesky,
    /// X.
    coupling: Mat<f64>,
    /// S.
    schur: Mat<f64>,
}

impl SchurComplement {
    /// Keeps the equations of `kept` and eliminates the others; `None` if these are not positive definite by themselves.
    pub fn new(constant: &Mat<f64>, kept: &[bool]) -> Option<Self> {
        let (rest, gone): (Vec<usize>, Vec<usize>) = (0..kept.len()).partition(|&k| kept[k]);
        let mut place = vec![Equations::FIXED; kept.len()];
        for (k, &equation) in rest.iter().enumerate() {
            place[equation] = k;
        }
        let part = |rows: &[usize], cols: &[usize]| {
            Mat::from_fn(rows.len(), cols.len(), |i, j| constant[(rows[i], cols[j])])
        };
        let smallest = ROUNDING * (gone.len() as f64).sqrt();
        let bound = |k: usize| smallest * constant[(gone[k], gone[k])];
        let factor = Cholesky::new(part(&gone, &gone), bound).ok()?;
        let mut coupling = part(&gone, &rest);
        solve_lower_triangular_in_place(factor.lower(), coupling.as_mut(), Par::Seq);
        let mut schur = part(&rest, &rest);
        matmul(schur.as_mut(), Accum::Add, coupling.transpose(), coupling.as_ref(), -1.0, Par::Seq);
        Some(Self { gone, rest, place, factor, coupling, schur })
    }

    /// Remaining equations.
    pub fn rest(&self) -> &[usize] {
        &self.rest
    }

    /// True if all these equations remain.
    pub fn leaves(&self, mut equations: impl Iterator<Item = usize>) -> bool {
        equations.all(|e| self.place[e] != Equations::FIXED)
    }

    /// The matrix of the remaining equations with the changing entries, all of which lie in its rows and columns; in `memory`
    /// if it fits.
    pub fn with(&self, changing: &[Entry], memory: Option<Mat<f64>>) -> Mat<f64> {
        let mut matrix = copied(&self.schur, memory);
        for &(row, col, value) in changing {
            matrix[(self.place[row], self.place[col])] += value;
        }
        matrix
    }

    /// Solves in place; `solve` solves for the remaining equations.
    pub fn solve(&self, rhs: &mut [f64], solve: impl FnOnce(&mut [f64])) {
        let mut own: Vec<f64> = self.gone.iter().map(|&k| rhs[k]).collect();
        let mut rest: Vec<f64> = self.rest.iter().map(|&k| rhs[k]).collect();
        solve_lower_triangular_in_place(self.factor.lower(), column(&mut own), Par::Seq);
        matmul(column(&mut rest), Accum::Add, self.coupling.transpose(), column(&mut own), -1.0, Par::Seq);
        solve(&mut rest);
        matmul(column(&mut own), Accum::Add, self.coupling.as_ref(), column(&mut rest), -1.0, Par::Seq);
        solve_upper_triangular_in_place(self.factor.lower().transpose(), column(&mut own), Par::Seq);
        for (list, values) in [(&self.gone, own), (&self.rest, rest)] {
            list.iter().zip(values).for_each(|(&k, value)| rhs[k] = value);
        }
    }
}
