//! Memory of a run.

use crate::forecast::Counts;
use crate::model::counts;
use asperity_mechanics::{CellBlock, Model};

/// Bytes of the program with its libraries, and of its tables and plots: the smallest scenes take 12 MB without plots and 38 MB with them.
const PROGRAM: usize = 38_000_000;
/// Bytes of the buffers in which dense kernels pack what they multiply, for each thread.
const PACKED: usize = 10_000_000;

/// Memory of a model when it is run \[bytes\].
#[derive(Clone, Copy, Debug)]
pub struct Held {
    /// Its mesh.
    mesh: usize,
    /// The matrices of its linear cells and their degrees of freedom.
    stiffness: usize,
    /// Geometry of its linear cells.
    geometry: usize,
    /// Cells that are not linear, with their histories, which a run has a copy of, and their matrices in turn.
    nonlinear: usize,
}

impl Held {
    /// Of a model, whether its cells have matrices yet or not.
    #[must_use]
    pub fn by<const D: usize>(model: &Model<D>) -> Self {
        let counts = counts(&model.mesh);
        let of = |bytes: &dyn Fn(&Counts) -> f64, linear: bool| -> usize {
            let blocks = counts.iter().zip(&model.blocks);
            blocks.filter(|(_, b)| b.linear().is_some() == linear).map(|(c, _)| bytes(c)).sum::<f64>()
                as usize
        };
        let stiffness = |c: &Counts| c.stiffness_bytes(model.idealisation.components());
        let histories: usize = model.blocks.iter().map(CellBlock::history_bytes).sum();
        Self {
            mesh: counts.iter().map(Counts::mesh_bytes).sum::<f64>() as usize,
            stiffness: of(&stiffness, true),
            geometry: of(&|c| c.geometry_bytes(model.idealisation), true),
            nonlinear: 2 * histories + of(&stiffness, false),
        }
    }

    /// With bodies and interfaces whose linear systems take so much. Condensation works on a copy of the matrices.
    #[must_use]
    pub fn with_systems(&self, solver: usize, condensed: bool) -> usize {
        let copies = if condensed { 2 } else { 1 };
        PROGRAM + self.mesh + copies * self.stiffness + self.geometry + self.nonlinear + solver
    }

    /// With faults, onto which bodies are condensed in so much. Jumps are taken on a copy of the matrices, and what small pieces left is not
    /// given back to the system before the elimination.
    #[must_use]
    pub fn with_faults(&self, condensation: usize) -> usize {
        let threads = rayon::current_num_threads();
        PROGRAM + threads * PACKED + self.mesh + self.stiffness + self.stiffness.max(condensation)
    }
}
