//! A system solved by conjugate gradients with smoothed aggregation.

use crate::dof::Equations;
use crate::error::FemError;
use crate::iterative::dense::Block;
use crate::iterative::smoothed_aggregation::Settings;
use crate::iterative::{Method, Solver, near_null};
use crate::outcome::Outcome;
use crate::term::Pattern;
use std::fmt::Debug;

/// Displacement fields without strain, for each number of components of a node.
#[derive(Clone, Debug)]
pub enum NearNull {
    /// One component.
    Antiplane(Vec<Block<1, 1>>),
    /// Two components.
    Plane(Vec<Block<2, 3>>),
    /// Three components.
    Spatial(Vec<Block<3, 6>>),
}

impl NearNull {
    /// The rigid motions of nodes in `D` dimensions with `components` degrees of freedom each; `None` for other numbers of
    /// components.
    #[must_use]
    pub fn new<const D: usize>(nodes: &[[f64; D]], components: usize) -> Option<Self> {
        Some(match (components, D) {
            (1, _) => Self::Antiplane(near_null::constant(nodes.len())),
            (2, 2) => Self::Plane(near_null::plane(&nodes.iter().map(|x| [x[0], x[1]]).collect::<Vec<_>>())),
            (3, 3) => Self::Spatial(near_null::spatial(
                &nodes.iter().map(|x| [x[0], x[1], x[2]]).collect::<Vec<_>>(),
            )),
            _ => return None,
        })
    }
}

/// Settings of the iterative method.
#[derive(Clone, Debug)]
pub struct Iterative {
    /// Rigid motions.
    pub near_null: NearNull,
    /// Relative preconditioned residual at which a solution is accepted, see
    /// [`Report::residual`](crate::iterative::Report::residual).
    pub tolerance: f64,
    /// Iterations after which the solution is abandoned.
    pub most_iterations: usize,
}

/// A [`Solver`] with any number of components.
trait SystemSolver: Debug + Send {
    fn set(
        &mut self,
        patterns: &[&Pattern],
        values: &[&[f64]],
        equations: &Equations,
    ) -> Result<(), FemError>;

    /// `None` without a matrix.
    fn solve(&self, rhs: &mut [f64], tolerance: f64, limit: usize) -> Option<Outcome>;
}

#[derive(Debug)]
struct StoredSolver<const D: usize, const K: usize> {
    modes: Vec<Block<D, K>>,
    solver: Option<Solver<D, K>>,
}

impl<const D: usize, const K: usize> SystemSolver for StoredSolver<D, K> {
    fn set(
        &mut self,
        patterns: &[&Pattern],
        values: &[&[f64]],
        equations: &Equations,
    ) -> Result<(), FemError> {
        self.solver = Some(match self.solver.take().filter(|s| s.fits(patterns)) {
            Some(solver) => solver.renewed(values)?,
            None => {
                let method = Method::SmoothedAggregation(Settings::default());
                Solver::new(patterns, values, equations, self.modes.clone(), method)?
            }
        });
        Ok(())
    }

    fn solve(&self, rhs: &mut [f64], tolerance: f64, limit: usize) -> Option<Outcome> {
        let solver = self.solver.as_ref()?;
        let mut x = vec![0.0; rhs.len()];
        let outcome = solver.solve_within(&mut x, rhs, tolerance, limit);
        rhs.copy_from_slice(&x);
        Some(outcome)
    }
}

#[derive(Debug)]
pub(super) struct IterativeStore {
    solver: Box<dyn SystemSolver>,
    tolerance: f64,
    most_iterations: usize,
}

impl IterativeStore {
    pub fn new(iterative: Iterative) -> Self {
        let Iterative { near_null, tolerance, most_iterations } = iterative;
        let solver: Box<dyn SystemSolver> = match near_null {
            NearNull::Antiplane(modes) => Box::new(StoredSolver { modes, solver: None }),
            NearNull::Plane(modes) => Box::new(StoredSolver { modes, solver: None }),
            NearNull::Spatial(modes) => Box::new(StoredSolver { modes, solver: None }),
        };
        Self { solver, tolerance, most_iterations }
    }

    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    pub fn set(
        &mut self,
        patterns: &[&Pattern],
        values: &[&[f64]],
        equations: &Equations,
    ) -> Result<(), FemError> {
        self.solver.set(patterns, values, equations)
    }

    /// Solves in place. `None` without a matrix.
    pub fn solve(&self, rhs: &mut [f64]) -> Option<Outcome> {
        self.solver.solve(rhs, self.tolerance, self.most_iterations)
    }
}
