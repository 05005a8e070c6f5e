//! Choices of a plan that a scene may leave open: the path, the stepper and the control of its steps.

use crate::scene::model::Rule;
use serde::Serialize;

/// Which system the steppers see.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Path {
    /// The interface degrees of freedom, the bodies condensed onto them.
    Condensed,
    /// All degrees of freedom.
    Full,
}

/// How the length of implicit steps is chosen.
#[derive(Clone, Debug)]
pub struct Control {
    /// Bound on the estimated local error of slip per step \[m\].
    pub tolerance: f64,
    /// Bound on the estimated error of friction coefficients of a step \[-\].
    pub friction: f64,
    /// First step \[s\], where given.
    pub first_step: Option<f64>,
    /// Largest step \[s\], where given.
    pub max_step: Option<f64>,
    /// Smallest step \[s\], where given.
    pub min_step: Option<f64>,
    /// Imposed step ends \[s\].
    pub imposed: Option<Vec<f64>>,
}

/// The stepper with exactly what it needs.
#[derive(Clone, Debug)]
pub enum Stepping {
    /// Newton.
    Implicit {
        /// Rule for the slip rate.
        rule: Rule,
    },
    /// R-minimum.
    StaticExplicit {
        /// Rule for the slip rate.
        rule: Rule,
        /// Residual over the largest force that a step may leave.
        drift: f64,
        /// Bound on |Δ ln V| per step.
        rate_change: f64,
        /// ζ.
        zeta: f64,
    },
}

impl Stepping {
    /// Rule for the slip rate.
    #[must_use]
    pub fn rule(&self) -> Rule {
        match self {
            Self::Implicit { rule } | Self::StaticExplicit { rule, .. } => *rule,
        }
    }
}
