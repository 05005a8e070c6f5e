//! Outcome of an iteration.

/// Residuals and iterations reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Iterations: products with the matrix, except those that recompute the residual.
    pub iterations: usize,
    /// `sqrt(r·M⁻¹r / b·M⁻¹b)` with `r = b - K x` recomputed from the returned x; M is the preconditioner \[-\].
    pub residual: f64,
    /// `|r| / |b|` of the same r \[-\].
    pub euclidean: f64,
}

/// Outcome of a solution. Failure to converge is an outcome, not an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The residual recomputed from the solution is below the tolerance.
    Converged(Report),
    /// The residual recomputed from the solution no longer decreases: the tolerance is below the limit of rounding.
    Stalled(Report),
    /// The largest number of iterations was insufficient.
    Exhausted(Report),
    /// A direction of negative energy `p·K p`, or with a value that is not a number, appeared: the matrix or the preconditioner
    /// is not positive definite.
    Indefinite {
        /// Report up to that iteration.
        report: Report,
        /// The energy of the direction.
        energy: f64,
    },
}

impl Outcome {
    /// Residuals and iterations reached.
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
