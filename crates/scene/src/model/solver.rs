//! The table `[solver]`: solution of the linear systems of the steps.

use super::Spanned;
use crate::units::Memory;
use schemars::JsonSchema;
use serde::Deserialize;

/// Solution of the linear systems of the steps.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// Method: `"auto"` (default), `"direct"` or `"iterative"`.
    #[serde(default)]
    pub method: Option<Spanned<Method>>,
    /// Memory limit of the solver; default `"8 GiB"`.
    pub memory: Option<Spanned<Memory>>,
    /// Iterative: admissible residual of a solution over its load, 1e-14 to 1e-2, default 1e-10 \[-\].
    pub tolerance: Option<Spanned<f64>>,
    /// Iterative: largest number of iterations per solution, default 2000.
    pub most_iterations: Option<Spanned<usize>>,
}

/// Methods of solution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Direct if it fits into memory; otherwise iterative for linear bodies in space without interfaces.
    #[default]
    Auto,
    /// Factorisation.
    Direct,
    /// Conjugate gradients with smoothed aggregation.
    Iterative,
}

impl Solver {
    /// Method, with its default.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method.as_ref().map(|m| *m.get_ref()).unwrap_or_default()
    }
}
