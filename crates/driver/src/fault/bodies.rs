//! Bodies around faults, as needed by the output.

use crate::model::Model;
use asperity_cycles::medium::Bodies;

/// Bodies around faults, as needed by the output.
#[derive(Debug)]
pub struct BodiesView {
    /// Source of their displacements.
    pub bodies: Bodies,
    /// Positions of all nodes \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Nodes on the minus and the plus side of each freely sliding point.
    pub sides: Vec<[usize; 2]>,
    /// True if their displacements are written.
    pub shown: bool,
    /// VTK cell type and nodes of each cell.
    pub(super) cells: Vec<(u8, Vec<usize>)>,
}

impl BodiesView {
    pub(super) fn new<const D: usize>(
        bodies: Bodies,
        model: &Model<D>,
        sides: Vec<[usize; 2]>,
        shown: bool,
    ) -> Self {
        let blocks = model.bodies.iter().flat_map(|body| &model.mesh.blocks[body.blocks.clone()]);
        let cells = blocks.flat_map(|block| {
            let cells = block.connectivity.chunks_exact(block.kind.nodes());
            cells.map(|cell| (block.kind.vtk_type(), cell.to_vec()))
        });
        let place = |x: &[f64; D]| std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0));
        Self {
            bodies,
            nodes: model.mesh.nodes.iter().map(place).collect(),
            sides,
            shown,
            cells: cells.collect(),
        }
    }
}
