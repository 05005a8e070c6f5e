//! Stresses of bodies that slip causes, on planes of one direction.

use super::bodies::BodiesView;
use super::coulomb::{Change, ReceiverPlane};
use asperity_mechanics::Model;

/// Cells that have stresses.
trait CellStresses: Send + Sync + std::fmt::Debug {
    /// Stress of each cell under displacements of all nodes \[m\], in the order of the cells of the bodies \[Pa\].
    fn stresses(&self, displacement: &[f64]) -> Vec<[f64; 6]>;
}

impl<const D: usize> CellStresses for Model<D> {
    fn stresses(&self, displacement: &[f64]) -> Vec<[f64; 6]> {
        let blocks = self.bodies.iter().flat_map(|body| &self.blocks[body.blocks.clone()]);
        let linear = blocks.filter_map(|block| block.linear());
        linear.flat_map(|block| block.cell_stress(displacement)).collect()
    }
}

/// Planes on which stresses of the cells of bodies are resolved.
#[derive(Debug)]
pub struct BodyStresses {
    /// Direction of the planes.
    pub plane: ReceiverPlane,
    cells: Box<dyn CellStresses>,
}

impl BodyStresses {
    pub(super) fn new<const D: usize>(plane: ReceiverPlane, model: Model<D>) -> Self {
        Self { plane, cells: Box::new(model) }
    }

    /// Mean stress of each cell \[Pa\], in the order of the cells of the bodies, and its parts on the planes, under slip of all
    /// points and their openings \[m\] without loads, which are zero at time 0.
    #[must_use]
    pub fn at(&self, view: &BodiesView, jumps: &[f64]) -> Vec<([f64; 6], Change)> {
        let stresses = self.cells.stresses(&view.bodies.displacement(jumps, 0.0));
        stresses.into_iter().map(|s| (s, self.plane.resolve(&s))).collect()
    }
}
