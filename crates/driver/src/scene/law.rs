//! Which friction law a scene means, complete and in range.

mod reader;
mod refused;
mod several;

pub use refused::refused;
pub use several::Several;

use super::model::{LawSpec, Spanned};
use super::near;
use crate::diagnostic::Diagnostic;
use reader::Reader;
use std::ops::Range;

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

/// Kinds of law with the parameters of each.
const KINDS: [(&str, &[&str]); 6] = [
    ("tied", &[]),
    ("coulomb", &["mu", "f_limit"]),
    ("static-kinetic", &["mu_s", "mu_k", "f_limit"]),
    ("slip-weakening", &["mu_s", "mu_k", "d_c", "f_limit"]),
    ("rate", &["form", "mu0", "a", "v_ref", "v_cut", "activation", "t_ref", "temperature", "f_limit"]),
    (
        "rate-and-state",
        &[
            "form",
            "evolution",
            "mu0",
            "a",
            "b",
            "l",
            "v_ref",
            "v_initial",
            "v_cut",
            "v_cut_state",
            "alpha",
            "normal_initial",
            "c",
            "mu_w",
            "v_w",
            "activation",
            "t_ref",
            "temperature",
            "f_limit",
        ],
    ),
];

/// Forms and evolutions.
const FORMS: [&str; 3] = ["regularised", "bare", "cut-off"];
const EVOLUTIONS: [&str; 5] = ["ageing", "slip", "prz", "nagata", "flash"];

/// Parameters of one form or evolution only.
const PARTICULAR: [(&str, &str, &str); 5] = [
    ("v_cut", "form", "cut-off"),
    ("v_cut_state", "evolution", "ageing"),
    ("c", "evolution", "nagata"),
    ("mu_w", "evolution", "flash"),
    ("v_w", "evolution", "flash"),
];

/// The law of a specification.
///
/// # Errors
/// Every parameter that is missing, belongs to another law, or is out of range.
pub fn choose(spec: &Spanned<LawSpec>) -> Result<LawChoice, Vec<Diagnostic>> {
    choose_with(spec, false)
}

/// The law of a slider, whose evolution effect `b` may be negative.
///
/// # Errors
/// As [`choose`].
pub fn choose_sliding(spec: &Spanned<LawSpec>) -> Result<LawChoice, Vec<Diagnostic>> {
    choose_with(spec, true)
}

fn choose_with(spec: &Spanned<LawSpec>, negative_b: bool) -> Result<LawChoice, Vec<Diagnostic>> {
    let law = spec.get_ref();
    let kinds = || KINDS.iter().map(|k| k.0);
    let Some(kind) = &law.kind else {
        let help = format!("add `kind = ..`; the kinds are {}", kinds().collect::<Vec<_>>().join(", "));
        return Err(vec![Diagnostic::at(spec.span(), "the law has no kind", help)]);
    };
    let Some((name, parameters)) = KINDS.iter().find(|k| k.0 == kind.get_ref()) else {
        return Err(vec![Diagnostic::at(
            kind.span(),
            format!("there is no law of kind `{}`", kind.get_ref()),
            near::suggest(kind.get_ref(), "kinds", kinds()),
        )]);
    };
    let mut errors = foreign(law, name, parameters);
    errors.extend(particular(law, parameters));
    let mut reader = Reader { kind: name, place: spec.span(), errors, negative_b };
    let choice = reader.choice(law);
    match choice {
        Some(choice) if reader.errors.is_empty() => Ok(choice),
        _ => Err(reader.errors),
    }
}

/// Keys with their places where they are given.
macro_rules! places {
    ($law:ident: $($key:ident)*) => {
        [$((stringify!($key), $law.$key.as_ref().map(Spanned::span))),*]
    };
}

/// Parameters given, with their places, in the order of the specification.
fn given(law: &LawSpec) -> Vec<(&'static str, Range<usize>)> {
    let places = places!(law: mu mu_s mu_k d_c form evolution mu0 a b l v_ref v_initial v_cut v_cut_state alpha normal_initial
                         c mu_w v_w activation t_ref temperature f_limit);
    places.into_iter().filter_map(|(name, place)| place.map(|p| (name, p))).collect()
}

fn foreign(law: &LawSpec, kind: &str, parameters: &[&str]) -> Vec<Diagnostic> {
    let strange = given(law).into_iter().filter(|(name, _)| !parameters.contains(name));
    strange
        .map(|(name, place)| {
            let owners: Vec<String> =
                KINDS.iter().filter(|k| k.1.contains(&name)).map(|k| format!("\"{}\"", k.0)).collect();
            Diagnostic::at(
                place,
                format!(
                    "`{name}` is not a parameter of the law \"{kind}\"; it belongs to {}",
                    owners.join(" and ")
                ),
                match parameters {
                    [] => format!("remove it; \"{kind}\" has no parameters"),
                    _ => format!("remove it; \"{kind}\" has {}", parameters.join(", ")),
                },
            )
        })
        .collect()
}

/// Parameters of a form or evolution other than the chosen one.
fn particular(law: &LawSpec, parameters: &[&str]) -> Vec<Diagnostic> {
    let form = law.form.as_ref().map_or(FORMS[0], |f| f.get_ref());
    let evolution = law.evolution.as_ref().map_or("", |e| e.get_ref());
    let mut errors = Vec::new();
    for (name, place) in given(law).into_iter().filter(|(name, _)| parameters.contains(name)) {
        let Some((_, what, owner)) = PARTICULAR.iter().find(|p| p.0 == name) else { continue };
        let (chosen, known) = if *what == "form" { (form, &FORMS[..]) } else { (evolution, &EVOLUTIONS[..]) };
        if chosen != *owner && known.contains(&chosen) {
            let message =
                format!("`{name}` is not a parameter of the {what} \"{chosen}\"; it belongs to \"{owner}\"");
            errors.push(Diagnostic::at(place, message, format!("remove it, or use `{what} = \"{owner}\"`")));
        }
    }
    errors
}
