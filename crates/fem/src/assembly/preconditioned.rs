//! A sparse unsymmetric system solved by GMRES. The factor of a symmetric matrix near it, made at the first solve of a step, is
//! the preconditioner of the solves of that step for as long as it costs less than another.
//!
//! Friction makes a tangent unsymmetric in the rows of points that slip, which are few, and an iteration of Newton's method
//! changes little else. A Cholesky factor costs a fraction of LU, of which half is kept.

use super::Analysis;
use super::direct::SparseStore;
use super::renewal::Renewal;
use super::solution::{Solution, USEFUL};
use super::symmetry::Symmetry;
use crate::dof::Equations;
use crate::error::FemError;
use crate::iterative::gmres::{self, Bounds, PreconditionedSystem};
use crate::multifrontal::DirectError;
use crate::sparse::ScatterMap;
use crate::term::Pattern;
use faer::sparse::SparseColMatRef;

/// Bounds of a solution. Newton's method, whose residual falls by the tolerance at best, takes as many iterations with 1e-5 as with
/// exact directions while pairs and plastic points change, and one more at its end; smaller ones cost more than they save.
const BOUNDS: Bounds = Bounds { tolerance: 1e-5, restart: 60, most_iterations: 180, paced: false };
/// Rate of operations in a factorisation over that in a solve, which waits for memory.
const FACTORISATION_RATE: f64 = 8.0;
/// Memory of LU over that of Cholesky with the same pattern: both triangles, without the fill due to pivoting.
const UNSYMMETRIC: usize = 2;

#[derive(Debug)]
pub(super) struct PreconditionedStore {
    /// The matrix, and its LU where iterations fail.
    whole: SparseStore,
    /// The symmetric matrix near it; the matrix itself where that is symmetric.
    near: SparseStore,
    /// Memory that a factorisation may use \[bytes\].
    memory: usize,
    symmetry: Symmetry,
    renewal: Renewal,
    /// True if the matrices of the step are factored as they are, since iterations failed with a preconditioner of their own.
    factored: bool,
    /// True if the present matrix is factored as it is, since the symmetric one is not positive definite.
    exact: bool,
}

impl PreconditionedStore {
    pub fn new(memory: usize, analysis: Option<Analysis>) -> Self {
        let mut near = SparseStore::default();
        near.prepare(memory, analysis);
        let (whole, symmetry) = (SparseStore::default(), Symmetry::General);
        Self { whole, near, memory, symmetry, renewal: Renewal::new(), factored: false, exact: false }
    }

    /// Forgets patterns and factors.
    pub fn forget(&mut self) {
        self.whole.forget();
        self.near.forget();
        self.begin_step();
    }

    /// The next matrix is that of another step, whose preconditioner depends on nothing before it.
    pub fn begin_step(&mut self) {
        (self.renewal.due, self.factored) = (true, false);
    }

    /// True if the next assembly needs the values of the symmetric matrix as well.
    pub fn is_due(&self) -> bool {
        self.renewal.due && self.symmetry == Symmetry::General
    }

    /// Prepares an assembly of these patterns.
    pub fn begin(
        &mut self,
        patterns: &[&Pattern],
        equations: &Equations,
        symmetry: Symmetry,
    ) -> Result<(), FemError> {
        self.symmetry = symmetry;
        if symmetry != Symmetry::General {
            self.near.renew(patterns, equations, symmetry)?;
            self.near.clear();
            return Ok(());
        }
        self.exact = false;
        self.whole.renew(patterns, equations, symmetry)?;
        self.whole.clear();
        if self.renewal.due {
            self.near.renew(patterns, equations, Symmetry::Positive)?;
            self.near.clear();
        }
        Ok(())
    }

    pub fn add(&mut self, offset: usize, values: &[f64]) -> usize {
        match self.symmetry {
            Symmetry::General => self.whole.add(offset, values),
            _ => self.near.add(offset, values),
        }
    }

    /// Adds values of the symmetric matrix.
    pub fn add_near(&mut self, offset: usize, values: &[f64]) {
        self.near.add(offset, values);
    }

    /// The store of the matrix itself.
    pub fn matrix(&self) -> &SparseStore {
        if self.symmetry == Symmetry::General { &self.whole } else { &self.near }
    }

    /// Makes what the solve needs. Returns the number of factorisations, and true if LU had to replace Cholesky.
    pub fn factor(&mut self) -> Result<(usize, bool), FemError> {
        if self.symmetry != Symmetry::General {
            return Ok((1, self.near.factor(self.symmetry)?));
        }
        if self.factored {
            self.whole.factor(Symmetry::General)?;
            return Ok((1, false));
        }
        if !self.renewal.due {
            return Ok((0, false));
        }
        match self.near.factor(Symmetry::Positive) {
            Ok(_) => self.renewal.done(),
            // Softening: the matrix itself decides, and the next one is tried anew.
            Err(FemError::Direct(DirectError::NotPositive(_))) if self.admits_lu() => {
                self.whole.factor(Symmetry::General)?;
                self.exact = true;
            }
            Err(error) => return Err(error),
        }
        Ok((1, false))
    }

    /// Iterations that cost as much as a factorisation.
    fn worth(&self) -> usize {
        self.near.cholesky().map_or(usize::MAX, |symbolic| {
            (symbolic.operations() / (FACTORISATION_RATE * 4.0 * symbolic.stored() as f64)) as usize
        })
    }

    /// True if memory suffices for LU.
    fn admits_lu(&self) -> bool {
        self.near.cholesky().is_some_and(|symbolic| symbolic.bytes() <= self.memory / UNSYMMETRIC)
    }

    /// Solves in place; `None` without a matrix. With `again` the caller can assemble and solve again, which
    /// [`Solution::Distant`] asks for.
    pub fn solve(&mut self, rhs: &mut [f64], again: bool) -> Result<Option<Solution>, FemError> {
        if self.symmetry != Symmetry::General {
            return Ok(self.near.solve(rhs).then_some(Solution::Direct));
        }
        if self.factored || self.exact {
            return Ok(self.whole.solve(rhs).then_some(Solution::Direct));
        }
        let Some(map) = &self.whole.map else { return Ok(None) };
        let load = rhs.to_vec();
        let worth = self.worth();
        let bounds = if again { self.renewal.bounds(BOUNDS, worth) } else { BOUNDS };
        let outcome = gmres::solve(&mut System { map, near: &self.near }, rhs, bounds);
        if self.renewal.note(&outcome, bounds, worth) {
            rhs.copy_from_slice(&load);
            return Ok(Some(Solution::Distant { outcome }));
        }
        if outcome.report().euclidean <= USEFUL {
            return Ok(Some(Solution::Iterated { outcome, made: 0 }));
        }
        if !self.admits_lu() {
            return Err(FemError::NotConverged(outcome));
        }
        rhs.copy_from_slice(&load);
        self.factored = true;
        self.whole.factor(Symmetry::General)?;
        Ok(self.whole.solve(rhs).then_some(Solution::Iterated { outcome, made: 1 }))
    }
}

/// The matrix with its preconditioner.
struct System<'a> {
    map: &'a ScatterMap,
    near: &'a SparseStore,
}

impl PreconditionedSystem for System<'_> {
    fn multiply(&mut self, x: &[f64], y: &mut [f64]) {
        multiply(self.map.matrix(), x, y);
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.near.solve(r);
    }
}

/// `y = A x`, column by column.
fn multiply(matrix: SparseColMatRef<'_, usize, f64>, x: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    for (col, x) in x.iter().enumerate() {
        for (row, value) in matrix.row_idx_of_col(col).zip(matrix.val_of_col(col)) {
            y[row] += value * x;
        }
    }
}
