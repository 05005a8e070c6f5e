//! Iterative solution of symmetric positive definite elasticity: conjugate gradients preconditioned by smoothed aggregation or
//! block-Jacobi. It is for 3D models too large to factor.
//!
//! Degrees of freedom are `node * D + component`. Work is divided into pieces of fixed size, so that results have the same bits
//! for any number of threads.

pub mod block_jacobi;
pub mod cg;
pub mod csr;
pub mod dense;
pub mod gmres;
pub mod matrix;
pub mod near_null;
pub mod smoothed_aggregation;
pub mod vector;

use crate::dof::Equations;
use crate::error::FemError;
use crate::outcome::Outcome;
use crate::term::Pattern;
use block_jacobi::BlockJacobi;
use csr::BlockCsr;
use dense::Block;
use matrix::Assembly;
use smoothed_aggregation::{Hierarchy, LevelSize, Settings};

/// Iterations after which the solution is abandoned: several times the number needed in the hardest case of the benchmark with
/// block-Jacobi.
pub const MOST_ITERATIONS: usize = 20_000;

/// Method by which residuals are turned into corrections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Inverses of the node blocks: cheap to set up; iterations grow with the number of elements along the body.
    BlockJacobi,
    /// A V-cycle of smoothed aggregation: the number of iterations hardly grows.
    SmoothedAggregation(Settings),
}

/// A matrix of node blocks with its preconditioner. `D` unknowns per node, `K` near-null modes: [`Spatial`], [`Plane`],
/// [`Antiplane`].
#[derive(Clone, Debug)]
pub struct Solver<const D: usize, const K: usize> {
    assembly: Assembly<D>,
    /// Degree of freedom of each equation.
    free: Vec<usize>,
    nodes: usize,
    method: Method,
    state: State<D, K>,
}

/// Elasticity in 3D; near-null modes: [`near_null::spatial`].
pub type Spatial = Solver<3, 6>;
/// Elasticity in the plane; near-null modes: [`near_null::plane`].
pub type Plane = Solver<2, 3>;
/// One unknown per node; near-null modes: [`near_null::constant`].
pub type Antiplane = Solver<1, 1>;

#[derive(Clone, Debug)]
enum State<const D: usize, const K: usize> {
    Jacobi { matrix: BlockCsr<D, D>, jacobi: BlockJacobi<D> },
    Aggregation(Box<Hierarchy<D, K>>),
}

impl<const D: usize, const K: usize> Solver<D, K> {
    /// Assembles the matrix of `patterns` with `values` (one slice for each, as [`crate::term::Linearized::tangent`] writes them)
    /// and sets up the preconditioner. `near_null` has one block for each node: the displacement of each mode.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] if a pattern does not list whole nodes, or if the matrix is found not to be positive
    /// definite. The message then names the degree of freedom, or says that a body is free to move.
    pub fn new(
        patterns: &[&Pattern],
        values: &[&[f64]],
        equations: &Equations,
        near_null: Vec<Block<D, K>>,
        method: Method,
    ) -> Result<Self, FemError> {
        let assembly = Assembly::new(patterns, equations)?;
        let mut modes = near_null;
        for (block, free) in modes.iter_mut().zip(assembly.free()) {
            for (row, _) in block.iter_mut().zip(free).filter(|(_, free)| !**free) {
                *row = [0.0; K];
            }
        }
        let matrix = assembly.assemble(values);
        let state = match method {
            Method::BlockJacobi => State::Jacobi { jacobi: BlockJacobi::new(&matrix)?, matrix },
            Method::SmoothedAggregation(settings) => {
                let active: Vec<bool> = assembly.free().iter().map(|f| f.iter().any(|&f| f)).collect();
                State::Aggregation(Box::new(Hierarchy::new(matrix, &modes, &active, settings)?))
            }
        };
        Ok(Self { assembly, free: equations.free.clone(), nodes: modes.len(), method, state })
    }

    /// Replaces the values in the same patterns. The pattern of the matrix, the aggregates and their modes are kept; the
    /// strength of connection is not recomputed.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn renewed(self, values: &[&[f64]]) -> Result<Self, FemError> {
        let matrix = self.assembly.assemble(values);
        let state = match self.state {
            State::Jacobi { .. } => State::Jacobi { jacobi: BlockJacobi::new(&matrix)?, matrix },
            State::Aggregation(hierarchy) => State::Aggregation(Box::new(hierarchy.renewed(matrix)?)),
        };
        Ok(Self { state, ..self })
    }

    /// True if it was made for these patterns.
    #[must_use]
    pub fn fits(&self, patterns: &[&Pattern]) -> bool {
        self.assembly.fits(patterns)
    }

    /// The method it was made with.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// The matrix. Fixed degrees of freedom have only a diagonal.
    #[must_use]
    pub fn matrix(&self) -> &BlockCsr<D, D> {
        match &self.state {
            State::Jacobi { matrix, .. } => matrix,
            State::Aggregation(hierarchy) => &hierarchy.fine.matrix,
        }
    }

    /// Solves `K x = b` over the free equations, from the given x, until the preconditioned residual is `tolerance` times that
    /// of b (see [`Report::residual`]).
    pub fn solve(&self, x: &mut [f64], b: &[f64], tolerance: f64) -> Outcome {
        self.solve_within(x, b, tolerance, MOST_ITERATIONS)
    }

    /// As [`Solver::solve`], with at most `limit` iterations.
    pub fn solve_within(&self, x: &mut [f64], b: &[f64], tolerance: f64, limit: usize) -> Outcome {
        let (load, mut answer) = (self.in_blocks(b), self.in_blocks(x));
        let outcome = match &self.state {
            State::Jacobi { matrix, jacobi } => {
                cg::solve(matrix, &mut &*jacobi, &load, &mut answer, tolerance, limit)
            }
            State::Aggregation(h) => {
                cg::solve(&h.fine.matrix, &mut h.cycle(), &load, &mut answer, tolerance, limit)
            }
        };
        for (x, &dof) in x.iter_mut().zip(&self.free) {
            *x = answer[dof / D][dof % D];
        }
        outcome
    }

    /// `M⁻¹ r` over the free equations: one application of the preconditioner.
    #[must_use]
    pub fn precondition(&self, r: &[f64]) -> Vec<f64> {
        use cg::Preconditioner;
        let r = self.in_blocks(r);
        let mut z = vec![[0.0; D]; r.len()];
        match &self.state {
            State::Jacobi { jacobi, .. } => (&*jacobi).apply(&r, &mut z),
            State::Aggregation(h) => h.cycle().apply(&r, &mut z),
        }
        self.free.iter().map(|&dof| z[dof / D][dof % D]).collect()
    }

    fn in_blocks(&self, v: &[f64]) -> Vec<[f64; D]> {
        let mut blocks = vec![[0.0; D]; self.nodes];
        for (&v, &dof) in v.iter().zip(&self.free) {
            blocks[dof / D][dof % D] = v;
        }
        blocks
    }

    /// Sizes of the levels, finest first; of the matrix alone for block-Jacobi.
    #[must_use]
    pub fn levels(&self) -> Vec<LevelSize> {
        match &self.state {
            State::Jacobi { matrix, .. } => {
                vec![LevelSize { unknowns: matrix.rows() * D, entries: matrix.values.len() * D * D }]
            }
            State::Aggregation(hierarchy) => hierarchy.levels(),
        }
    }

    /// Memory held \[bytes\]: matrix, levels, and destinations of cell values.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.assembly.bytes()
            + size_of_val(self.free.as_slice())
            + match &self.state {
                State::Jacobi { matrix, jacobi } => matrix.bytes() + size_of_val(jacobi.inverses.as_slice()),
                State::Aggregation(hierarchy) => hierarchy.bytes(),
            }
    }
}
