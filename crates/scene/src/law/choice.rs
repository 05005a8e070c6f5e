//! A complete friction law.

/// Forms of the rate-dependent strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// With asinh; regular at rest.
    Regularised,
    /// The bare logarithm; undefined at rest.
    Bare,
    /// With a direct effect that saturates; undefined at rest.
    CutOff {
        /// Cut-off rate V1 of the direct effect \[m/s\].
        v_cut: f64,
    },
}

/// Effect of the temperature of the interface: an Arrhenius factor of the slip rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// Activation energy Q \[J/mol\].
    pub activation: f64,
    /// Reference temperature, at which the parameters hold \[K\].
    pub t_ref: f64,
    /// Temperature \[K\].
    pub temperature: f64,
}

/// The rate-dependent strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// Form.
    pub form: Form,
    /// Reference coefficient \[-\].
    pub mu0: f64,
    /// Direct effect \[-\].
    pub a: f64,
    /// Reference slip rate \[m/s\].
    pub v_ref: f64,
    /// Temperature effect, if any.
    pub heat: Option<Heat>,
}

/// Evolution of the state.
#[derive(Clone, Debug, PartialEq)]
pub struct Evolution {
    /// Name.
    pub name: &'static str,
    /// Values of its specific parameters in SI units, in the order of its row in [`Laws`](super::Laws).
    pub own: Vec<Option<f64>>,
}

/// A state variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Evolution effect \[-\].
    pub b: f64,
    /// Characteristic slip \[m\].
    pub l: f64,
    /// Memory of normal traction \[-\].
    pub alpha: f64,
}

/// A friction law with exactly the parameters it needs.
#[derive(Clone, Debug, PartialEq)]
pub enum LawChoice {
    /// A law with an elastic domain.
    Yielding {
        /// Kind.
        kind: &'static str,
        /// Values of its parameters in SI units, in the order of its row in [`Laws`](super::Laws).
        own: Vec<f64>,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
    /// A coefficient that depends on the slip rate.
    Rate {
        /// Strength.
        strength: Strength,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
    /// A coefficient that depends on the slip rate and one or more states.
    RateAndState {
        /// Strength.
        strength: Strength,
        /// Evolution of all state variables.
        evolution: Evolution,
        /// The state variables.
        states: Vec<State>,
        /// Slip rate of the initial steady state \[m/s\].
        v_initial: f64,
        /// Normal traction of the initial steady state \[Pa\]; needed if a state variable remembers normal traction.
        normal_initial: Option<f64>,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
}

impl LawChoice {
    /// True if two rate-dependent laws differ only in parameters that may vary from point to point. Their form, temperature,
    /// evolution and number of states are the same.
    #[must_use]
    pub fn same_kind(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Rate { strength: s, .. }, Self::Rate { strength: o, .. }) => {
                s.form == o.form && s.heat == o.heat
            }
            (
                Self::RateAndState { strength: s, evolution: e, states, .. },
                Self::RateAndState { strength: o, evolution: f, states: others, .. },
            ) => s.form == o.form && s.heat == o.heat && e == f && states.len() == others.len(),
            _ => false,
        }
    }
}

/// Names of the forms; the first is the default.
pub(super) const FORMS: [&str; 3] = ["regularised", "bare", "cut-off"];
