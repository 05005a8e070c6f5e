//! Numbering of degrees of freedom in the system of a step.

use crate::Model;
use asperity_fem::dof::{Channel, Constraints};

/// Number assigned to degrees of freedom that are condensed out.
const NONE: usize = usize::MAX;

/// Relation of the degrees of freedom of the system to those of the mesh.
pub struct Numbering {
    /// System number of each degree of freedom of the mesh.
    pub number: Vec<usize>,
    /// Mesh node of each node of the system.
    pub nodes: Vec<usize>,
    /// Number of degrees of freedom of the system.
    pub dofs: usize,
}

impl Numbering {
    /// Numbering of all degrees of freedom, as in the mesh.
    #[must_use]
    pub fn full<const D: usize>(model: &Model<D>) -> Self {
        let dofs = model.dofs();
        Self { number: (0..dofs).collect(), nodes: (0..model.mesh.nodes.len()).collect(), dofs }
    }

    /// Numbering of the degrees of freedom `retained` in condensation, which are given in mesh numbering.
    #[must_use]
    pub fn condensed<const D: usize>(model: &Model<D>, retained: &[Vec<usize>]) -> Self {
        let mut number = vec![NONE; model.dofs()];
        let mut dofs = 0;
        for &dof in retained.iter().flatten() {
            number[dof] = dofs;
            dofs += 1;
        }
        let components = model.idealisation.components();
        let nodes = retained.iter().flatten().step_by(components).map(|d| d / components).collect();
        Self { number, nodes, dofs }
    }

    /// Prescribed values of the system for these constraints. Forces are left out, since they act on the bodies.
    #[must_use]
    pub fn constraints(&self, constraints: &Constraints) -> Constraints {
        let map = |dof: usize| Some(self.number[dof]).filter(|&n| n != NONE);
        let mut fixed: Vec<usize> = constraints.fixed.iter().filter_map(|&d| map(d)).collect();
        fixed.sort_unstable();
        let prescribed = |c: &Channel| Channel {
            prescribed: c.prescribed.iter().filter_map(|&(d, v)| map(d).map(|n| (n, v))).collect(),
            forces: Vec::new(),
            amplitude: c.amplitude.clone(),
        };
        Constraints { fixed, channels: constraints.channels.iter().map(prescribed).collect() }
    }
}
