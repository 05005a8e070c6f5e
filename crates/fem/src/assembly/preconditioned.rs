//! A sparse unsymmetric system solved by GMRES. The factor of a symmetric matrix near it, made at the first solve of a step, is
//! the preconditioner of all solves of that step.
//!
//! Friction makes a tangent unsymmetric in the rows of points that slip, which are few, and an iteration of Newton's method
//! changes little else. A Cholesky factor costs a fraction of LU, of which half is kept.

use super::Analysis;
use super::direct::SparseStore;
use super::symmetry::Symmetry;
use crate::dof::Equations;
use crate::error::FemError;
use crate::iterative::gmres::{self, Bounds, PreconditionedSystem};
use crate::multifrontal::DirectError;
use crate::outcome::Outcome;
use crate::sparse::ScatterMap;
use crate::term::Pattern;
use faer::sparse::SparseColMatRef;

/// Bounds of a solution. Newton's method, whose residual falls by the tolerance at best, takes as many iterations with 1e-5 as with
/// exact directions while pairs and plastic points change, and one more at its end; smaller ones cost more than they save.
const BOUNDS: Bounds = Bounds { tolerance: 1e-5, restart: 60, most_iterations: 180 };
/// Residual over the load at which a solution is a direction for Newton's method, which judges by the residual it leads to.
const USEFUL: f64 = 1e-3;
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
    /// True if the preconditioner is to be made from the next matrix.
    due: bool,
    /// True if the matrix is factored as it is, since no preconditioner could be made for the step.
    factored: bool,
    /// Iterations of the first solution with the preconditioner.
    fresh: Option<usize>,
    /// Iterations that later solutions took beyond it.
    excess: usize,
}

impl PreconditionedStore {
    pub fn new(memory: usize, analysis: Option<Analysis>) -> Self {
        let mut near = SparseStore::default();
        near.prepare(memory, analysis);
        let (whole, symmetry) = (SparseStore::default(), Symmetry::General);
        Self { whole, near, memory, symmetry, due: true, factored: false, fresh: None, excess: 0 }
    }

    /// Forgets patterns and factors.
    pub fn forget(&mut self) {
        self.whole.forget();
        self.near.forget();
        self.begin_step();
    }

    /// The next matrix is that of another step, whose preconditioner depends on nothing before it.
    pub fn begin_step(&mut self) {
        (self.due, self.factored) = (true, false);
    }

    /// True if the next assembly needs the values of the symmetric matrix as well.
    pub fn is_due(&self) -> bool {
        self.due && self.symmetry == Symmetry::General
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
        self.whole.renew(patterns, equations, symmetry)?;
        self.whole.clear();
        if self.due {
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
    pub fn exact(&self) -> &SparseStore {
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
        if !self.due {
            return Ok((0, false));
        }
        let made = match self.near.factor(Symmetry::Positive) {
            Ok(_) => 1,
            // Softening: the matrix itself decides.
            Err(FemError::Direct(DirectError::NotPositive(_))) if self.admits_lu() => {
                self.whole.factor(Symmetry::General)?;
                self.factored = true;
                1
            }
            Err(error) => return Err(error),
        };
        (self.due, self.fresh, self.excess) = (false, None, 0);
        Ok((made, false))
    }

    /// Notes the iterations of a solution. What they exceed the first by adds up; once it has cost as much as a factorisation, another
    /// is made, so that the whole costs at most twice what it would have cost with the best choice.
    fn count(&mut self, iterations: usize) {
        let fresh = *self.fresh.get_or_insert(iterations);
        self.excess += iterations.saturating_sub(fresh);
        let worth = self.near.cholesky().map_or(f64::INFINITY, |symbolic| {
            symbolic.operations() / (FACTORISATION_RATE * 4.0 * symbolic.stored() as f64)
        });
        self.due = self.excess as f64 > worth;
    }

    /// True if memory suffices for LU.
    fn admits_lu(&self) -> bool {
        self.near.cholesky().is_some_and(|symbolic| symbolic.bytes() <= self.memory / UNSYMMETRIC)
    }

    /// Solves in place. `None` without a matrix; the second value is the number of factorisations made.
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<Option<(Option<Outcome>, usize)>, FemError> {
        if self.symmetry != Symmetry::General {
            return Ok(self.near.solve(rhs).then_some((None, 0)));
        }
        if self.factored {
            return Ok(self.whole.solve(rhs).then_some((None, 0)));
        }
        let Some(map) = &self.whole.map else { return Ok(None) };
        let load = rhs.to_vec();
        let outcome = gmres::solve(&System { map, near: &self.near }, rhs, BOUNDS);
        let report = outcome.report();
        self.count(report.iterations);
        if report.euclidean <= USEFUL {
            return Ok(Some((Some(outcome), 0)));
        }
        if !self.admits_lu() {
            return Err(FemError::NotConverged(outcome));
        }
        rhs.copy_from_slice(&load);
        self.factored = true;
        self.whole.factor(Symmetry::General)?;
        Ok(self.whole.solve(rhs).then_some((Some(outcome), 1)))
    }
}

/// The matrix with its preconditioner.
struct System<'a> {
    map: &'a ScatterMap,
    near: &'a SparseStore,
}

impl PreconditionedSystem for System<'_> {
    fn multiply(&self, x: &[f64], y: &mut [f64]) {
        multiply(self.map.matrix(), x, y);
    }

    fn precondition(&self, r: &mut [f64]) {
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
