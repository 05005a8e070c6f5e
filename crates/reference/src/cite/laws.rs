//! Sources of friction laws.

use super::Citations;
use asperity_plan::reading::scene::law::{Form, LawChoice, State, Strength};

/// Keys of this file, for the test of the table.
pub const KEYS: [&str; 15] = [
    "ida1972",
    "andrews1976",
    "dieterich1979",
    "ruina1983",
    "perrin1995",
    "nagata2012",
    "rice2006",
    "beeler2008",
    "noda2009",
    "dunham2011",
    "rice1996",
    "okubo1989",
    "chester1994",
    "linker1992",
    "gu1984",
];

/// Adds the sources of a law; `of` is the interface, fault or slider that it belongs to.
pub(super) fn add(citations: &mut Citations, of: &str, law: &LawChoice) {
    match law {
        LawChoice::Yielding { kind, .. } => {
            for key in yielding(kind) {
                citations.add(key, format!("{of}: law \"{kind}\""));
            }
        }
        LawChoice::Rate { strength, .. } => add_strength(citations, of, strength),
        LawChoice::RateAndState { strength, evolution, states, .. } => {
            for key in evolved(evolution.name) {
                citations.add(key, format!("{of}: evolution \"{}\"", evolution.name));
            }
            add_states(citations, of, states);
            add_strength(citations, of, strength);
        }
    }
}

/// Sources of a law with an elastic domain. Coulomb's law, a bond, and a drop from one coefficient to another need none.
pub fn yielding(kind: &str) -> &'static [&'static str] {
    match kind {
        "slip-weakening" => &["ida1972", "andrews1976"],
        _ => &[],
    }
}

/// Sources of an evolution law.
pub fn evolved(name: &str) -> &'static [&'static str] {
    match name {
        "ageing" => &["dieterich1979"],
        "slip" => &["ruina1983"],
        "prz" => &["perrin1995"],
        "nagata" => &["nagata2012"],
        "flash" => &["rice2006", "beeler2008", "noda2009", "dunham2011"],
        _ => &[],
    }
}

fn add_states(citations: &mut Citations, of: &str, states: &[State]) {
    if states.len() > 1 {
        citations.add("gu1984", format!("{of}: {} state variables", states.len()));
    }
    if states.iter().any(|state| state.alpha > 0.0) {
        citations.add("linker1992", format!("{of}: memory of normal traction, `alpha`"));
    }
}

fn add_strength(citations: &mut Citations, of: &str, strength: &Strength) {
    let (key, form) = match strength.form {
        Form::Regularised => ("rice1996", "regularised"),
        Form::Bare => ("dieterich1979", "bare"),
        Form::CutOff { .. } => ("okubo1989", "cut-off"),
    };
    citations.add(key, format!("{of}: form \"{form}\" of the strength"));
    if strength.heat.is_some() {
        citations.add("chester1994", format!("{of}: temperature, `activation`"));
    }
}
