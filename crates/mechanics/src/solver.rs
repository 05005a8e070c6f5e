//! Choice of the solver of the steps' linear systems, symmetry of their matrices, and extent of condensation.

use super::interface::{Measure, PlannedInterface, interface_nodes};
use super::{CellBlock, Model, Stage, Stepping};
use asperity_contact::Sliding;
use asperity_fem::assembly::{Analysis, Symmetry};
use asperity_fem::condense;

/// Solver of the linear systems of the steps.
#[derive(Debug)]
pub struct Solver {
    /// Method.
    pub method: Method,
    /// Memory that a factorisation may use \[bytes\].
    pub memory: usize,
    /// Analyses from which the memory was predicted.
    pub prepared: Analyses,
    /// Predicted memory of the method \[bytes\].
    pub bytes: usize,
    /// Operations of a factorisation of the system in each iteration; `None` if they are not known in advance, or one factorisation serves many steps.
    pub operations: Option<f64>,
    /// Reason for the choice of this method.
    pub why: String,
}

/// Methods of solving linear systems.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Dense factorisation of the condensed system.
    Dense,
    /// Compliance of the pairs of the condensed system: a dense factor of some iterations, GMRES with it in the others.
    Flexibility,
    /// Sparse factorisation.
    Sparse,
    /// The same where the matrix is symmetric; where it is not, GMRES preconditioned by the Cholesky factor of a symmetric matrix near it.
    Preconditioned,
    /// GMRES preconditioned with smoothed aggregation of a symmetric matrix near the tangent.
    Aggregated {
        /// True if its Cholesky factor fits into memory, and takes over for the rest of a step in which iterations fail.
        factors: bool,
        /// Residual over the load at which a solution is accepted.
        tolerance: f64,
        /// Iterations after which the solution is abandoned.
        most_iterations: usize,
    },
    /// Conjugate gradients preconditioned with smoothed aggregation.
    Iterative {
        /// Relative residual at which a solution is accepted.
        tolerance: f64,
        /// Iterations after which the solution is abandoned.
        most_iterations: usize,
    },
}

/// Symbolic analyses for the degrees of freedom fixed in the first stage.
#[derive(Debug)]
pub enum Analyses {
    /// No analysis.
    Nothing,
    /// Analyses of the bodies, for condensation.
    Bodies(Vec<condense::Analysis>),
    /// Analysis of the system of all bodies, without interfaces.
    System(Analysis),
}

/// Symmetry of the tangents in a stage; this is the only place that decides it. Bodies report the symmetry of their tangents.
/// Contact that is tied or without a law has a symmetric tangent. Friction couples shear traction to normal traction in one
/// direction only. Mortar contact that follows the motion is unsymmetric: its forces are averages of the pressure and not the
/// gradient of an energy of gaps. Multipliers that are unknowns have zeros on the diagonal, for which a Cholesky factorisation
/// always fails.
#[must_use]
pub fn symmetry<const D: usize>(
    model: &Model<D>,
    interfaces: &[PlannedInterface],
    stepping: &Stepping,
    stage: &Stage,
) -> Symmetry {
    let forward = stepping.is_forward();
    let of_block = |block: &CellBlock<D>| match block {
        CellBlock::Linear(_) => true,
        CellBlock::Nonlinear(b) if forward => b.model().symmetric_rate(),
        CellBlock::Nonlinear(b) => b.model().symmetric_tangent(),
    };
    let friction = |i: &PlannedInterface| {
        i.law.as_ref().is_some_and(|l| !l.bonded()) && !stage.frictionless.contains(&i.name)
    };
    let general = |i: &PlannedInterface| friction(i) || moving_mortar(i) || i.unknowns > 0;
    if !model.blocks.iter().all(of_block) || interfaces.iter().any(general) {
        Symmetry::General
    } else if interfaces.is_empty() && model.is_linear() {
        Symmetry::Positive
    } else {
        Symmetry::Symmetric
    }
}

/// True for mortar contact over an overlap that follows the motion.
#[must_use]
pub fn moving_mortar(i: &PlannedInterface) -> bool {
    i.measure == Measure::Mortar && i.sliding == Sliding::Finite
}

/// Degrees of freedom of interfaces and of sets on springs that each body retains in condensation, in mesh numbering.
#[must_use]
pub fn retained<const D: usize>(
    model: &Model<D>,
    interfaces: &[PlannedInterface],
    stages: &[Stage],
) -> Vec<Vec<usize>> {
    let components = model.idealisation.components();
    let pulled = stages.iter().flat_map(|s| &s.springs).flat_map(|s| &s.dofs).map(|d| d / components);
    let mut nodes: Vec<usize> = interfaces.iter().flat_map(interface_nodes).chain(pulled).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let of_body = |own: &std::ops::Range<usize>| {
        let kept = nodes.iter().filter(|n| own.contains(n));
        kept.flat_map(|&n| (0..components).map(move |c| n * components + c)).collect()
    };
    model.bodies.iter().map(|b| of_body(&b.nodes)).collect()
}

/// Members of a sorted list that lie in `dofs`, relative to its start.
#[must_use]
pub fn local(list: &[usize], dofs: &std::ops::Range<usize>) -> Vec<usize> {
    list.iter().filter(|d| dofs.contains(d)).map(|d| d - dofs.start).collect()
}
