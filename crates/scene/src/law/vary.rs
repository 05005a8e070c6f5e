//! Parameters of a law that may vary from point to point.

use super::choice::LawChoice;
use super::table::Bound::{self, NotNegative, Positive};
use super::table::Laws;

impl LawChoice {
    /// Returns the bound of a parameter that may vary from point to point; `None` if the law does not have exactly one of this
    /// name.
    #[must_use]
    pub fn varies(&self, key: &str, laws: &Laws) -> Option<Bound> {
        self.clone().parameter(key, laws).map(|(_, bound)| bound)
    }

    /// Value of a parameter that may vary from point to point, in SI; `None` if the law does not have exactly one of this name.
    #[must_use]
    pub fn value(&self, key: &str, laws: &Laws) -> Option<f64> {
        self.clone().parameter(key, laws).map(|(value, _)| *value)
    }

    /// Returns the law with another value of a parameter, in SI; `None` if the law does not have exactly one of this name.
    #[must_use]
    pub fn with(mut self, key: &str, value: f64, laws: &Laws) -> Option<Self> {
        *self.parameter(key, laws)?.0 = value;
        Some(self)
    }

    /// Position of a parameter that may vary from point to point, with its bound.
    fn parameter(&mut self, key: &str, laws: &Laws) -> Option<(&mut f64, Bound)> {
        let (strength, limit) = match self {
            Self::Yielding { kind, own, f_limit } => {
                let row = laws.kind(kind)?;
                if key == "f_limit" {
                    return row.capped.then(|| (f_limit.get_or_insert(f64::INFINITY), Positive));
                }
                let k = row.parameters.iter().position(|p| p.key == key)?;
                return Some((own.get_mut(k)?, row.parameters[k].bound));
            }
            Self::Rate { strength, f_limit } => (strength, f_limit),
            Self::RateAndState { strength, states, v_initial, f_limit, .. } => {
                match (key, states.as_mut_slice()) {
                    ("b", [state]) => return Some((&mut state.b, NotNegative)),
                    ("l", [state]) => return Some((&mut state.l, Positive)),
                    ("v_initial", _) => return Some((v_initial, Positive)),
                    _ => (strength, f_limit),
                }
            }
        };
        match key {
            "mu0" => Some((&mut strength.mu0, Positive)),
            "a" => Some((&mut strength.a, Positive)),
            "f_limit" => Some((limit.get_or_insert(f64::INFINITY), Positive)),
            _ => None,
        }
    }
}
