//! The methods and their options.

use std::str::FromStr;

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Backward differentiation of orders 1 to 5, implicit (diffsol).
    Bdf,
    /// Trapezoidal rule and backward differentiation in one step, order 2, implicit (diffsol).
    TrBdf2,
    /// Diagonally implicit Runge-Kutta of order 3 with four stages, the first explicit (diffsol).
    Esdirk34,
    /// Tsitouras 5(4), explicit (diffsol).
    Tsit45,
    /// Dormand-Prince 8(5,3), explicit.
    Dop853,
    /// Tsitouras 5(4), explicit.
    Tsit5,
    /// Radau IIA of order 5, implicit.
    Radau5,
    /// Dormand-Prince 8(5,3) and, where stability limits its steps, Radau IIA.
    Switching,
    /// Runge-Kutta-Chebyshev of order 2, explicit with long steps in stiff problems whose eigenvalues are real and negative.
    Rkc2,
    /// Tsitouras 5(4) and, where stability limits its steps, Runge-Kutta-Chebyshev.
    Stabilised,
}

impl Method {
    /// The methods for small systems of any kind.
    pub const ALL: [Self; 8] = [
        Self::Bdf,
        Self::TrBdf2,
        Self::Esdirk34,
        Self::Tsit45,
        Self::Dop853,
        Self::Tsit5,
        Self::Radau5,
        Self::Switching,
    ];

    /// The methods that need no Jacobian, for systems of many unknowns.
    pub const EXPLICIT: [Self; 5] = [Self::Stabilised, Self::Tsit5, Self::Dop853, Self::Rkc2, Self::Tsit45];

    /// The name, as in scenes.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bdf => "bdf",
            Self::TrBdf2 => "tr-bdf2",
            Self::Esdirk34 => "esdirk34",
            Self::Tsit45 => "tsit45",
            Self::Dop853 => "dop853",
            Self::Tsit5 => "tsit5",
            Self::Radau5 => "radau5",
            Self::Switching => "switching",
            Self::Rkc2 => "rkc2",
            Self::Stabilised => "stabilised",
        }
    }

    /// True if the method solves equations with the Jacobian, and so takes long steps in stiff problems.
    #[must_use]
    pub const fn implicit(self) -> bool {
        matches!(self, Self::Bdf | Self::TrBdf2 | Self::Esdirk34 | Self::Radau5 | Self::Switching)
    }
}

/// A name that is none of the methods'.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no method of integration is called \"{0}\"")]
pub struct UnknownMethod(pub String);

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .chain(Self::EXPLICIT)
            .find(|m| m.name() == name)
            .ok_or_else(|| UnknownMethod(name.to_owned()))
    }
}

/// Settings of the integration.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The method.
    pub method: Method,
    /// Error of a step allowed over the size of an unknown.
    pub rtol: f64,
    /// Error of a step allowed besides, one per unknown and in its unit.
    pub atol: Vec<f64>,
    /// Length of the first step tried \[s\]; chosen from the rates where absent.
    pub first_step: Option<f64>,
    /// True where a pair of methods begins with the one for stiff equations: see [`Step::next_stiff`](crate::Step::next_stiff).
    pub begin_stiff: bool,
    /// Length no step exceeds \[s\].
    pub largest_step: Option<f64>,
    /// Accepted steps after which to give up.
    pub most_steps: usize,
}
