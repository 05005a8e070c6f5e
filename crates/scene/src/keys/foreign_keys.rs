//! Refusal of keys that do not belong to the kind of run of their scene, as their rows say.

use super::tree::{self, Tree};
use super::visit::{GivenKey, Visitor, visit};
use crate::diagnostic::Diagnostic;
use crate::kind::{ALL, Kind, words};
use crate::kinematics::{self, Kinematics};
use serde_json::{Value as Schema, json};
use std::ops::Range;
use toml_edit::Document;

/// Properties of a scene that decide on its keys.
pub(crate) struct Run {
    /// Kind of run.
    pub kind: Kind,
    /// Position of the key that decides it.
    pub stated: Range<usize>,
    /// Idealisation; `None` for spring-sliders.
    pub kinematics: Option<Kinematics>,
}

/// Replaces what is said of keys that do not belong to this run by their refusal.
pub(crate) fn refuse(tree: &Tree, document: &Document<&str>, run: Run, errors: &mut Vec<Diagnostic>) {
    let sliders = run.kind == Kind::Sliders;
    let mut foreign = ForeignKeys { tree, run, errors: Vec::new(), below: Vec::new() };
    visit(tree, document, sliders, &mut foreign);
    let ForeignKeys { errors: found, below, .. } = foreign;
    let inside = |at: &Range<usize>| below.iter().any(|r| r.start <= at.start && at.end <= r.end);
    errors.retain(|error| error.span.is_empty() || !inside(&error.span));
    errors.extend(found);
    errors.sort_by_key(|e| (e.span.is_empty(), e.span.start));
}

struct ForeignKeys<'t> {
    tree: &'t Tree,
    run: Run,
    errors: Vec<Diagnostic>,
    /// Positions of the values of refused keys.
    below: Vec<Range<usize>>,
}

impl<'s> Visitor<'s> for ForeignKeys<'_> {
    fn key(&mut self, given: &GivenKey<'s, '_>) -> bool {
        let [at, value] = &given.places;
        let refusal =
            self.other_kind(given).or_else(|| self.idealised(given)).or_else(|| self.elsewhere(given));
        let Some(error) = refusal else { return true };
        self.errors.push(error);
        // The value of a header begins before its key.
        let start = if value.is_empty() { at.start } else { at.start.min(value.start) };
        self.below.push(start..value.end.max(at.end));
        false
    }
}

impl ForeignKeys<'_> {
    /// Refusal of a key of another kind of run, or of another choice beside it.
    fn other_kind(&self, given: &GivenKey<'_, '_>) -> Option<Diagnostic> {
        let own = kinds(given.schema).filter(|kinds| !kinds.contains(&self.run.kind));
        let of_run = own.map(|kinds| {
            let stated = Some((self.run.stated.clone(), "the kind of run"));
            let wanted = words(&kinds);
            let stepper = if wanted.starts_with('"') { "the stepper " } else { "" };
            (self.run.kind.name(), format!("{stepper}{wanted}"), stated)
        });
        let (found, wanted, place) = of_run.or_else(|| beside(given))?;
        let (key, [at, _]) = (given.key, &given.places);
        let instead = given.schema["x-instead"].as_str().map_or(String::new(), |text| format!("; {text}"));
        let message = format!("`{key}` has no meaning with {found}");
        let error = Diagnostic::at(at.clone(), message, format!("remove it: it is for {wanted}{instead}"));
        Some(match place {
            Some((place, what)) => error.and(place, what),
            None => error,
        })
    }

    /// Refusal of a key of faults at an interface.
    fn elsewhere(&self, given: &GivenKey<'_, '_>) -> Option<Diagnostic> {
        let row = &self.tree.definition(tree::owner(given.schema)?)["properties"][given.key];
        let [at, value] = &given.places;
        let place = if value.is_empty() { at } else { value };
        let name = given.path.last().map_or("", |step| step.key);
        let message = format!("interface `{name}` has no `{}`: it is a key of faults", given.key);
        Some(Diagnostic::at(place.clone(), message, row["x-at-interfaces"].as_str().unwrap_or_default()))
    }

    /// Refusal of a key of other idealisations.
    fn idealised(&self, given: &GivenKey<'_, '_>) -> Option<Diagnostic> {
        let own = idealisations(given.schema)?;
        let found = self.run.kinematics.filter(|found| !own.contains(found))?;
        let [at, value] = &given.places;
        let place = if value.is_empty() { at } else { value };
        let otherwise =
            given.schema["x-otherwise"].as_str().map_or(String::new(), |text| format!("; {text}"));
        let message = format!("`{}` has no meaning in {}", given.key, found.words());
        let help = format!("remove it: it is for {}{otherwise}", kinematics::words(&own));
        Some(Diagnostic::at(place.clone(), message, help))
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

/// Runs, choices and idealisations for which a key is, as text; empty for all.
pub(super) fn scope(schema: &Schema) -> String {
    let kinds = kinds(schema).map(|kinds| words(&kinds));
    let with = with(schema).map(|(other, values)| written(&other, &values));
    let of_run = kinds.into_iter().chain(with).collect::<Vec<_>>().join(", with ");
    let idealised = idealisations(schema).map(|all| kinematics::words(&all));
    let parts = [of_run, idealised.unwrap_or_default()];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", in ")
}

/// Kinds of run to which a key belongs; `None` for all.
pub(super) fn kinds(schema: &Schema) -> Option<Vec<Kind>> {
    let listed = schema.get("x-kinds")?.as_array()?;
    Some(ALL.into_iter().filter(|kind| listed.contains(&json!(kind))).collect())
}

/// Idealisations to which a key belongs; `None` for all.
fn idealisations(schema: &Schema) -> Option<Vec<Kinematics>> {
    let listed = schema.get("x-kinematics")?.as_array()?;
    Some(kinematics::ALL.into_iter().filter(|one| listed.contains(&json!(one))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Refusals of a text in a run of this kind, with line, message and help.
    fn refused(kind: Kind, text: &str) -> Vec<(usize, String, String)> {
        let (tree, document) = (Tree::new(), Document::parse(text).unwrap());
        let mut errors = vec![Diagnostic::at(text.len()..text.len(), "said before", "")];
        let run = Run { kind, stated: 0..1, kinematics: Some(Kinematics::Antiplane) };
        refuse(&tree, &document, run, &mut errors);
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

    #[test]
    fn a_key_of_another_idealisation_is_refused_at_its_value() {
        let found = refused(Kind::Medium, "\n[faults.main]\nrake = [0, 0, 1]\n");
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!((found[0].0, found[0].1.as_str()), (3, "`rake` has no meaning in antiplane motion"));
        assert_eq!(
            found[0].2,
            "remove it: it is for three dimensions; in the plane there is one direction of slip"
        );
        assert_eq!(refused(Kind::Medium, "[place]\nlength = \"1 km\"\n"), []);
    }

    #[test]
    fn a_key_of_faults_is_refused_at_an_interface() {
        let found = refused(Kind::Implicit, "[interfaces.joint]\nrate = 1e-9\n");
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].1, "interface `joint` has no `rate`: it is a key of faults");
        assert_eq!(found[0].2, "the state at the start is steady at `v_initial` of the law");
    }
}
