//! Which friction law a scene means, complete and in range.

mod choice;
mod reader;
mod several;

pub use choice::{Evolution, Form, Heat, LawChoice, State, Strength};
pub use several::Several;

use super::model::{LawSpec, Spanned};
use super::near;
use crate::diagnostic::Diagnostic;
use choice::{EVOLUTIONS, FORMS};
use reader::Reader;
use std::ops::Range;

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
#[must_use]
pub fn given(law: &LawSpec) -> Vec<(&'static str, Range<usize>)> {
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
