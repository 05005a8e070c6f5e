//! Which friction law a scene means, complete and in range.

use super::model::{LawSpec, Spanned};
use super::{SceneError, near};
use std::ops::Range;

/// Forms of the rate-dependent strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// With asinh: regular at rest.
    Regularised,
    /// The bare logarithm: not defined at rest.
    Bare,
}

/// Evolution of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evolution {
    /// dθ/dt = 1 - V θ/L.
    Ageing,
    /// dθ/dt = -(V θ/L) ln(V θ/L).
    Slip,
}

/// A friction law with exactly the parameters it needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LawChoice {
    /// A constant coefficient.
    Coulomb {
        /// Friction coefficient \[-\].
        mu: f64,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
    /// A coefficient that depends on the slip rate.
    Rate {
        /// Form of the strength.
        form: Form,
        /// Reference coefficient \[-\].
        mu0: f64,
        /// Direct effect \[-\].
        a: f64,
        /// Reference slip rate \[m/s\].
        v_ref: f64,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
    /// A coefficient that depends on the slip rate and a state.
    RateAndState {
        /// Form of the strength.
        form: Form,
        /// Evolution of the state.
        evolution: Evolution,
        /// Reference coefficient \[-\].
        mu0: f64,
        /// Direct effect \[-\].
        a: f64,
        /// Evolution effect \[-\].
        b: f64,
        /// Characteristic slip \[m\].
        l: f64,
        /// Reference slip rate \[m/s\].
        v_ref: f64,
        /// Slip rate of the steady state the points start from \[m/s\].
        v_initial: f64,
        /// Largest shear traction \[Pa\].
        f_limit: Option<f64>,
    },
}

/// Kinds of law with the parameters of each.
const KINDS: [(&str, &[&str]); 3] = [
    ("coulomb", &["mu", "f_limit"]),
    ("rate", &["form", "mu0", "a", "v_ref", "f_limit"]),
    ("rate-and-state", &["form", "evolution", "mu0", "a", "b", "l", "v_ref", "v_initial", "f_limit"]),
];

/// The law of a specification.
///
/// # Errors
/// Every parameter that is missing, belongs to another law, or is out of range.
pub fn choose(spec: &Spanned<LawSpec>) -> Result<LawChoice, Vec<SceneError>> {
    let law = spec.get_ref();
    let kinds = || KINDS.iter().map(|k| k.0);
    let Some(kind) = &law.kind else {
        let help = format!("add `kind = ..`; the kinds are {}", kinds().collect::<Vec<_>>().join(", "));
        return Err(vec![SceneError::at(spec.span(), "the law has no kind", help)]);
    };
    let Some((name, parameters)) = KINDS.iter().find(|k| k.0 == kind.get_ref()) else {
        return Err(vec![SceneError::at(
            kind.span(),
            format!("there is no law of kind `{}`", kind.get_ref()),
            near::suggest(kind.get_ref(), "kinds", kinds()),
        )]);
    };
    let mut reader = Reader { kind: name, place: spec.span(), errors: foreign(law, name, parameters) };
    let choice = reader.choice(law);
    match choice {
        Some(choice) if reader.errors.is_empty() => Ok(choice),
        _ => Err(reader.errors),
    }
}

/// Parameters given, with their places, in the order of the specification.
fn given(law: &LawSpec) -> Vec<(&'static str, Range<usize>)> {
    let places = [
        ("mu", law.mu.as_ref().map(Spanned::span)),
        ("form", law.form.as_ref().map(Spanned::span)),
        ("evolution", law.evolution.as_ref().map(Spanned::span)),
        ("mu0", law.mu0.as_ref().map(Spanned::span)),
        ("a", law.a.as_ref().map(Spanned::span)),
        ("b", law.b.as_ref().map(Spanned::span)),
        ("l", law.l.as_ref().map(Spanned::span)),
        ("v_ref", law.v_ref.as_ref().map(Spanned::span)),
        ("v_initial", law.v_initial.as_ref().map(Spanned::span)),
        ("f_limit", law.f_limit.as_ref().map(Spanned::span)),
    ];
    places.into_iter().filter_map(|(name, place)| place.map(|p| (name, p))).collect()
}

fn foreign(law: &LawSpec, kind: &str, parameters: &[&str]) -> Vec<SceneError> {
    let strange = given(law).into_iter().filter(|(name, _)| !parameters.contains(name));
    strange
        .map(|(name, place)| {
            let owners: Vec<String> =
                KINDS.iter().filter(|k| k.1.contains(&name)).map(|k| format!("\"{}\"", k.0)).collect();
            SceneError::at(
                place,
                format!(
                    "`{name}` is not a parameter of the law \"{kind}\"; it belongs to {}",
                    owners.join(" and ")
                ),
                format!("remove it; \"{kind}\" has {}", parameters.join(", ")),
            )
        })
        .collect()
}

/// Reads parameters and collects what is wrong with them.
struct Reader {
    kind: &'static str,
    place: Range<usize>,
    errors: Vec<SceneError>,
}

impl Reader {
    fn choice(&mut self, law: &LawSpec) -> Option<LawChoice> {
        let f_limit = match &law.f_limit {
            None => Some(None),
            Some(f) => self.positive("f_limit", Some((f.get_ref().0, f.span())), "100 MPa").map(Some),
        };
        if self.kind == "coulomb" {
            let mu = self.number("mu", law.mu.as_ref(), "0.6", (0.0, true));
            return Some(LawChoice::Coulomb { mu: mu?, f_limit: f_limit? });
        }
        let form = self.form(law);
        let mu0 = self.number("mu0", law.mu0.as_ref(), "0.6", (0.0, false));
        let a = self.direct_effect(law);
        let v_ref = self.positive("v_ref", law.v_ref.as_ref().map(|v| (v.get_ref().0, v.span())), "1 um/s");
        if self.kind == "rate" {
            return Some(LawChoice::Rate { form: form?, mu0: mu0?, a: a?, v_ref: v_ref?, f_limit: f_limit? });
        }
        let evolution = self.evolution(law);
        let b = self.number("b", law.b.as_ref(), "0.015", (0.0, true));
        let l = self.positive("l", law.l.as_ref().map(|v| (v.get_ref().0, v.span())), "10 um");
        let start = law.v_initial.as_ref().map(|v| (v.get_ref().0, v.span()));
        let v_initial = self.positive("v_initial", start, "1 um/s");
        Some(LawChoice::RateAndState {
            form: form?,
            evolution: evolution?,
            mu0: mu0?,
            a: a?,
            b: b?,
            l: l?,
            v_ref: v_ref?,
            v_initial: v_initial?,
            f_limit: f_limit?,
        })
    }

    fn missing(&mut self, name: &str, example: &str) {
        self.errors.push(SceneError::at(
            self.place.clone(),
            format!("the law \"{}\" needs `{name}`", self.kind),
            format!("add it, such as `{name} = {example}`"),
        ));
    }

    fn positive(&mut self, name: &str, value: Option<(f64, Range<usize>)>, example: &str) -> Option<f64> {
        let Some((value, place)) = value else {
            self.missing(name, &format!("\"{example}\""));
            return None;
        };
        if value > 0.0 && value.is_finite() {
            return Some(value);
        }
        let help = format!("such as `{name} = \"{example}\"`");
        self.errors.push(SceneError::at(place, format!("`{name}` must be positive, found {value:?}"), help));
        None
    }

    /// A number above `bound.0`, or equal to it where `bound.1`.
    fn number(
        &mut self,
        name: &str,
        v: Option<&Spanned<f64>>,
        example: &str,
        bound: (f64, bool),
    ) -> Option<f64> {
        let Some(v) = v else {
            self.missing(name, example);
            return None;
        };
        let value = *v.get_ref();
        if value.is_finite() && (value > bound.0 || (bound.1 && value == bound.0)) {
            return Some(value);
        }
        let sign = if bound.1 { "not negative" } else { "positive" };
        let message = format!("`{name}` must be finite and {sign}, found {value:?}");
        self.errors.push(SceneError::at(v.span(), message, format!("such as `{name} = {example}`")));
        None
    }

    fn direct_effect(&mut self, law: &LawSpec) -> Option<f64> {
        let Some(a) = &law.a else {
            self.missing("a", "0.01");
            return None;
        };
        let value = *a.get_ref();
        if value > 0.0 && value.is_finite() {
            return Some(value);
        }
        let (message, help) = if value < 0.0 && value.is_finite() && self.kind == "rate" {
            (
                format!(
                    "the problem is ill-posed: with a = {value:?} the strength falls with the slip rate at once, and \
                     a quasi-static continuum has neither a state, a slip length nor inertia to bound how fast slip \
                     grows at the shortest wavelengths, so the answer would be the mesh's"
                ),
                "for weakening use `kind = \"rate-and-state\"` with 0 < a < b and a slip length `l`"
                    .to_string(),
            )
        } else if value < 0.0 && value.is_finite() {
            (
                format!(
                    "the problem is ill-posed: a = {value:?} lets the strength fall at once with the slip rate"
                ),
                "a > 0; weakening comes from b > a, over the slip length `l`".to_string(),
            )
        } else if value == 0.0 {
            (
                "a = 0 leaves no direct effect, so the slip rate cannot be found from the strength"
                    .to_string(),
                "a > 0; for a constant coefficient use `kind = \"coulomb\"`".to_string(),
            )
        } else {
            (format!("`a` must be finite, found {value:?}"), "such as `a = 0.01`".to_string())
        };
        self.errors.push(SceneError::at(a.span(), message, help));
        None
    }

    fn form(&mut self, law: &LawSpec) -> Option<Form> {
        let Some(form) = &law.form else { return Some(Form::Regularised) };
        match form.get_ref().as_str() {
            "regularised" => Some(Form::Regularised),
            "bare" => Some(Form::Bare),
            other => self.unknown(form.span(), other, "form", &["regularised", "bare"]),
        }
    }

    fn evolution(&mut self, law: &LawSpec) -> Option<Evolution> {
        let Some(evolution) = &law.evolution else {
            self.missing("evolution", "\"ageing\"` or `evolution = \"slip\"");
            return None;
        };
        match evolution.get_ref().as_str() {
            "ageing" => Some(Evolution::Ageing),
            "slip" => Some(Evolution::Slip),
            other => self.unknown(evolution.span(), other, "evolution", &["ageing", "slip"]),
        }
    }

    fn unknown<T>(&mut self, place: Range<usize>, name: &str, what: &str, known: &[&str]) -> Option<T> {
        let help = near::suggest(name, "choices", known.iter().copied());
        self.errors.push(SceneError::at(place, format!("there is no {what} `{name}`"), help));
        None
    }
}
