//! End of an iteration.

/// Result of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Iterations: products with the matrix, those that recompute the residual apart.
    pub iterations: usize,
    /// `sqrt(r·M⁻¹r / b·M⁻¹b)` with `r = b - K x` computed anew from the returned x; M the preconditioner \[-\].
    pub residual: f64,
    /// `|r| / |b|` of the same r \[-\].
    pub euclidean: f64,
}

/// End of a solution. Not converging is an outcome, not an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The residual recomputed from the solution is below the tolerance.
    Converged(Report),
    /// The residual recomputed from the solution no longer falls: the tolerance is below what rounding allows.
    Stalled(Report),
    /// The largest number of iterations was not enough.
    Exhausted(Report),
    /// A direction of negative energy `p·K p` (or a value that is not a number) appeared: the matrix or the
    /// preconditioner is not positive definite.
    Indefinite {
        /// Result reached before.
        report: Report,
        /// The energy of the direction.
        energy: f64,
    },
}

impl Outcome {
    /// Result reached.
    #[must_use]
    pub fn report(&self) -> &Report {
        match self {
            Self::Converged(r)
            | Self::Stalled(r)
            | Self::Exhausted(r)
            | Self::Indefinite { report: r, .. } => r,
        }
    }

    /// True if the tolerance was reached.
    #[must_use]
    pub fn converged(&self) -> bool {
        matches!(self, Self::Converged(_))
    }
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Report { iterations, residual, euclidean } = self.report();
        match self {
            Self::Converged(_) => write!(f, "converged")?,
            Self::Stalled(_) => write!(f, "stalled: rounding allows no smaller residual")?,
            Self::Exhausted(_) => write!(f, "not converged")?,
            Self::Indefinite { energy, .. } => {
                write!(f, "the matrix is not positive definite (a direction has the energy {energy:e})")?;
            }
        }
        write!(f, " after {iterations} iterations, relative residual {residual:.1e} ({euclidean:.1e} in |r|)")
    }
}
