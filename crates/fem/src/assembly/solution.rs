//! Way in which a system was solved.

use crate::outcome::Outcome;

/// Residual over the load at which a solution is a direction for Newton's method, which judges by the residual it leads to.
pub(super) const USEFUL: f64 = 1e-3;

/// See the module.
pub(super) enum Solution {
    /// By a factor.
    Direct,
    /// By iterations, or after them by `made` factorisations.
    Iterated { outcome: Outcome, made: usize },
    /// Not at all: the preconditioner, which is that of an earlier matrix, is too far from this one. The next assembly makes another.
    Distant { outcome: Outcome },
}
