//! A friction law with what it needs.

/// Forms of the rate-dependent strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// With asinh: regular at rest.
    Regularised,
    /// The bare logarithm: not defined at rest.
    Bare,
    /// With a direct effect that saturates: not defined at rest.
    CutOff {
        /// Cut-off rate V1 of the direct effect \[m/s\].
        v_cut: f64,
    },
}

/// Temperature of the interface, by an Arrhenius factor of the slip rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// Activation energy Q \[J/mol\].
    pub activation: f64,
    /// Temperature of the parameters \[K\].
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
    /// Temperature, where it matters.
    pub heat: Option<Heat>,
}

/// Evolution of the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evolution {
    /// dθ/dt = 1 - V θ/L.
    Ageing {
        /// Cut-off rate V2 of the state effect \[m/s\].
        v_cut: Option<f64>,
    },
    /// dθ/dt = -(V θ/L) ln(V θ/L).
    Slip,
    /// Perrin-Rice-Zheng: dθ/dt = 1 - (V θ/2L)².
    Prz,
    /// Ageing with a memory of shear traction.
    Nagata {
        /// c \[-\].
        c: f64,
    },
    /// The slip law towards a steady state weakened by flash heating.
    Flash {
        /// Fully weakened coefficient \[-\].
        mu_w: f64,
        /// Slip rate at which weakening begins \[m/s\].
        v_w: f64,
    },
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
    /// No slip and no parting.
    Tied,
    /// A constant coefficient.
    Coulomb {
        /// Friction coefficient \[-\].
        mu: f64,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
    /// A coefficient that falls where slip begins.
    StaticKinetic {
        /// Coefficient at rest \[-\].
        mu_s: f64,
        /// Coefficient in slip \[-\].
        mu_k: f64,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
    /// A coefficient that falls linearly with slip.
    SlipWeakening {
        /// Coefficient before slip \[-\].
        mu_s: f64,
        /// Coefficient after slip over `d_c` \[-\].
        mu_k: f64,
        /// Slip over which it falls \[m\].
        d_c: f64,
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
        /// Evolution of every state variable.
        evolution: Evolution,
        /// The state variables.
        states: Vec<State>,
        /// Slip rate of the steady state the points start from \[m/s\].
        v_initial: f64,
        /// Normal traction of that steady state \[Pa\], where a state variable remembers normal traction.
        normal_initial: Option<f64>,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
}

impl LawChoice {
    /// Whether two laws differ in parameters of their points only: a, b, L and the start.
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

/// Forms and evolutions.
pub(super) const FORMS: [&str; 3] = ["regularised", "bare", "cut-off"];
pub(super) const EVOLUTIONS: [&str; 5] = ["ageing", "slip", "prz", "nagata", "flash"];
