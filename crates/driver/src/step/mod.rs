//! Steppers: what they share.

pub mod implicit;
pub mod static_explicit;

use crate::observe::view::Counts;
use asperity_fem::term::{Instant, Refusal, Term};

/// Displacements of the system and where they stand in time.
#[derive(Clone, Debug)]
pub struct State {
    /// Displacement per degree of freedom of the system \[m\].
    pub u: Vec<f64>,
    /// Time \[s\].
    pub time: f64,
}

/// How a trial step ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Trial {
    /// The step is accepted and committed.
    Accepted(Accepted),
    /// The step failed; nothing was committed. The text says why.
    Failed(String),
}

/// Figures of an accepted step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Accepted {
    /// Length actually taken \[s\].
    pub dt: f64,
    /// Newton iterations, or forward solves.
    pub iterations: usize,
    /// Residual over the largest force \[-\].
    pub residual_ratio: f64,
    /// What set the length, where the stepper itself did.
    pub limited_by: Option<String>,
}

/// Sums residuals of terms, keeping the largest force any of them exerts.
#[derive(Debug, Default)]
pub struct Balance {
    /// Residual of the system.
    pub r: Vec<f64>,
    /// Largest component of a single term's forces: what the residual is measured against.
    pub largest_force: f64,
    part: Vec<f64>,
}

impl Balance {
    /// Evaluates all terms at `u`.
    ///
    /// # Errors
    /// The first refusal.
    pub fn evaluate<T: Term + ?Sized>(
        &mut self,
        terms: &mut [&mut T],
        u: &[f64],
        at: Instant,
        counts: &mut Counts,
    ) -> Result<(), Refusal> {
        counts.residuals += 1;
        self.r.clear();
        self.r.resize(u.len(), 0.0);
        self.largest_force = 0.0;
        for term in terms {
            self.part.clear();
            self.part.resize(u.len(), 0.0);
            term.residual(u, at, &mut self.part)?;
            for (sum, &value) in self.r.iter_mut().zip(&self.part) {
                *sum += value;
                self.largest_force = self.largest_force.max(value.abs());
            }
        }
        Ok(())
    }

    /// Largest residual over `free`, NaN when any is.
    #[must_use]
    pub fn largest_residual(&self, free: &[usize]) -> f64 {
        free.iter().map(|&d| self.r[d].abs()).fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
    }
}
