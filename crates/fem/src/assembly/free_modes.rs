//! Motions that a system does not hold.

use super::symmetric::SymmetricPart;
use super::{Store, System};
use crate::multifrontal::{FreeMode, Pivot, free_mode};
use faer::sparse::SparseColMatRef;

/// Ratio of largest entry times solution to load beyond which LU may have divided by rounding. It is a lower bound of the
/// condition number; stiff contact on flexible bodies reaches 1e8.
const SUSPECT: f64 = 1e12;

impl System {
    /// The motion that the last assembled matrix does not resist, if the matrix is singular and has no negative modes. For an
    /// unsymmetric matrix, the symmetric part is used: where nothing resists, nothing is unsymmetric. Degree of freedom =
    /// node * D + component, positions in `nodes` \[m\]. It costs several factorisations. The iterative method keeps no
    /// matrix that could be factored, and gives no answer.
    #[must_use]
    pub fn free_mode<const D: usize>(&self, nodes: &[[f64; D]]) -> Option<FreeMode<D>> {
        // A motion of degrees of freedom that share an equation is not one of single nodes.
        if self.equations.number.len() != nodes.len() * D || !self.equations.tied.is_empty() {
            return None;
        }
        let lower = self.lower()?;
        let pivot = lower.singular()?;
        let matrix = SparseColMatRef::new(lower.pattern.as_ref(), &lower.values);
        free_mode(matrix, pivot.equation, &self.equations, nodes).ok()
    }

    /// Pivot at which the last assembled matrix is singular, checked if the solution `x` of `rhs` makes that probable. LU
    /// cannot distinguish a pivot that is rounding from a small one.
    pub(super) fn suspect(&self, x: f64, rhs: f64) -> Option<Pivot> {
        if x * self.largest_entry <= SUSPECT * rhs {
            return None;
        }
        self.lower()?.singular()
    }

    /// Lower triangle of the symmetric part of the matrix.
    pub(super) fn lower(&self) -> Option<SymmetricPart> {
        match &self.store {
            Store::Dense(store) => Some(SymmetricPart::from_dense(&store.matrix())),
            Store::Flexibility(store) => Some(SymmetricPart::from_dense(&store.matrix()?)),
            Store::Sparse(store) => store.map.as_ref().map(|map| SymmetricPart::from_sparse(map.matrix())),
            Store::Preconditioned(store) => {
                store.matrix().map.as_ref().map(|map| SymmetricPart::from_sparse(map.matrix()))
            }
            Store::Iterative(_) | Store::Aggregated(_) => None,
        }
    }
}
