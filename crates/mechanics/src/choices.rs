//! The path, the stepper and the control of its steps.

use asperity_contact::TimeRule;
use asperity_friction::law::RateBounds;

/// System that the steppers solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// Interface degrees of freedom, with the bodies condensed onto them.
    Condensed,
    /// All degrees of freedom.
    Full,
}

/// Control of the length of implicit steps.
#[derive(Clone, Debug)]
pub struct Control {
    /// Bound on the estimated local error of slip per step \[m\].
    pub tolerance: f64,
    /// Bound on the estimated error of friction coefficients per step \[-\].
    pub friction: f64,
    /// First step \[s\], if given.
    pub first_step: Option<f64>,
    /// Largest step \[s\], if given.
    pub max_step: Option<f64>,
    /// Smallest step \[s\], if given.
    pub min_step: Option<f64>,
    /// Largest departure of a table from its chord between the ends of two steps, over the range of the table \[-\].
    pub course: f64,
    /// Imposed step ends \[s\], if given.
    pub imposed: Option<Vec<f64>>,
    /// Times of outputs at which adaptive steps end, ascending \[s\].
    pub outputs: Vec<f64>,
}

/// Stepper and its parameters.
#[derive(Clone, Copy, Debug)]
pub struct Stepping {
    /// Rule for the slip rate.
    pub rule: TimeRule,
    /// Bounds on slip and on the change of the slip rate in a step.
    pub bounds: RateBounds,
    /// Residual over the largest force that a forward step may leave; `None` if steps are implicit.
    pub drift: Option<f64>,
}

impl Stepping {
    /// True if the steps are forward steps with rate tangents.
    #[must_use]
    pub fn is_forward(&self) -> bool {
        self.drift.is_some()
    }
}
