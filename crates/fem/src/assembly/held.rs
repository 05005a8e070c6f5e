//! Motions that a system does not hold.

use super::symmetric::SymmetricPart;
use super::{Store, System};
use crate::multifrontal::{FreeMode, Pivot, free_mode};
use faer::sparse::SparseColMatRef;

/// Largest entry times solution over load beyond which LU may have divided by rounding. The product bounds the condition from
/// below; stiff contact on flexible bodies reaches 1e8.
const SUSPECT: f64 = 1e12;

impl System {
    /// The motion that the matrix assembled last does not resist, where it is singular and has no negative modes. Of a matrix
    /// that is not symmetric its symmetric part counts: where nothing resists, there is nothing unsymmetric. Degree of
    /// freedom = node * D + component, positions in `nodes` \[m\]. Costs some factorisations; the iterative method keeps no
    /// matrix that could be factored, and has no answer.
    #[must_use]
    pub fn free_mode<const D: usize>(&self, nodes: &[[f64; D]]) -> Option<FreeMode<D>> {
        if self.equations.number.len() != nodes.len() * D {
            return None;
        }
        let lower = self.lower()?;
        let pivot = lower.singular()?;
        let matrix = SparseColMatRef::new(lower.pattern.as_ref(), &lower.values);
        free_mode(matrix, pivot.equation, &self.equations, nodes).ok()
    }

    /// Pivot to blame where the matrix assembled last is probably singular, by the solution `x` of `rhs`: LU does not tell a
    /// pivot that is rounding from one that is small.
    pub(super) fn suspect(&self, x: f64, rhs: f64) -> Option<Pivot> {
        if x * self.largest_entry <= SUSPECT * rhs {
            return None;
        }
        self.lower()?.singular()
    }

    /// Lower triangle of the symmetric part of the matrix.
    fn lower(&self) -> Option<SymmetricPart> {
        match &self.store {
            Store::Dense(store) => Some(SymmetricPart::of_dense(&store.matrix())),
            Store::Sparse(store) => store.map.as_ref().map(|map| SymmetricPart::of_sparse(map.matrix())),
            Store::Iterative(_) => None,
        }
    }
}
