//! Memory of earlier assemblies of a system, as values, for a run that is resumed.
//!
//! Factors and analyses follow from what is assembled next. Two things do not: the scale of the last assembly, which decides what counts
//! as rounding before the next, and which equations of a dense system were left over when the others were eliminated.

use super::known::Left;
use super::{Store, System};
use crate::term::Linearized;
use serde::{Deserialize, Serialize};

/// See the module.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Largest entry of any term's tangent in the last assembly.
    pub(super) largest_entry: f64,
    /// True if there is a factor that the next solve takes as it is.
    pub(super) factored: bool,
    /// Equations left over in a dense system, where others were eliminated.
    pub(super) left: Option<Left>,
}

impl System {
    /// Its memory, as a system of these terms.
    #[must_use]
    pub fn memory(&self, terms: &[&mut dyn Linearized]) -> Memory {
        let constant = terms.iter().all(|t| t.constant_tangent().is_some());
        Memory {
            largest_entry: self.largest_entry,
            factored: constant && self.is_factored(terms.iter().map(|t| t.pattern())),
            left: match &self.store {
                Store::Dense(store) => store.left(),
                Store::Sparse(_) | Store::Iterative(_) => None,
            },
        }
    }

    /// Takes up the memory of a system of the same terms and equations. Returns false, changing nothing, where it does not fit, or where
    /// what was factored cannot be factored again.
    pub fn restore(&mut self, memory: &Memory, terms: &mut [&mut dyn Linearized]) -> bool {
        if let Some(left) = &memory.left {
            let fits = left.equations.iter().all(|&e| e < self.equations.free.len());
            match &mut self.store {
                Store::Dense(store) if fits => store.remember(left.clone()),
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
