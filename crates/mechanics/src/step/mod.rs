//! Definitions shared by the steppers.

mod anchor;
mod augmented;
pub mod implicit;
mod line;
pub mod static_explicit;
mod stepper;
mod stepper_state;

pub use stepper::Stepper;
pub use stepper_state::StepperState;

use asperity_fem::FemError;
use asperity_fem::assembly::System;
use asperity_fem::dof::Equations;
use asperity_fem::term::{Instant, Linearized, Objection, Refusal, Term};
use asperity_run::Operations;

/// Displacements of the system and their time.
#[derive(Clone, Debug)]
pub struct State {
    /// Displacement per degree of freedom of the system \[m\].
    pub u: Vec<f64>,
    /// Time \[s\].
    pub time: f64,
}

/// Length of a step that is wanted, and the least to which accuracy may shorten it \[s\].
#[derive(Clone, Copy, Debug)]
pub struct StepLengths {
    /// The wanted length.
    pub wanted: f64,
    /// The least.
    pub least: f64,
}

/// Reason why a trial step failed. Nothing was committed.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The state was refused, or the iteration did not converge. A shorter step may succeed.
    Refused(String),
    /// Constraints were not met within the allowed augmentations. The remaining violation shrinks only in proportion to the
    /// step, so that halving would continue indefinitely.
    Violated(String),
    /// A linear system could not be solved.
    Unsolved {
        /// Reason.
        error: FemError,
        /// True if steps of any length fail, so that a shorter one does not help.
        always: bool,
    },
    /// The iteration leaves the model, since next to nothing resists the motion. Its largest component is given.
    Adrift {
        /// Degree of freedom of the largest component.
        dof: usize,
    },
    /// The equations of the step hold, but the error of friction coefficients is too large.
    Inaccurate {
        /// Estimated error \[-\].
        error: f64,
    },
    /// The step was given up on request. The same step from the same state may follow.
    Interrupted,
    /// The equations of the step hold, but a term objects to their solution.
    Objected(Objection),
}

impl Failure {
    /// True if shorter steps fail as well.
    #[must_use]
    pub fn always(&self) -> bool {
        match self {
            Self::Unsolved { always, .. } => *always,
            Self::Violated(_) => true,
            Self::Objected(objection) => !objection.shorter,
            Self::Refused(_) | Self::Inaccurate { .. } | Self::Adrift { .. } | Self::Interrupted => false,
        }
    }

    /// True if a free motion was found.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        matches!(self, Self::Unsolved { error, .. } if error.is_singular())
    }

    /// Failure of the linear system of these terms.
    fn unsolved<T: Linearized + ?Sized>(error: FemError, terms: &[&mut T]) -> Self {
        Self::Unsolved { error, always: terms.iter().all(|t| t.constant_tangent().is_some()) }
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal.to_string())
    }
}

/// Fails with the first objection of a term to the solved step.
fn unopposed<T: Term + ?Sized>(terms: &[&mut T]) -> Result<(), Failure> {
    terms.iter().find_map(|t| t.objection()).map_or(Ok(()), |objection| Err(Failure::Objected(objection)))
}

/// Estimated error that a solved step leaves in friction coefficients; fails if it exceeds `bound`.
fn accurate<T: Term + ?Sized>(terms: &mut [&mut T], bound: f64) -> Result<f64, Failure> {
    let error = terms.iter_mut().map(|t| t.error()).fold(0.0, f64::max);
    if error > bound { Err(Failure::Inaccurate { error }) } else { Ok(error) }
}

/// Operations of a linear system before a step.
#[derive(Clone, Copy)]
struct SystemCounts {
    factorisations: usize,
    indefinite: usize,
    iterations: usize,
}

impl SystemCounts {
    fn from_system(system: &System) -> Self {
        let System { factorisations, indefinite, iterations, .. } = *system;
        Self { factorisations, indefinite, iterations }
    }

    /// Adds the operations performed since.
    fn count(self, system: &System, counts: &mut Operations) {
        counts.factorisations += system.factorisations - self.factorisations;
        counts.indefinite += system.indefinite - self.indefinite;
        counts.linear_iterations += system.iterations - self.iterations;
    }
}

/// Figures of a solution.
#[derive(Clone, Copy, Debug)]
struct SolutionFigures {
    iterations: usize,
    residual_ratio: f64,
    augmentations: usize,
}

/// Figures of an accepted step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AcceptedStep {
    /// Length actually taken \[s\].
    pub dt: f64,
    /// Newton iterations.
    pub iterations: usize,
    /// Augmentations of multipliers.
    pub augmentations: usize,
    /// Residual over the largest force \[-\].
    pub residual_ratio: f64,
    /// The same at each Newton iteration of an implicit step, from the first on \[-\].
    pub residuals: Vec<f64>,
    /// Estimated error of friction coefficients \[-\].
    pub error: f64,
    /// Residual over the largest force that a forward step left before its correction \[-\].
    pub drift: f64,
    /// Limit that set the length, if the stepper itself did.
    pub limited_by: Option<String>,
    /// Reason why the stepper shortened the step.
    pub cut: Cut,
}

/// Reason why a stepper took a shorter step than requested.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cut {
    /// The step was not shortened.
    #[default]
    Nothing,
    /// The step ends at an event. The next one may be as long as was requested.
    Event,
    /// A longer step would not be accurate.
    Accuracy,
}

/// Sum of the residuals of terms, with the largest force of any term.
#[derive(Debug, Default)]
pub struct Balance {
    /// Residual of the system.
    pub r: Vec<f64>,
    /// Largest component of a single term's forces, which the residual is compared with.
    pub largest_force: f64,
    /// Largest [`Term::unsettled`].
    unsettled: f64,
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
        counts: &mut Operations,
    ) -> Result<(), Refusal> {
        counts.residuals += 1;
        self.r.clear();
        self.r.resize(u.len(), 0.0);
        self.largest_force = 0.0;
        self.unsettled = 0.0;
        for term in terms {
            self.part.clear();
            self.part.resize(u.len(), 0.0);
            term.residual(u, at, &mut self.part)?;
            self.unsettled = self.unsettled.max(term.unsettled());
            for (sum, &value) in self.r.iter_mut().zip(&self.part) {
                *sum += value;
                self.largest_force = self.largest_force.max(value.abs());
            }
        }
        Ok(())
    }

    /// Largest residual of an equation, or of those that terms eliminated; NaN if any entry is.
    #[must_use]
    pub fn largest_residual(&self, equations: &Equations) -> f64 {
        let larger = |a: f64, b: f64| if b > a || b.is_nan() { b } else { a };
        if equations.tied.is_empty() {
            return equations.free.iter().map(|&d| self.r[d].abs()).fold(self.unsettled, larger);
        }
        equations.gather(&self.r).into_iter().map(f64::abs).fold(self.unsettled, larger)
    }
}
