//! Rock friction laws on slices of points: strengths, evolutions with their exact steps, and the point return used by contact.
//!
//! The crate contains no meshes, files or time loop. Everything is scalar: see [`law`].
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod component;
pub mod coulomb;
mod drive;
pub mod evolution;
pub mod fault;
pub mod inertial;
pub mod kind;
pub mod law;
mod line;
mod pace;
pub mod point;
pub mod points;
pub mod pointwise;
pub mod rake;
pub mod rate;
pub mod sheet;
pub mod slider;
pub mod slip_weakening;
pub mod static_kinetic;
pub mod strength;
pub mod tied;
mod yielding;

/// Failures of a law.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    /// A parameter out of its range.
    #[error("{name} = {value:e} is not admissible: {admissible}")]
    Parameter {
        /// Parameter.
        name: &'static str,
        /// Given value.
        value: f64,
        /// Admissible values.
        admissible: &'static str,
    },
    /// Bare and cut-off logarithms have no value at rest or in reversal.
    #[error(
        "point {point}: bare and cut-off friction have no value at the slip rate {rate:e} m/s; use `form = \"regularised\"`"
    )]
    BareLogAtRest {
        /// Point in the slice.
        point: usize,
        /// Slip rate \[m/s\].
        rate: f64,
    },
    /// A form without a value at rest would be negative.
    #[error(
        "point {point}: at {rate:e} m/s the friction coefficient would be {mu:.4}, and this form has no value below zero; use the regularised form"
    )]
    Negative {
        /// Point in the slice.
        point: usize,
        /// Slip rate \[m/s\].
        rate: f64,
        /// Coefficient given by the form \[-\].
        mu: f64,
    },
    /// The law weakens faster than the spring behind the point unloads.
    #[error("point {point}: the law weakens by {weakening:e} Pa/m against a stiffness of {stiffness:e} Pa/m")]
    Unstable {
        /// Point in the slice.
        point: usize,
        /// E_t \[Pa/m\].
        stiffness: f64,
        /// -H \[Pa/m\].
        weakening: f64,
    },
    /// An input or a result is not finite.
    #[error("point {point}: not finite (normal traction {normal:e} Pa, trial {trial:e} Pa)")]
    NonFinite {
        /// Point in the slice.
        point: usize,
        /// f_n \[Pa\].
        normal: f64,
        /// |t^e| \[Pa\].
        trial: f64,
    },
    /// The root was not found.
    #[error(
        "point {point}: no slip rate found (normal traction {normal:e} Pa, trial {trial:e} Pa, residual {residual:e} Pa)"
    )]
    NotConverged {
        /// Point in the slice.
        point: usize,
        /// f_n \[Pa\].
        normal: f64,
        /// |t^e| \[Pa\].
        trial: f64,
        /// Residual \[Pa\].
        residual: f64,
    },
}

impl Failure {
    /// Point in the slice; `None` for a parameter, which all points have.
    #[must_use]
    pub fn point(&self) -> Option<usize> {
        match self {
            Self::Parameter { .. } => None,
            Self::BareLogAtRest { point, .. }
            | Self::Negative { point, .. }
            | Self::Unstable { point, .. }
            | Self::NonFinite { point, .. }
            | Self::NotConverged { point, .. } => Some(*point),
        }
    }

    /// The same failure at another point, for callers that treat parts of a slice.
    #[must_use]
    pub fn at(self, index: usize) -> Self {
        match self {
            Self::BareLogAtRest { rate, .. } => Self::BareLogAtRest { point: index, rate },
            Self::Negative { rate, mu, .. } => Self::Negative { point: index, rate, mu },
            Self::Unstable { stiffness, weakening, .. } => {
                Self::Unstable { point: index, stiffness, weakening }
            }
            Self::NonFinite { normal, trial, .. } => Self::NonFinite { point: index, normal, trial },
            Self::NotConverged { normal, trial, residual, .. } => {
                Self::NotConverged { point: index, normal, trial, residual }
            }
            other @ Self::Parameter { .. } => other,
        }
    }
}

/// Checks a parameter that must be positive and finite.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<f64, Failure> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(Failure::Parameter { name, value, admissible: "a positive, finite number" })
    }
}

/// Checks a parameter that must be finite.
pub(crate) fn finite(name: &'static str, value: f64) -> Result<f64, Failure> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Failure::Parameter { name, value, admissible: "a finite number" })
    }
}

/// The example of the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
