//! The table `[solver]`: how the linear systems of the steps are solved.

use super::Spanned;
use crate::units::Memory;
use serde::Deserialize;

/// Solution of the linear systems of the steps.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// Method (default: auto).
    #[serde(default)]
    pub method: Option<Spanned<Method>>,
    /// Memory the factorisations may take \[bytes\].
    pub memory: Option<Spanned<Memory>>,
    /// Iterative: relative residual at which a solution is accepted \[-\].
    pub tolerance: Option<Spanned<f64>>,
    /// Iterative: iterations after which a solution is given up.
    pub most_iterations: Option<Spanned<usize>>,
}

/// Methods that exist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Direct where it fits into the memory; else iterative for linear bodies in space without interfaces.
    #[default]
    Auto,
    /// Factorisation.
    Direct,
    /// Conjugate gradients with smoothed aggregation.
    Iterative,
}

impl Solver {
    /// The method.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method.as_ref().map(|m| *m.get_ref()).unwrap_or_default()
    }
}
