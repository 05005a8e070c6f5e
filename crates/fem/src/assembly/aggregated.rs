//! An unsymmetric sparse system solved by GMRES where factors do not fit into memory, or take long. Smoothed aggregation of a symmetric matrix
//! near it is the preconditioner, made at the first solve of a step and kept for as long as it costs less than another.
//!
//! Interfaces are part of the levels. Closed points couple more strongly than cells, so that a node and its partners across the
//! interface form an aggregate, in which penalties of any size do no work.

use super::iterative::{Iterative, NearNull};
use super::renewal::Renewal;
use super::solution::{Solution, USEFUL};
use crate::dof::Equations;
use crate::error::FemError;
use crate::iterative::cg::Preconditioner;
use crate::iterative::csr::BlockCsr;
use crate::iterative::dense::Block;
use crate::iterative::gmres::{self, Bounds, PreconditionedSystem};
use crate::iterative::matrix::Assembly;
use crate::iterative::smoothed_aggregation::{Cycle, Hierarchy, Settings};
use crate::term::{Pattern, PatternId};
use std::fmt::Debug;

/// Largest number of vectors of a basis. So many take the memory of a matrix of hexahedra.
const RESTART: usize = 60;
/// Iterations in the time in which levels are made: 20 to 25 with 250 000 unknowns.
const WORTH: usize = 20;

/// A system with any number of components of a node.
pub(super) trait AggregatedSystem: Debug + Send {
    /// The next matrix is that of another step, whose preconditioner depends on nothing before it.
    fn begin_step(&mut self);

    /// Forgets the levels.
    fn forget(&mut self);

    /// True if the next assembly needs the values of the symmetric matrix as well.
    fn is_due(&self) -> bool;

    /// Sets the matrix of a term, in the order of the terms.
    fn set(&mut self, term: usize, tangent: Tangent<'_>, equations: &Equations) -> Result<(), FemError>;

    /// Sets the symmetric matrix near that of a term.
    fn set_near(&mut self, term: usize, values: &[f64]);

    /// Makes the levels if they are due. Returns how many times.
    fn finish(&mut self, equations: &Equations) -> Result<usize, FemError>;

    /// Solves in place; `None` without a matrix. With `again` the caller can assemble and solve again, which
    /// [`Solution::Distant`] asks for.
    fn solve(&mut self, rhs: &mut [f64], again: bool) -> Result<Option<Solution>, FemError>;
}

/// Tangent of a term.
pub(super) struct Tangent<'a> {
    pub pattern: &'a Pattern,
    pub values: &'a [f64],
    /// True if it is the same at every state and in every step.
    pub constant: bool,
}

/// A system with these settings.
pub(super) fn system(iterative: Iterative) -> Box<dyn AggregatedSystem> {
    let Iterative { near_null, tolerance, most_iterations } = iterative;
    let bounds = Bounds { tolerance, restart: RESTART, most_iterations, paced: false };
    match near_null {
        NearNull::Antiplane(modes) => Box::new(AggregatedStore::new(modes, bounds)),
        NearNull::Plane(modes) => Box::new(AggregatedStore::new(modes, bounds)),
        NearNull::Spatial(modes) => Box::new(AggregatedStore::new(modes, bounds)),
    }
}

/// Matrix of a term.
#[derive(Debug)]
struct TermMatrix<const D: usize> {
    id: PatternId,
    /// Destinations of values, unless these are constant.
    assembly: Option<Assembly<D>>,
    matrix: BlockCsr<D, D>,
    /// The symmetric matrix near it, until the levels are made.
    near: Option<BlockCsr<D, D>>,
}

#[derive(Debug)]
struct AggregatedStore<const D: usize, const K: usize> {
    modes: Vec<Block<D, K>>,
    bounds: Bounds,
    terms: Vec<TermMatrix<D>>,
    hierarchy: Option<Hierarchy<D, K>>,
    /// Degree of freedom of each equation.
    free: Vec<usize>,
    renewal: Renewal,
}

impl<const D: usize, const K: usize> AggregatedStore<D, K> {
    fn new(modes: Vec<Block<D, K>>, bounds: Bounds) -> Self {
        let (terms, free, renewal) = (Vec::new(), Vec::new(), Renewal::new());
        Self { modes, bounds, terms, hierarchy: None, free, renewal }
    }

    /// Rigid motions in the free components of nodes, and whether a node has any.
    fn free_modes(&self) -> (Vec<Block<D, K>>, Vec<bool>) {
        let mut modes = vec![[[0.0; K]; D]; self.modes.len()];
        let mut active = vec![false; modes.len()];
        for &dof in &self.free {
            let (node, component) = (dof / D, dof % D);
            modes[node][component] = self.modes[node][component];
            active[node] = true;
        }
        (modes, active)
    }
}

impl<const D: usize, const K: usize> AggregatedSystem for AggregatedStore<D, K> {
    fn begin_step(&mut self) {
        self.renewal.due = true;
    }

    fn forget(&mut self) {
        self.hierarchy = None;
        self.begin_step();
    }

    fn is_due(&self) -> bool {
        self.renewal.due
    }

    fn set(&mut self, term: usize, tangent: Tangent<'_>, equations: &Equations) -> Result<(), FemError> {
        let Tangent { pattern, values, constant } = tangent;
        match self.terms.get_mut(term).filter(|known| known.id == pattern.id()) {
            Some(TermMatrix { assembly: None, .. }) if constant => return Ok(()),
            Some(TermMatrix { assembly: Some(assembly), matrix, .. }) => {
                assembly.assemble_into(&[values], matrix);
                return Ok(());
            }
            _ => {}
        }
        let assembly = Assembly::new(&[pattern], equations)?;
        let matrix = assembly.assemble(&[values]);
        let assembly = (!constant).then_some(assembly);
        let own = TermMatrix { id: pattern.id(), assembly, matrix, near: None };
        match self.terms.get_mut(term) {
            Some(known) => *known = own,
            None => self.terms.push(own),
        }
        Ok(())
    }

    fn set_near(&mut self, term: usize, values: &[f64]) {
        let own = &mut self.terms[term];
        own.near = own.assembly.as_ref().map(|assembly| assembly.assemble(&[values]));
    }

    fn finish(&mut self, equations: &Equations) -> Result<usize, FemError> {
        if !self.renewal.due {
            return Ok(0);
        }
        self.free.clone_from(&equations.free);
        self.hierarchy = None;
        let near: Vec<_> = self.terms.iter().map(|t| t.near.as_ref().unwrap_or(&t.matrix)).collect();
        let matrix = BlockCsr::sum(&near);
        self.terms.iter_mut().for_each(|t| t.near = None);
        let (modes, active) = self.free_modes();
        self.hierarchy = Some(Hierarchy::new(matrix, &modes, &active, Settings::default())?);
        self.renewal.done();
        Ok(1)
    }

    fn solve(&mut self, rhs: &mut [f64], again: bool) -> Result<Option<Solution>, FemError> {
        let Some(hierarchy) = &self.hierarchy else { return Ok(None) };
        let nodes = self.modes.len();
        let mut system = System {
            terms: &self.terms,
            free: &self.free,
            cycle: hierarchy.cycle(),
            x: vec![[0.0; D]; nodes],
            y: vec![[0.0; D]; nodes],
        };
        let load = rhs.to_vec();
        let bounds = if again { self.renewal.bounds(self.bounds, WORTH) } else { self.bounds };
        let outcome = gmres::solve(&mut system, rhs, bounds);
        if self.renewal.note(&outcome, bounds, WORTH) {
            rhs.copy_from_slice(&load);
            return Ok(Some(Solution::Distant { outcome }));
        }
        if outcome.report().euclidean > USEFUL.max(bounds.tolerance) {
            return Err(FemError::NotConverged(outcome));
        }
        Ok(Some(Solution::Iterated { outcome, made: 0 }))
    }
}

/// The matrix with its preconditioner, and working vectors over all nodes.
struct System<'a, const D: usize, const K: usize> {
    terms: &'a [TermMatrix<D>],
    free: &'a [usize],
    cycle: Cycle<'a, D, K>,
    x: Vec<[f64; D]>,
    y: Vec<[f64; D]>,
}

impl<const D: usize, const K: usize> System<'_, D, K> {
    /// Puts values of the equations to their nodes. Fixed components stay zero.
    fn spread(&mut self, v: &[f64]) {
        self.free.iter().zip(v).for_each(|(&dof, &v)| self.x[dof / D][dof % D] = v);
    }

    /// Takes values of the equations from their nodes.
    fn gather(&self, v: &mut [f64]) {
        self.free.iter().zip(v).for_each(|(&dof, v)| *v = self.y[dof / D][dof % D]);
    }
}

impl<const D: usize, const K: usize> PreconditionedSystem for System<'_, D, K> {
    fn multiply(&mut self, x: &[f64], y: &mut [f64]) {
        self.spread(x);
        self.y.fill([0.0; D]);
        self.terms.iter().for_each(|term| term.matrix.multiply_add(&self.x, &mut self.y));
        self.gather(y);
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.spread(r);
        self.cycle.apply(&self.x, &mut self.y);
        self.gather(r);
    }
}
