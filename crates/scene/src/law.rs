//! The friction law chosen by a scene, complete and with parameters in range.

mod choice;
mod parameters;
mod reader;
mod table;
mod vary;

pub use choice::{Evolution, Form, Heat, LawChoice, State, Strength};
pub use parameters::given;
pub use table::{Bound, EvolutionRow, KindRow, Laws, OrderRow, ParameterRow};

use super::model::{LawSpec, Spanned};
use super::suggestions;
use crate::diagnostic::Diagnostic;
use choice::FORMS;
use reader::Reader;

/// Kinds of law whose strength depends on the slip rate, with the parameters of each. Evolutions add parameters.
const KINDS: [(&str, &[&str]); 2] = [
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
            "alpha",
            "normal_initial",
            "activation",
            "t_ref",
            "temperature",
            "f_limit",
        ],
    ),
];

/// The kind of law with an evolving state.
const EVOLVES: &str = "rate-and-state";

/// Chooses the law of a specification among those known to the program.
///
/// # Errors
/// Every parameter that is missing, belongs to another law, or is out of range.
pub fn choose(spec: &Spanned<LawSpec>, laws: &Laws) -> Result<LawChoice, Vec<Diagnostic>> {
    choose_with(spec, laws, false)
}

/// Chooses the law of a slider, whose evolution effect `b` may be negative.
///
/// # Errors
/// As [`choose`].
pub fn choose_sliding(spec: &Spanned<LawSpec>, laws: &Laws) -> Result<LawChoice, Vec<Diagnostic>> {
    choose_with(spec, laws, true)
}

fn choose_with(spec: &Spanned<LawSpec>, laws: &Laws, negative_b: bool) -> Result<LawChoice, Vec<Diagnostic>> {
    let law = spec.get_ref();
    let kinds = || names(laws);
    let Some(kind) = &law.kind else {
        let help = format!("add `kind = ..`; the kinds are {}", kinds().collect::<Vec<_>>().join(", "));
        return Err(vec![Diagnostic::at(spec.span(), "the law has no kind", help)]);
    };
    let Some(name) = names(laws).find(|name| name == kind.get_ref()) else {
        return Err(vec![Diagnostic::at(
            kind.span(),
            format!("there is no law of kind `{}`", kind.get_ref()),
            suggestions::suggest(kind.get_ref(), "kinds", kinds()),
        )]);
    };
    let mut errors = foreign(law, name, laws);
    errors.extend(particular(law, name, laws));
    let mut reader = Reader { kind: name, place: spec.span(), errors, negative_b, laws };
    let choice = reader.choice(law);
    match choice {
        Some(choice) if reader.errors.is_empty() => Ok(choice),
        _ => Err(reader.errors),
    }
}

/// Names of all kinds.
fn names(laws: &Laws) -> impl Iterator<Item = &'static str> {
    laws.kinds.iter().map(|row| row.name).chain(KINDS.iter().map(|k| k.0))
}

/// Parameters of a kind of law; those of its evolutions come last.
fn parameters(kind: &str, laws: &Laws) -> Vec<&'static str> {
    if let Some(row) = laws.kind(kind) {
        return row.parameters.iter().map(|p| p.key).chain(row.capped.then_some("f_limit")).collect();
    }
    let mut all: Vec<&str> = KINDS.iter().filter(|k| k.0 == kind).flat_map(|k| k.1).copied().collect();
    if kind == EVOLVES {
        all.extend(laws.evolutions.iter().flat_map(|row| &row.parameters).map(|p| p.key));
    }
    all
}

fn foreign(law: &LawSpec, kind: &str, laws: &Laws) -> Vec<Diagnostic> {
    let parameters = parameters(kind, laws);
    let strange = given(law).into_iter().filter(|(name, _)| !parameters.contains(name));
    strange
        .map(|(name, place)| {
            let owns = |kind: &&str| self::parameters(kind, laws).contains(&name);
            let owners = names(laws).filter(owns).map(|k| format!("\"{k}\""));
            let owners: Vec<String> = owners.collect();
            Diagnostic::at(
                place,
                format!(
                    "`{name}` is not a parameter of the law \"{kind}\"; it belongs to {}",
                    owners.join(" and ")
                ),
                match &parameters[..] {
                    [] => format!("remove it; \"{kind}\" has no parameters"),
                    _ => format!("remove it; \"{kind}\" has {}", parameters.join(", ")),
                },
            )
        })
        .collect()
}

/// Reports parameters that belong to another form or evolution than the chosen one.
fn particular(law: &LawSpec, kind: &str, laws: &Laws) -> Vec<Diagnostic> {
    let parameters = parameters(kind, laws);
    let form = law.form.as_ref().map_or(FORMS[0], |f| f.get_ref());
    let evolution = law.evolution.as_ref().map_or("", |e| e.get_ref());
    let mut errors = Vec::new();
    for (name, place) in given(law).into_iter().filter(|(name, _)| parameters.contains(name)) {
        let (what, owner, chosen, known) = match laws.owner(name) {
            Some(owner) => ("evolution", owner, evolution, laws.evolution(evolution).is_some()),
            None if name == "v_cut" => ("form", "cut-off", form, FORMS.contains(&form)),
            None => continue,
        };
        if chosen != owner && known {
            let message =
                format!("`{name}` is not a parameter of the {what} \"{chosen}\"; it belongs to \"{owner}\"");
            errors.push(Diagnostic::at(place, message, format!("remove it, or use `{what} = \"{owner}\"`")));
        }
    }
    errors
}
