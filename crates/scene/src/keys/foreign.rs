//! Refusal of keys that do not belong to the kind of run of their scene, as their rows say.

use super::tree::Tree;
use super::visit::{GivenKey, Visitor, visit};
use crate::diagnostic::Diagnostic;
use crate::kind::{ALL, Kind, words};
use serde_json::{Value as Schema, json};
use std::ops::Range;
use toml_edit::Document;

/// Replaces what is said of keys that do not belong to a run of this kind, which the key at `stated` decides, by their refusal.
pub(crate) fn refuse(
    tree: &Tree,
    document: &Document<&str>,
    kind: Kind,
    stated: Range<usize>,
    errors: &mut Vec<Diagnostic>,
) {
    let mut foreign = ForeignKeys { kind, stated, errors: Vec::new(), below: Vec::new() };
    visit(tree, document, kind == Kind::Sliders, &mut foreign);
    let ForeignKeys { errors: found, below, .. } = foreign;
    let inside = |at: &Range<usize>| below.iter().any(|r| r.start <= at.start && at.end <= r.end);
    errors.retain(|error| error.span.is_empty() || !inside(&error.span));
    errors.extend(found);
    errors.sort_by_key(|e| (e.span.is_empty(), e.span.start));
}

struct ForeignKeys {
    kind: Kind,
    stated: Range<usize>,
    errors: Vec<Diagnostic>,
    /// Positions of the values of refused keys.
    below: Vec<Range<usize>>,
}

impl<'s> Visitor<'s> for ForeignKeys {
    fn key(&mut self, given: &GivenKey<'s, '_>) -> bool {
        let own = kinds(given.schema).filter(|kinds| !kinds.contains(&self.kind));
        let of_run = own.map(|kinds| {
            let stated = Some((self.stated.clone(), "the kind of run"));
            let wanted = words(&kinds);
            let stepper = if wanted.starts_with('"') { "the stepper " } else { "" };
            (self.kind.name(), format!("{stepper}{wanted}"), stated)
        });
        let Some((found, wanted, place)) = of_run.or_else(|| beside(given)) else { return true };
        let (key, [at, value]) = (given.key, &given.places);
        let instead = given.schema["x-instead"].as_str().map_or(String::new(), |text| format!("; {text}"));
        let message = format!("`{key}` has no meaning with {found}");
        let error = Diagnostic::at(at.clone(), message, format!("remove it: it is for {wanted}{instead}"));
        self.errors.push(match place {
            Some((place, what)) => error.and(place, what),
            None => error,
        });
        self.below.push(at.start..value.end.max(at.end));
        false
    }
}

/// Circumstance that excludes a key, circumstances that it is for, and the position of the former.
type Contradiction = (String, String, Option<(Range<usize>, &'static str)>);

/// A key of the same table whose value excludes the given one.
fn beside(given: &GivenKey<'_, '_>) -> Option<Contradiction> {
    let (other, admitted) = with(given.schema)?;
    let value = given.table.get(&other)?;
    let found = value.as_str().filter(|found| !admitted.iter().any(|one| one == found))?;
    let place = value.span().map(|place| (place, "stated here"));
    Some((format!("`{other} = \"{found}\"`"), written(&other, &admitted), place))
}

/// Another key of the table, and its values with which a key has a meaning; `None` for all.
fn with(schema: &Schema) -> Option<(String, Vec<String>)> {
    let all: Vec<String> = serde_json::from_value(schema.get("x-with")?.clone()).ok()?;
    let (other, values) = all.split_first()?;
    Some((other.clone(), values.to_vec()))
}

fn written(other: &str, values: &[String]) -> String {
    let values: Vec<String> = values.iter().map(|value| format!("`{other} = \"{value}\"`")).collect();
    values.join(" or ")
}

/// Runs and choices for which a key is, in words; empty for all.
pub(super) fn scope(schema: &Schema) -> String {
    let kinds = kinds(schema).map(|kinds| words(&kinds));
    let with = with(schema).map(|(other, values)| written(&other, &values));
    kinds.into_iter().chain(with).collect::<Vec<_>>().join(", with ")
}

/// Kinds of run to which a key belongs; `None` for all.
pub(super) fn kinds(schema: &Schema) -> Option<Vec<Kind>> {
    let listed = schema.get("x-kinds")?.as_array()?;
    Some(ALL.into_iter().filter(|kind| listed.contains(&json!(kind))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Refusals of a text in a run of this kind, with line, message and help.
    fn refused(kind: Kind, text: &str) -> Vec<(usize, String, String)> {
        let (tree, document) = (Tree::new(), Document::parse(text).unwrap());
        let mut errors = vec![Diagnostic::at(text.len()..text.len(), "said before", "")];
        refuse(&tree, &document, kind, 0..1, &mut errors);
        let said =
            |e: Diagnostic| (text[..e.span.start].lines().count(), e.message, e.help.unwrap_or_default());
        errors.into_iter().filter(|e| e.message != "said before").map(said).collect()
    }

    #[test]
    fn a_key_of_another_kind_of_run_is_refused_at_its_place_with_the_kinds_that_have_it() {
        let text =
            "# a comment\n[time]\nstepper = \"implicit\"\ncourant = 0.5\n[output.stations]\nfault = []\n";
        let found = refused(Kind::Implicit, text);
        assert_eq!(found.len(), 2, "{found:?}");
        let (line, message, help) = &found[0];
        assert_eq!((*line, message.as_str()), (3, "`courant` has no meaning with the stepper \"implicit\""));
        assert_eq!(help, "remove it: it is for the stepper \"auto\" with faults and \"explicit\"");
        assert_eq!((found[1].0, found[1].1.contains("`stations`")), (5, true), "{found:?}");
        assert_eq!(refused(Kind::Explicit, text), []);
    }

    #[test]
    fn a_key_that_a_choice_beside_it_excludes_is_refused() {
        let law = |method: &str| format!("[solver]\nmethod = \"{method}\"\ntolerance = 1e-9\n");
        let found = refused(Kind::Implicit, &law("direct"));
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].1, "`tolerance` has no meaning with `method = \"direct\"`");
        assert_eq!(refused(Kind::Implicit, &law("iterative")), []);
    }
}
