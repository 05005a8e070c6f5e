//! The largest stable step.

use super::Problem;
use crate::{CellBlock, Model};
use asperity_fem::FemError;
use asperity_fem::block::LinearBlock;
use asperity_fem::kinematics::Formulation;
use asperity_fem::matrix_free::{HighestFrequency, highest_frequency};

/// The largest stable step, and the cell that sets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StableStep {
    /// Largest stable step Δt = 2/(ω √(1 + 2β)) \[s\].
    pub step: f64,
    /// Cell of the highest frequency.
    pub highest: HighestFrequency,
}

/// Returns the largest stable step for densities of each block \[kg/m³\] and a viscosity β \[-\].
///
/// # Errors
/// [`FemError::LumpedMass`].
pub fn stable<const D: usize>(
    model: &Model<D>,
    density: &[f64],
    viscosity: f64,
) -> Result<StableStep, FemError> {
    let elastic = elastic_blocks(model)?;
    let highest = highest_frequency(&model.mesh, &elastic.iter().collect::<Vec<_>>(), density)?;
    Ok(StableStep { step: 2.0 / (highest.frequency * (1.0 + 2.0 * viscosity).sqrt()), highest })
}

/// Elastic cells of every block; those of other materials respond to the first strain as these do.
fn elastic_blocks<const D: usize>(model: &Model<D>) -> Result<Vec<LinearBlock<D>>, FemError> {
    let of_body = |block: usize| model.bodies.iter().find(|b| b.blocks.contains(&block));
    let mut result = Vec::new();
    for (k, block) in model.blocks.iter().enumerate() {
        match block {
            CellBlock::Linear(block) => result.push(block.as_ref().clone()),
            CellBlock::Nonlinear(_) => {
                let elastic = of_body(k).map(|b| b.elastic[k - b.blocks.start]);
                let elastic = elastic.ok_or(FemError::Threads("a block of cells without a body".into()))?;
                let space = model.idealisation;
                result.push(LinearBlock::new(&model.mesh, k, &elastic, space, Formulation::Standard)?);
            }
        }
    }
    Ok(result)
}

impl<const D: usize> Problem<D> {
    /// Length of the steps of a stage: a whole number of them, each within the stable step \[s\].
    #[must_use]
    pub fn step_of(&self, stage: usize, stable: &StableStep) -> f64 {
        let duration = self.stages[stage].end - self.stages[stage].start;
        duration / (duration / (self.courant * stable.step)).ceil().max(1.0)
    }
}
