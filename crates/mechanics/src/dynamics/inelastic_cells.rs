//! Cells with a history: their forces, those of viscosity in them, and the powers of both.

use super::budget::Work;
use crate::error::SetUpError;
use crate::{CellBlock, Model};
use asperity_fem::nonlinear::{Block, Material};
use asperity_fem::term::{Instant, Refusal, Restorable as _, Term as _};
use serde::{Deserialize, Serialize};

/// Works of the forces of these cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Works {
    /// All forces.
    pub all: Work,
    /// Those of viscosity.
    pub viscous: Work,
}

/// Energy that flow has dissipated \[J\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flow {
    /// By plastic flow.
    pub plastic: f64,
    /// By viscous flow.
    pub viscous: f64,
}

/// Cells with a history. Without any, all vectors are empty.
pub(super) struct InelasticCells<const D: usize> {
    blocks: Vec<Block<D>>,
    /// All forces \[N\].
    forces: Vec<f64>,
    /// Forces of viscosity \[N\]; empty without.
    viscous: Vec<f64>,
    /// Velocities times the relaxation time of viscosity \[m\]; empty without.
    way: Vec<f64>,
    /// Forces of the stress at the start, which whatever holds the bodies balances \[N\]; empty where nothing does.
    balanced: Vec<f64>,
    /// Elastic energy of the stress at the start \[J\].
    at_start: f64,
    /// Powers of all forces, and of those of viscosity, at the velocities before the present step \[W\].
    before: [f64; 2],
    /// Displacements times all forces \[J\].
    along: f64,
}

impl<const D: usize> InelasticCells<D> {
    /// Cells of a model. In `balance` the stress at the start moves nothing, as that of elastic cells beside faults, where it
    /// only determines tractions.
    ///
    /// # Errors
    /// [`SetUpError::Forces`] where the forces at the start are not defined.
    pub fn new(model: &Model<D>, viscous: bool, balance: bool) -> Result<Self, SetUpError> {
        let blocks: Vec<_> = model.blocks.iter().filter_map(nonlinear).cloned().collect();
        let dofs = if blocks.is_empty() { 0 } else { model.dofs() };
        let zeros = |needed: bool| if needed { vec![0.0; dofs] } else { Vec::new() };
        let mut result = Self {
            forces: zeros(true),
            viscous: zeros(viscous),
            way: zeros(viscous),
            balanced: Vec::new(),
            at_start: blocks.iter().map(Block::strain_energy).sum(),
            before: [0.0; 2],
            along: 0.0,
            blocks,
        };
        if balance {
            let rest = zeros(true);
            result.evaluate(&rest, &rest, Instant { time: 0.0, dt: 0.0 }, 0.0).map_err(SetUpError::Forces)?;
            result.blocks.iter_mut().for_each(Block::reject);
            result.balanced = result.forces.clone();
        }
        Ok(result)
    }

    /// Blocks in their present state.
    pub fn blocks(&self) -> &[Block<D>] {
        &self.blocks
    }

    /// Computes the forces at displacements and the velocities before the step, with the relaxation time of viscosity \[s\].
    pub fn evaluate(
        &mut self,
        u: &[f64],
        velocity: &[f64],
        at: Instant,
        relaxation: f64,
    ) -> Result<(), Refusal> {
        self.forces.fill(0.0);
        self.viscous.fill(0.0);
        self.way.iter_mut().zip(velocity).for_each(|(w, v)| *w = relaxation * v);
        for block in &mut self.blocks {
            block.residual(u, at, &mut self.forces)?;
            if relaxation > 0.0 {
                block.viscous(&self.way, &mut self.viscous)?;
            }
        }
        self.forces.iter_mut().zip(&self.balanced).for_each(|(f, held)| *f -= held);
        self.forces.iter_mut().zip(&self.viscous).for_each(|(f, v)| *f += v);
        self.before = self.powers(velocity);
        self.along = self.forces.iter().zip(u).map(|(f, u)| f * u).sum();
        Ok(())
    }

    /// All forces \[N\]; empty without such cells.
    pub fn forces(&self) -> &[f64] {
        &self.forces
    }

    /// Displacements times all forces \[J\].
    pub fn along(&self) -> f64 {
        self.along
    }

    /// Power of all forces at the velocities before the present step \[W\].
    pub fn power(&self) -> f64 {
        self.before[0]
    }

    /// Powers of all forces, and of those of viscosity \[W\].
    fn powers(&self, velocity: &[f64]) -> [f64; 2] {
        [&self.forces, &self.viscous].map(|forces| forces.iter().zip(velocity).map(|(f, v)| f * v).sum())
    }

    /// Works over half a step before and after the last forces, given the velocities after them, and half the step \[s\].
    pub fn works(&self, after: &[f64], half: f64) -> [[f64; 2]; 2] {
        let after = self.powers(after);
        [0, 1].map(|k| [half * self.before[k], half * after[k]])
    }

    /// Dissipation by flow: the part of the work of all forces but those of viscosity that is not kept as elastic energy.
    /// `u` has the displacements of the present states \[m\]. Where both kinds of flow occur, each material's own count tells them apart.
    pub fn flow(&self, work: f64, u: impl Iterator<Item = f64>) -> Flow {
        let has = |of: fn(&Material) -> bool| self.blocks.iter().any(|b| of(&b.model().material));
        let plastic = has(|m| matches!(m, Material::J2(_)));
        let viscous = has(|m| matches!(m, Material::Maxwell(_)));
        if !plastic && !viscous {
            return Flow::default();
        }
        let held: f64 = self.balanced.iter().zip(u).map(|(f, u)| f * u).sum();
        let kept = self.blocks.iter().map(Block::strain_energy).sum::<f64>() - self.at_start;
        let lost = work + held - kept;
        if !viscous {
            return Flow { plastic: lost, viscous: 0.0 };
        }
        let plastic = self.blocks.iter().map(Block::plastic_work).sum::<f64>();
        Flow { plastic, viscous: lost - plastic }
    }

    /// Takes the step.
    pub fn accept(&mut self) {
        self.blocks.iter_mut().for_each(Block::accept);
    }

    /// Elastic energy that the stress at the start may set free \[J\]: where nothing balances it, and where it relaxes.
    pub fn released(&self) -> f64 {
        let free =
            |b: &&Block<D>| self.balanced.is_empty() || matches!(b.model().material, Material::Maxwell(_));
        self.blocks.iter().filter(free).map(Block::strain_energy).sum()
    }

    /// Committed histories.
    pub fn save(&self) -> Vec<Vec<f64>> {
        self.blocks.iter().map(|b| b.save()).collect()
    }

    /// Restores histories; false if they belong to other cells.
    pub fn restore(&mut self, saved: &[Vec<f64>]) -> bool {
        saved.len() == self.blocks.len()
            && self.blocks.iter_mut().zip(saved).all(|(block, history)| block.restore(history))
    }
}

fn nonlinear<const D: usize>(block: &CellBlock<D>) -> Option<&Block<D>> {
    match block {
        CellBlock::Linear(_) => None,
        CellBlock::Nonlinear(block) => Some(block.as_ref()),
    }
}
