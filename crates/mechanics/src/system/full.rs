//! Bodies with all their degrees of freedom in the system.

use super::bodies::{Bodies, BodiesState};
use crate::energy::{self, BodyEnergy, BodyWorks};
use crate::error::SetUpError;
use crate::{CellBlock, Model};
use asperity_fem::dof::Constraints;
use asperity_fem::loads::ExternalForces;
use asperity_fem::term::{ForwardTerm, Restorable as _};
use asperity_run::Operations;

/// Cell blocks and loads on all degrees of freedom.
pub struct FullBodies<const D: usize> {
    dofs: usize,
    blocks: Vec<CellBlock<D>>,
    loads: ExternalForces,
}

impl<const D: usize> FullBodies<D> {
    /// Takes the bodies of a model.
    #[must_use]
    pub fn new(model: &Model<D>) -> Self {
        Self { dofs: model.dofs(), blocks: model.blocks.clone(), loads: ExternalForces::new(Vec::new()) }
    }
}

impl<const D: usize> Bodies<D> for FullBodies<D> {
    fn load(&mut self, constraints: &Constraints, _renewed: bool) -> Result<(), SetUpError> {
        self.loads = ExternalForces::new(constraints.channels.clone());
        Ok(())
    }

    fn terms(&mut self) -> Vec<&mut dyn ForwardTerm> {
        let loads = std::iter::once(&mut self.loads as &mut dyn ForwardTerm);
        self.blocks.iter_mut().map(CellBlock::forward_term).chain(loads).collect()
    }

    fn displacement(&self, u: &[f64], _time: f64) -> Vec<f64> {
        u[..self.dofs].to_vec()
    }

    fn energies(&self, u: &[f64], _time: f64) -> BodyEnergy {
        energy::body_energy(&self.blocks, u)
    }

    fn works(&self, from: (&[f64], f64), to: (&[f64], f64)) -> BodyWorks {
        let moved: Vec<f64> = from.0.iter().zip(to.0).map(|(from, to)| to - from).collect();
        let loads = energy::by_loads(self.loads.channels(), to.1, to.1 - from.1, &moved);
        BodyWorks { loads, motions: 0.0 }
    }

    fn blocks(&self) -> &[CellBlock<D>] {
        &self.blocks
    }

    fn add_counts(&self, _counts: &mut Operations) {}

    fn save(&self) -> BodiesState {
        let histories = self.blocks.iter().filter_map(CellBlock::history).collect();
        BodiesState { histories, ..BodiesState::default() }
    }

    fn restore(&mut self, saved: &BodiesState) -> bool {
        let mut histories = saved.histories.iter();
        let nonlinear = self.blocks.iter_mut().filter_map(CellBlock::nonlinear_mut);
        let mut fit = true;
        for block in nonlinear {
            fit &= histories.next().is_some_and(|history| block.restore(history));
        }
        fit && histories.next().is_none()
    }
}
