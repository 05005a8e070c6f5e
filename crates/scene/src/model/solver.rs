//! The table `[solver]`: solution of the linear systems of the steps.

use super::Spanned;
use crate::key_default::usual;
use crate::units::Memory;
use crate::{defaults, kind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Solution of the linear systems of the steps.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// Method: `"auto"`, `"direct"` or `"iterative"`.
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(Method::default())))]
    #[serde(default)]
    pub method: Option<Spanned<Method>>,
    /// Memory limit of the solver.
    #[schemars(extend("x-default" = usual(defaults::MEMORY)))]
    pub memory: Option<Spanned<Memory>>,
    /// Admissible residual of a solution over its load, 1e-14 to 1e-2 \[-\].
    #[schemars(extend("x-with" = ["method", "iterative", "auto"], "x-kinds" = kind::INTERFACES, "x-default" = usual(defaults::SOLVER_TOLERANCE)))]
    pub tolerance: Option<Spanned<f64>>,
    /// Largest number of iterations per solution.
    #[schemars(extend("x-with" = ["method", "iterative", "auto"], "x-kinds" = kind::INTERFACES, "x-default" = usual(defaults::MOST_ITERATIONS)))]
    pub most_iterations: Option<Spanned<usize>>,
}

/// Methods of solution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Direct if it fits into memory; otherwise iterative in space, for steps to equilibrium.
    #[default]
    Auto,
    /// Factorisation.
    Direct,
    /// Conjugate gradients, or GMRES for unsymmetric matrices, with smoothed aggregation.
    Iterative,
}

impl Solver {
    /// Method, with its default.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method.as_ref().map(|m| *m.get_ref()).unwrap_or_default()
    }
}
