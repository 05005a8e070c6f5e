//! Rows of the table of evolution laws, with the data that scenes, the book and planning need of each.

use super::state::Evolution;
use crate::Failure;

/// Unit of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A plain number.
    None,
    /// m/s.
    Velocity,
    /// m.
    Length,
    /// Pa.
    Pressure,
}

/// Admissible values of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Above zero.
    Positive,
    /// Zero or greater.
    NotNegative,
    /// Zero or greater, and below the reference coefficient μ0.
    BelowReference,
}

/// A parameter that belongs to one evolution only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Key in scenes.
    pub key: &'static str,
    /// Unit.
    pub unit: Unit,
    /// Admissible values.
    pub bound: Bound,
    /// True if the law can be built without it.
    pub optional: bool,
    /// A usual value, as written in scenes.
    pub example: &'static str,
    /// Meaning, in Markdown.
    pub meaning: &'static str,
}

/// State variable s of an evolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variable {
    /// s = ln(Vref θ/(n L)), on which memories act through 1/b.
    Logarithm {
        /// n \[-\].
        lengths: f64,
    },
    /// s = φ, the contribution to μ.
    Contribution {
        /// True if φ = b ln(Vref θ/L) defines a θ.
        has_theta: bool,
    },
}

impl Variable {
    /// t \[s\] and c of `θ = t exp(c s)`, where the law has a θ; lengths in m, slip rates in m/s.
    #[must_use]
    pub fn theta(self, b: f64, length: f64, v_ref: f64) -> Option<(f64, f64)> {
        match self {
            Self::Logarithm { lengths } => Some((lengths * length / v_ref, 1.0)),
            Self::Contribution { has_theta } => (has_theta && b > 0.0).then(|| (length / v_ref, 1.0 / b)),
        }
    }
}

/// Loss of strength at a rupture front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Front {
    /// Strength falls over a slip that grows with the increase of the slip rate, as with the ageing law.
    Ageing,
    /// Strength falls over L, however large the drop, as with the slip law.
    Slip {
        /// Index of the parameter to which μ falls at high rates, where it is below the steady state given by b.
        weakened: Option<usize>,
    },
}

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Definition {
    /// Name in scenes.
    pub name: &'static str,
    /// Evolution of the state variable, in Markdown.
    pub equation: &'static str,
    /// Parameters that only this law has.
    pub parameters: &'static [Parameter],
    /// Reason why it may have only one state variable, where this is so.
    pub one_state: Option<&'static str>,
    /// Index of the parameter that is a memory of shear traction. Such a memory acts through the state and needs b > 0.
    pub memory: Option<usize>,
    /// State variable.
    pub variable: Variable,
    /// Loss of strength at a rupture front.
    pub front: Front,
}

impl Definition {
    /// True if the common parameters alone define the law.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.parameters.iter().all(|parameter| parameter.optional)
    }
}

/// Parameters that all evolutions share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Common {
    /// μ0 of the strength \[-\].
    pub mu0: f64,
    /// a of the strength \[-\].
    pub a: f64,
    /// Vref \[m/s\].
    pub v_ref: f64,
    /// b \[-\].
    pub b: f64,
    /// L \[m\].
    pub length: f64,
}

/// An evolution of the table.
pub trait TableEvolution: Evolution {
    /// Its row of the table.
    const DEFINITION: Definition;

    /// Builds the law; `own` holds the values of the parameters that only this law has, in the order of the row.
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    fn build(common: &Common, own: &[Option<f64>]) -> Result<Self, Failure>;
}

/// Value of a parameter that the law needs.
pub(super) fn needed(own: &[Option<f64>], index: usize, name: &'static str) -> Result<f64, Failure> {
    let absent = Failure::Parameter { name, value: f64::NAN, admissible: "a value" };
    own.get(index).copied().flatten().ok_or(absent)
}
