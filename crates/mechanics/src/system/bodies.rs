//! The bodies of a system at work, condensed or not.

use crate::{CellBlock, Counts};
use asperity_fem::dof::Constraints;
use asperity_fem::term::Limited;
use serde::{Deserialize, Serialize};

/// The state of bodies.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodiesState {
    /// History of each block that has one.
    pub(super) histories: Vec<Vec<f64>>,
    /// Factorisations so far.
    pub(super) factorisations: usize,
    /// Right-hand sides solved with them.
    pub(super) solves: usize,
}

/// See the module.
pub trait Bodies<const D: usize> {
    /// Puts the loads and motions of a stage in force; `renewed` where other degrees of freedom are fixed than before.
    ///
    /// # Errors
    /// The reason in words when a body cannot be factored.
    fn load(&mut self, constraints: &Constraints, renewed: bool) -> Result<(), String>;

    /// Their terms in the system.
    fn terms(&mut self) -> Vec<&mut dyn Limited>;

    /// Displacement of all degrees of freedom of the mesh, for those of the system and the time \[s\].
    fn displacement(&self, u: &[f64], time: f64) -> Vec<f64>;

    /// Blocks of the mesh in their present state.
    fn blocks(&self) -> &[CellBlock<D>];

    /// Adds the work done outside the steps.
    fn add_counts(&self, counts: &mut Counts);

    /// Committed histories, and counts of work.
    fn save(&self) -> BodiesState;

    /// Takes up what the same bodies saved; whether it fits.
    fn restore(&mut self, saved: &BodiesState) -> bool;
}
