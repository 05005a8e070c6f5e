//! Interfaces that several pairs of sides have in common: `pairs` of an interface becomes an interface for each.

use crate::diagnostic::Diagnostic;
use crate::model::{Interface, Scene, SidePair, Spanned};
use std::collections::BTreeMap;
use std::ops::Range;

/// Makes an interface of each pair, `NAME-1`, `NAME-2` and so on, with all other keys of the table. Returns what is wrong.
pub(crate) fn expand(scene: &mut Scene) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    let mut all: BTreeMap<String, Interface> = BTreeMap::new();
    for (name, mut interface) in std::mem::take(&mut scene.interfaces) {
        let Some(pairs) = interface.pairs.take() else {
            errors.extend(missing(&name, &interface));
            insert(&mut all, name, interface, &mut errors);
            continue;
        };
        errors.extend(surplus(&name, &interface, &pairs));
        for (k, pair) in pairs.get_ref().iter().enumerate() {
            let SidePair { slave, master } = pair.clone();
            let own = Interface { slave, master, ..interface.clone() };
            insert(&mut all, format!("{name}-{}", k + 1), own, &mut errors);
        }
    }
    scene.interfaces = all;
    errors
}

/// Adds an interface unless its name is taken.
fn insert(
    all: &mut BTreeMap<String, Interface>,
    name: String,
    interface: Interface,
    errors: &mut Vec<Diagnostic>,
) {
    if let Some(other) = all.get(&name) {
        let message = format!("there are two interfaces `{name}`: one is that of an entry of `pairs`");
        let error = Diagnostic::at(interface.slave.span(), message, "give the table another name");
        errors.push(error.and(other.slave.span(), "and here"));
    }
    all.insert(name, interface);
}

/// Error for an interface without one of its sides.
fn missing(name: &str, interface: &Interface) -> Option<Diagnostic> {
    let key = match (interface.slave.get_ref().is_empty(), interface.master.is_empty()) {
        (true, _) => "slave",
        (false, true) => "master",
        (false, false) => return None,
    };
    Some(Diagnostic::at(
        interface.measure.span(),
        format!("interface `{name}` has no `{key}`"),
        format!(
            "add `{key} = \"BODY.SIDE\"`; for the same contact between several pairs of sides, \
             `pairs = [{{ slave = \"BODY.SIDE\", master = \"BODY.SIDE\" }}, ..]`"
        ),
    ))
}

/// Error for an interface with pairs that has sides besides, or whose list is empty.
fn surplus(name: &str, interface: &Interface, pairs: &Spanned<Vec<SidePair>>) -> Option<Diagnostic> {
    if pairs.get_ref().is_empty() {
        let message = format!("the `pairs` of interface `{name}` are an empty list");
        return Some(Diagnostic::at(
            pairs.span(),
            message,
            "such as `[{ slave = \"upper.bottom\", master = \"lower.top\" }]`",
        ));
    }
    let slave = Some(("slave", interface.slave.span())).filter(|_| !interface.slave.get_ref().is_empty());
    let master = Some(("master", interface.master.span())).filter(|_| !interface.master.is_empty());
    let (key, place): (&str, Range<usize>) = slave.or(master)?;
    let message = format!("interface `{name}` has `pairs`, and `{key}` besides");
    let help = format!("remove `{key}`: each entry of `pairs` has its own");
    Some(Diagnostic::at(place, message, help).and(pairs.span(), "the pairs"))
}
