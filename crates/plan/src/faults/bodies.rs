//! Bodies around faults, as needed by the output.

use crate::shared::model::Model;
use asperity_cycles::medium::Bodies;
use asperity_output::fields::vtu::Cell;

/// Bodies around faults, as needed by the output.
#[derive(Debug)]
pub struct BodiesView {
    /// Source of their displacements.
    pub bodies: Bodies,
    /// Positions of all nodes \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Nodes on the minus and the plus side of each freely sliding point.
    pub sides: Vec<[usize; 2]>,
    /// Rates of plates behind which the points lag, component by component \[m/s\]: zero without backslip.
    plates: Vec<f64>,
    /// True if their displacements are written.
    pub shown: bool,
    /// Cells.
    pub cells: Vec<Cell>,
}

/// Freely sliding points, which may lag behind plates.
pub(super) struct LaggingPoints {
    /// Nodes on the minus and the plus side of each.
    pub sides: Vec<[usize; 2]>,
    /// Rates of the plates, component by component \[m/s\]: zero without backslip.
    pub plates: Vec<f64>,
}

impl BodiesView {
    pub(super) fn new<const D: usize>(
        bodies: Bodies,
        model: &Model<D>,
        LaggingPoints { sides, plates }: LaggingPoints,
        shown: bool,
    ) -> Self {
        let blocks = model.bodies.iter().flat_map(|body| &model.mesh.blocks[body.blocks.clone()]);
        let cells = blocks.flat_map(|block| {
            let cells = block.connectivity.chunks_exact(block.kind.nodes());
            cells.map(|cell| Cell::new(block.kind.vtk_type(), cell.to_vec()))
        });
        let place = |x: &[f64; D]| std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0));
        Self {
            bodies,
            nodes: model.mesh.nodes.iter().map(place).collect(),
            sides,
            plates,
            shown,
            cells: cells.collect(),
        }
    }

    /// Mean position of the nodes of each cell, in the order of the cells of the bodies \[m\].
    #[must_use]
    pub fn middles(&self) -> Vec<[f64; 3]> {
        let middle = |Cell { points: nodes, .. }: &Cell| {
            let sum = |c: usize| nodes.iter().map(|&n| self.nodes[n][c]).sum::<f64>();
            std::array::from_fn(|c| sum(c) / nodes.len() as f64)
        };
        self.cells.iter().map(middle).collect()
    }

    /// Jumps to which the bodies are displaced at a time \[s\]: slip less the motion of plates behind which it lags, and openings \[m\].
    #[must_use]
    pub fn jumps(&self, [slip, opening]: [&[f64]; 2], time: f64) -> Vec<f64> {
        let lag = slip.iter().zip(&self.plates).map(|(slip, rate)| slip - rate * time);
        lag.chain(opening.iter().copied()).collect()
    }
}
