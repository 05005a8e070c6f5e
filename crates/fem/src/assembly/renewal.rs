//! Judgement of a preconditioner that is kept from an earlier matrix: when another one pays.

use crate::iterative::gmres::Bounds;
use crate::outcome::Outcome;

/// Iterations with a preconditioner since it was made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Renewal {
    /// True if a preconditioner is to be made from the next matrix.
    pub due: bool,
    /// Iterations of the first solution with the preconditioner.
    fresh: Option<usize>,
    /// Iterations that later solutions took beyond it.
    excess: usize,
}

impl Renewal {
    /// Nothing has been made.
    pub fn new() -> Self {
        Self { due: true, fresh: None, excess: 0 }
    }

    /// A preconditioner is made.
    pub fn done(&mut self) {
        *self = Self { due: false, fresh: None, excess: 0 };
    }

    /// Bounds of a solution after which another preconditioner may be made, which is `worth` so many iterations. What solutions with one
    /// take beyond the first adds up to the cost of another at most, so that the whole costs at most twice what it would have cost with the
    /// best choice.
    pub fn bounds(&self, bounds: Bounds, worth: usize) -> Bounds {
        let Some(fresh) = self.fresh else { return bounds };
        let most = fresh.saturating_add(worth.saturating_sub(self.excess));
        Bounds { most_iterations: most.min(bounds.most_iterations), paced: true, ..bounds }
    }

    /// Takes note of a solution within these bounds. Returns true if it was abandoned because the preconditioner, which is that of an
    /// earlier matrix, is too far from this one.
    pub fn note(&mut self, outcome: &Outcome, bounds: Bounds, worth: usize) -> bool {
        let iterations = outcome.report().iterations;
        let fresh = *self.fresh.get_or_insert(iterations);
        self.excess += iterations.saturating_sub(fresh);
        let distant = bounds.paced && !outcome.converged();
        self.due = distant || self.excess > worth;
        distant
    }
}
