//! Displacements of the bodies around faults: what slip and loads do there, by one solution with the factor of the condensation.

use crate::model::Model;
use asperity_fem::condense::Condensed;
use asperity_fem::jump::Jumps;

/// Displacements from unknowns of which some are jumps.
trait Jumping: Send + Sync + std::fmt::Debug {
    /// In place.
    fn displace(&self, unknowns: &mut [f64]);
}

impl<const C: usize> Jumping for Jumps<C> {
    fn displace(&self, unknowns: &mut [f64]) {
        self.displacement(unknowns);
    }
}

/// The condensed bodies, kept.
#[derive(Debug)]
pub struct Bodies {
    condensed: Condensed,
    /// Ties of sides that machines draw, then the faults: in the order in which they are undone.
    jumps: [Box<dyn Jumping>; 2],
    /// Retained unknown of the first component of slip of each point.
    rows: Vec<usize>,
    /// Components of displacement.
    components: usize,
}

impl Bodies {
    /// Of bodies with the jumps of their faults and the ties of sides that machines draw; `rows` are the retained unknowns of the first
    /// component of slip of each point.
    pub(super) fn new<const C: usize>(
        condensed: Condensed,
        jumps: Jumps<C>,
        ties: Jumps<1>,
        rows: Vec<usize>,
    ) -> Self {
        Self { condensed, jumps: [Box::new(ties), Box::new(jumps)], rows, components: C }
    }

    /// Displacements of all nodes \[m\], node by node, for slip of all points \[m\], component by component, openings after it where points may open, and the loads at
    /// `time` \[s\].
    #[must_use]
    pub fn displacement(&self, slip: &[f64], time: f64) -> Vec<f64> {
        let mut retained = vec![0.0; self.condensed.reduction().retained().len()];
        let n = self.rows.len();
        for (i, s) in slip.iter().enumerate() {
            retained[self.rows[i % n] + i / n] = *s;
        }
        let mut all = self.condensed.recover(&retained, time);
        self.jumps.iter().for_each(|jumps| jumps.displace(&mut all));
        all
    }

    /// The same in space.
    #[must_use]
    pub fn vectors(&self, slip: &[f64], time: f64) -> Vec<[f64; 3]> {
        let all = self.displacement(slip, time);
        let vector = |u: &[f64]| match u {
            // Antiplane motion.
            [z] => [0.0, 0.0, *z],
            _ => std::array::from_fn(|c| u.get(c).copied().unwrap_or(0.0)),
        };
        all.chunks_exact(self.components).map(vector).collect()
    }
}

/// Bodies as outputs see them.
#[derive(Debug)]
pub struct BodiesView {
    /// What gives their displacements.
    pub bodies: Bodies,
    /// Places of all nodes \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Nodes on the minus and on the plus side of each point that slides freely.
    pub sides: Vec<[usize; 2]>,
    /// VTK's type and nodes of all cells.
    pub(super) cells: Vec<(u8, Vec<usize>)>,
}

impl BodiesView {
    pub(super) fn new<const D: usize>(bodies: Bodies, model: &Model<D>, sides: Vec<[usize; 2]>) -> Self {
        let blocks = model.bodies.iter().flat_map(|body| &model.mesh.blocks[body.blocks.clone()]);
        let cells = blocks.flat_map(|block| {
            let cells = block.connectivity.chunks_exact(block.kind.nodes());
            cells.map(|cell| (block.kind.vtk_type(), cell.to_vec()))
        });
        let place = |x: &[f64; D]| std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0));
        Self { bodies, nodes: model.mesh.nodes.iter().map(place).collect(), sides, cells: cells.collect() }
    }
}
