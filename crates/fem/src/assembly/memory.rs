//! Memory of earlier assemblies of a system, as values, for a run that is resumed.
//!
//! Factors and analyses follow from the next assembly. Three things do not: the scale of the last assembly, which decides what counts as
//! rounding before the next, the equations of a dense system that remained after eliminating the others, and the pairs whose factor
//! preconditions those of later steps.

use super::flexibility::FactorMemory;
use super::symmetry::RemainingEquations;
use super::{Store, System};
use crate::term::Linearized;
use serde::{Deserialize, Serialize};

/// See the module.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Largest entry of any term's tangent in the last assembly.
    pub(super) largest_entry: f64,
    /// True if there is a factor that the next solve uses unchanged.
    pub(super) factored: bool,
    /// Remaining equations of a dense system, if others were eliminated.
    pub(super) left: Option<RemainingEquations>,
    /// Origin of the factor of tractions between pairs.
    pub(super) pairs: Option<FactorMemory>,
}

impl System {
    /// Memory of the system, for these terms.
    #[must_use]
    pub fn memory(&self, terms: &[&mut dyn Linearized]) -> Memory {
        let constant = terms.iter().all(|t| t.constant_tangent().is_some());
        Memory {
            largest_entry: self.largest_entry,
            factored: constant && self.is_factored(terms.iter().map(|t| t.pattern())),
            left: match &self.store {
                Store::Dense(store) => store.left(),
                _ => None,
            },
            pairs: match &self.store {
                Store::Flexibility(store) => store.memory(),
                _ => None,
            },
        }
    }

    /// Restores the memory of a system of the same terms and equations. Returns false, without a change, if it does not fit, or if the
    /// factored matrix cannot be factored again.
    pub fn restore(&mut self, memory: &Memory, terms: &mut [&mut dyn Linearized]) -> bool {
        if let Some(left) = &memory.left {
            let fits = left.equations.iter().all(|&e| e < self.equations.free.len());
            match &mut self.store {
                Store::Dense(store) if fits => store.remember(left.clone()),
                _ => return false,
            }
        }
        if let Some(pairs) = &memory.pairs {
            match &mut self.store {
                Store::Flexibility(store) => store.remember(pairs.clone()),
                _ => return false,
            }
        }
        if memory.factored && self.factor_tangent(terms).is_err() {
            return false;
        }
        self.largest_entry = memory.largest_entry;
        true
    }
}
