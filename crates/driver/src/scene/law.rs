//! Which law a scene chose, and whether its parameters are complete and its own.

use super::SceneError;
use super::model::{LawSpec, Spanned};
use std::ops::Range;

/// A law with its parameters in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LawChoice {
    /// Constant coefficient.
    Coulomb {
        /// μ.
        mu: f64,
        /// F_limit \[Pa\].
        f_limit: Option<f64>,
    },
    /// Velocity-dependent, no state.
    Rate {
        /// Strength form.
        form: Form,
        /// μ0.
        mu0: f64,
        /// a.
        a: f64,
        /// Vref \[m/s\].
        v_ref: f64,
        /// F_limit \[Pa\].
        f_limit: Option<f64>,
    },
    /// Rate and state.
    RateAndState {
        /// Strength form.
        form: Form,
        /// Evolution.
        evolution: Evolution,
        /// μ0.
        mu0: f64,
        /// a.
        a: f64,
        /// b.
        b: f64,
        /// L \[m\].
        l: f64,
        /// Vref \[m/s\].
        v_ref: f64,
        /// Slip rate whose steady state is the initial state \[m/s\].
        v_initial: f64,
        /// F_limit \[Pa\].
        f_limit: Option<f64>,
    },
}

/// Strength forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// asinh.
    Regularised,
    /// Logarithm.
    Bare,
}

/// Evolutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evolution {
    /// Dieterich.
    Ageing,
    /// Ruina.
    Slip,
}

/// Kinds that exist, with the parameters each takes.
const KINDS: [(&str, &[&str]); 3] = [
    ("coulomb", &["mu", "f_limit"]),
    ("rate", &["form", "mu0", "a", "v_ref", "f_limit"]),
    ("rate-and-state", &["form", "evolution", "mu0", "a", "b", "l", "v_ref", "v_initial", "f_limit"]),
];

/// A parameter as given: its key, value in SI where it is a number, and place.
struct Given {
    key: &'static str,
    value: Option<f64>,
    span: Range<usize>,
}

fn given(spec: &LawSpec) -> Vec<Given> {
    let mut list = Vec::new();
    let mut number = |key, value: Option<(f64, Range<usize>)>| {
        if let Some((value, span)) = value {
            list.push(Given { key, value: Some(value), span });
        }
    };
    number("mu", spec.mu.as_ref().map(|s| (*s.get_ref(), s.span())));
    number("mu0", spec.mu0.as_ref().map(|s| (*s.get_ref(), s.span())));
    number("a", spec.a.as_ref().map(|s| (*s.get_ref(), s.span())));
    number("b", spec.b.as_ref().map(|s| (*s.get_ref(), s.span())));
    number("l", spec.l.as_ref().map(|s| (s.get_ref().0, s.span())));
    number("v_ref", spec.v_ref.as_ref().map(|s| (s.get_ref().0, s.span())));
    number("v_initial", spec.v_initial.as_ref().map(|s| (s.get_ref().0, s.span())));
    number("f_limit", spec.f_limit.as_ref().map(|s| (s.get_ref().0, s.span())));
    for (key, text) in [("form", &spec.form), ("evolution", &spec.evolution)] {
        if let Some(text) = text {
            list.push(Given { key, value: None, span: text.span() });
        }
    }
    list
}

/// The law a scene chose.
///
/// # Errors
/// Everything that is wrong with it.
pub fn choose(law: &Spanned<LawSpec>) -> Result<LawChoice, Vec<SceneError>> {
    let spec = law.get_ref();
    let names = KINDS.map(|k| k.0).join(", ");
    let Some(kind) = &spec.kind else {
        return Err(vec![SceneError::at(law.span(), "the law has no `kind`", format!("kinds are {names}"))]);
    };
    let Some((_, own)) = KINDS.iter().find(|k| k.0 == kind.get_ref()) else {
        let message = format!("there is no law `{}`", kind.get_ref());
        return Err(vec![SceneError::at(kind.span(), message, format!("kinds are {names}"))]);
    };
    let given = given(spec);
    let mut errors = foreign(kind.get_ref(), own, &given);
    errors.extend(ranges(kind.get_ref(), &given));
    let value = |key: &str| given.iter().find(|g| g.key == key).and_then(|g| g.value);
    let mut need = |key: &'static str| {
        value(key).unwrap_or_else(|| {
            let message = format!("law `{}` needs `{key}`", kind.get_ref());
            errors.push(SceneError::at(law.span(), message, format!("its parameters are {}", own.join(", "))));
            f64::NAN
        })
    };
    let f_limit = value("f_limit");
    let choice = match kind.get_ref().as_str() {
        "coulomb" => LawChoice::Coulomb { mu: need("mu"), f_limit },
        "rate" => LawChoice::Rate {
            mu0: need("mu0"),
            a: need("a"),
            v_ref: need("v_ref"),
            form: form(spec, &mut errors),
            f_limit,
        },
        _ => LawChoice::RateAndState {
            mu0: need("mu0"),
            a: need("a"),
            b: need("b"),
            l: need("l"),
            v_ref: need("v_ref"),
            v_initial: value("v_initial").or(value("v_ref")).unwrap_or(f64::NAN),
            form: form(spec, &mut errors),
            evolution: evolution(law, &mut errors),
            f_limit,
        },
    };
    if errors.is_empty() { Ok(choice) } else { Err(errors) }
}

/// Parameters of another law.
fn foreign(kind: &str, own: &[&str], given: &[Given]) -> Vec<SceneError> {
    given
        .iter()
        .filter(|g| !own.contains(&g.key))
        .map(|g| {
            let owners: Vec<&str> = KINDS.iter().filter(|k| k.1.contains(&g.key)).map(|k| k.0).collect();
            SceneError::at(
                g.span.clone(),
                format!("`{}` is no parameter of law `{kind}`: it belongs to {}", g.key, owners.join(", ")),
                format!("parameters of `{kind}` are {}", own.join(", ")),
            )
        })
        .collect()
}

/// Admissible ranges, and laws that are ill-posed in a continuum.
fn ranges(kind: &str, given: &[Given]) -> Vec<SceneError> {
    let mut errors = Vec::new();
    for g in given {
        let Some(value) = g.value else { continue };
        let admissible = match g.key {
            "a" if kind == "rate" && value < 0.0 => {
                errors.push(SceneError::at(
                    g.span.clone(),
                    "strength that falls with the slip rate, without a state, is ill-posed in a quasi-static continuum",
                    "give a > 0, or a state with a slip length (`rate-and-state` with b > a)",
                ));
                continue;
            }
            "a" | "l" | "v_ref" | "v_initial" | "f_limit" => (value > 0.0 && value.is_finite(), "a positive number"),
            "mu" => (value >= 0.0 && value.is_finite(), "zero or a positive number"),
            _ => (value.is_finite(), "a finite number"),
        };
        if !admissible.0 {
            errors.push(SceneError::at(
                g.span.clone(),
                format!("{} = {value} is not admissible", g.key),
                format!("{} must be {}", g.key, admissible.1),
            ));
        }
    }
    errors
}

fn form(spec: &LawSpec, errors: &mut Vec<SceneError>) -> Form {
    match spec.form.as_ref().map(|f| (f.get_ref().as_str(), f.span())) {
        None | Some(("regularised", _)) => Form::Regularised,
        Some(("bare", span)) => {
            errors.push(SceneError::at(
                span,
                "the bare logarithm has no value at rest, and every stage of a contact scene starts from rest",
                "use form = \"regularised\"",
            ));
            Form::Bare
        }
        Some((other, span)) => {
            errors.push(SceneError::at(span, format!("there is no form `{other}`"), "forms are regularised, bare"));
            Form::Regularised
        }
    }
}

fn evolution(law: &Spanned<LawSpec>, errors: &mut Vec<SceneError>) -> Evolution {
    match law.get_ref().evolution.as_ref().map(|e| (e.get_ref().as_str(), e.span())) {
        Some(("ageing", _)) => Evolution::Ageing,
        Some(("slip", _)) => Evolution::Slip,
        Some((other, span)) => {
            errors.push(SceneError::at(span, format!("there is no evolution `{other}`"), "evolutions are ageing, slip"));
            Evolution::Ageing
        }
        None => {
            errors.push(SceneError::at(
                law.span(),
                "law `rate-and-state` needs `evolution`",
                "evolutions are ageing, slip",
            ));
            Evolution::Ageing
        }
    }
}
