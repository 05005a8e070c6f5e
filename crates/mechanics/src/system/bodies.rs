//! The bodies of a system during a run, condensed or not.

use crate::CellBlock;
use crate::energy::{BodyEnergy, BodyWorks};
use crate::error::SetUpError;
use asperity_fem::dof::Constraints;
use asperity_fem::term::ForwardTerm;
use asperity_run::Operations;
use serde::{Deserialize, Serialize};

/// State of the bodies.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodiesState {
    /// History of each block that has one.
    pub(super) histories: Vec<Vec<f64>>,
    /// Factorisations so far.
    pub(super) factorisations: usize,
    /// Right-hand sides solved with these factorisations.
    pub(super) solves: usize,
}

/// Operations of the bodies that the system needs.
pub trait Bodies<const D: usize> {
    /// Applies the loads and motions of a stage. `renewed` is true if the set of fixed degrees of freedom has changed.
    ///
    /// # Errors
    /// A description if a body cannot be factorised.
    fn load(&mut self, constraints: &Constraints, renewed: bool) -> Result<(), SetUpError>;

    /// Terms of the bodies in the system.
    fn terms(&mut self) -> Vec<&mut dyn ForwardTerm>;

    /// Displacement of all degrees of freedom of the mesh, from those of the system and the time \[s\].
    fn displacement(&self, u: &[f64], time: f64) -> Vec<f64>;

    /// Energies of the accepted state, with displacements `u` of the system \[m\] at `time` \[s\].
    fn energies(&self, u: &[f64], time: f64) -> BodyEnergy;

    /// Works in a step between two states, given by the displacements of the system \[m\] and the times \[s\].
    fn works(&self, from: (&[f64], f64), to: (&[f64], f64)) -> BodyWorks;

    /// Blocks of the mesh in their present state.
    fn blocks(&self) -> &[CellBlock<D>];

    /// Adds operations performed outside the steps.
    fn add_counts(&self, counts: &mut Operations);

    /// Committed histories and counts of operations.
    fn save(&self) -> BodiesState;

    /// Restores the saved state of the same bodies. Returns true if it fits.
    fn restore(&mut self, saved: &BodiesState) -> bool;
}
