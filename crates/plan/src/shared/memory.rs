//! Memory of a run.

use crate::shared::model::counts;
use crate::shared::model::forecast::{self, Counts};
use asperity_mechanics::{CellBlock, Model};

/// Bytes of the program with its libraries, tables and plots. The smallest scenes take 12 MB without plots and 38 MB with them.
const PROGRAM: usize = 38_000_000;
/// Bytes of figures of bodies beyond those of the smallest scenes: with figures `sandwich.toml`, `hertz.toml` and `sandwich-3d.toml` take 24 to 32 MB
/// more than without, and at times 50.
const FIGURES: usize = 17_000_000;
/// Bytes per thread of the buffers in which dense kernels pack their operands.
const PACKED: usize = 10_000_000;

/// Total of a run of faults without bodies whose operator takes `operator` bytes while it is made.
#[must_use]
pub fn without_bodies(operator: usize) -> usize {
    PROGRAM + operator
}

/// Bytes of a number.
const NUMBER: usize = 8;

/// Memory of a model during a run \[bytes\].
#[derive(Clone, Copy, Debug)]
pub struct ModelMemory {
    /// The mesh.
    mesh: usize,
    /// Matrices of linear cells, with their degrees of freedom.
    stiffness: usize,
    /// Geometry of its linear cells.
    geometry: usize,
    /// Histories of nonlinear cells, of which a run holds a copy.
    histories: usize,
    /// Matrices of nonlinear cells.
    tangents: usize,
}

impl ModelMemory {
    /// Memory of a model, whose cells need not have matrices yet.
    #[must_use]
    pub fn new<const D: usize>(model: &Model<D>) -> Self {
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
            histories: 2 * histories,
            tangents: of(&stiffness, false),
        }
    }

    /// Total of a run with bodies and interfaces whose linear systems take `solver` bytes. Condensation works on a copy
    /// of the matrices.
    #[must_use]
    pub fn with_systems(&self, solver: usize, condensed: bool) -> usize {
        let copies = if condensed { 2 } else { 1 };
        PROGRAM
            + FIGURES
            + self.mesh
            + copies * self.stiffness
            + self.geometry
            + self.histories
            + self.tangents
            + solver
    }

    /// Total of a run in explicit steps, which keep `numbers` of the cells and build no matrices of those with a history.
    #[must_use]
    pub fn in_steps(&self, numbers: usize, dofs: usize) -> usize {
        PROGRAM + forecast::in_steps(self.mesh, dofs) + NUMBER * numbers + self.histories
    }

    /// Total of a run with faults, onto which bodies are condensed in `condensation` bytes. Displacement jumps are introduced on a copy of the
    /// matrices, and freed small allocations are not returned to the system before the elimination.
    #[must_use]
    pub fn with_faults(&self, condensation: usize) -> usize {
        let threads = rayon::current_num_threads();
        PROGRAM + threads * PACKED + self.mesh + self.stiffness + self.stiffness.max(condensation)
    }
}
