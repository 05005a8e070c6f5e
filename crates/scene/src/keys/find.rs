//! Search for a key of scenes by its path, or by the end of its path.

use super::path::{Path, Step};
use super::row::{Key, Row, row_of};
use super::tree::{Tree, properties, property};
use super::{foreign_keys, value};
use crate::key_default;
use crate::kind::{Kind, OF_BODIES};
use crate::suggestions::{nearest, suggest};
use serde_json::Value;
use std::cmp::Ordering;

/// Deepest path that is searched for a key given without the beginning of its path. The deepest key of scenes has eight steps.
const DEEPEST: usize = 10;

/// Largest number of paths that a message lists.
const LISTED: usize = 8;

/// Result of a search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum KeySearch {
    /// Keys with this path.
    Keys(Vec<Key>),
    /// No key; the message names what is near.
    None(String),
}

/// A key in the tree, with the path to it.
struct Place<'a> {
    path: String,
    /// The table that has the key; `None` for a name.
    table: Option<(&'a Value, String)>,
    schema: &'a Value,
}

/// Finds the keys with a path such as `faults.main.law.a`. Names may be left out, as in `faults.law.a`, and so may the
/// beginning of the path, as in `law.a`.
#[must_use]
pub fn find(text: &str) -> KeySearch {
    let Some(path) = Path::read(text) else {
        return KeySearch::None(format!("`{text}` is no path of keys: write it like `faults.main.law.a`"));
    };
    let steps: Vec<&str> = path.0.iter().filter_map(name).collect();
    let tree = Tree::new();
    let mut missed = Miss { depth: 0, of: String::new(), known: Vec::new() };
    let mut places = Vec::new();
    for kind in tree.kinds() {
        match walk(&tree, kind, &steps) {
            Ok(found) => places.extend(found),
            Err(miss) => missed = missed.or(miss),
        }
    }
    let all = || tree.kinds().flat_map(|kind| below(&tree, kind, "", 0)).collect::<Vec<_>>();
    if places.is_empty() {
        places = all().into_iter().filter(|place| ends_with(&place.path, &steps)).collect();
    }
    if places.is_empty() {
        return KeySearch::None(unknown(text, &steps, &missed, &all()));
    }
    KeySearch::Keys(keys(&tree, places))
}

/// Path of a key that scenes do not have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct UnknownKey(String);

/// Checks that scenes have a key with this path, in which no name is left out. For each step, true if it is a name.
///
/// # Errors
/// The first step that does not exist, with what is near.
pub fn check(path: &Path, sliders: bool) -> Result<Vec<bool>, UnknownKey> {
    let tree = Tree::new();
    let Some(kind) = tree.kinds().nth(usize::from(sliders)) else { return Ok(Vec::new()) };
    let mut reached = vec![(kind, false)];
    let mut names = Vec::new();
    let mut so_far = Vec::new();
    for step in &path.0 {
        let Step::Key(key) = step else {
            names.push(false);
            so_far.push(step.clone());
            continue;
        };
        let tables: Vec<&Value> = reached.iter().flat_map(|(schema, _)| tree.tables(schema)).collect();
        let next: Vec<_> = tables.iter().flat_map(|table| strict(table, key)).collect();
        if next.is_empty() {
            let known = tables.iter().flat_map(|table| properties(table).map(|(key, _)| key)).collect();
            let of = Path(so_far).to_string();
            return Err(UnknownKey(Miss { depth: 0, of, known }.message(&[key])));
        }
        names.push(next.iter().any(|(_, named)| *named));
        so_far.push(step.clone());
        reached = next;
    }
    Ok(names)
}

/// Values that a key of a table, or a name, may have; true for a name.
fn strict<'a>(table: &'a Value, key: &str) -> Option<(&'a Value, bool)> {
    let named = &table["additionalProperties"];
    let own = property(table, key).map(|own| (own, false));
    own.or_else(|| named.is_object().then_some((named, true)))
}

fn name(step: &Step) -> Option<&str> {
    match step {
        Step::Key(key) => Some(key),
        Step::Index(_) => None,
    }
}

/// Failure of a path: how many of its steps exist, the path so far, and the keys there.
struct Miss<'a> {
    depth: usize,
    of: String,
    known: Vec<&'a str>,
}

impl Miss<'_> {
    /// The failure that comes later in the path, with the keys of both if they come at the same step.
    fn or(mut self, other: Self) -> Self {
        match self.depth.cmp(&other.depth) {
            Ordering::Less => other,
            Ordering::Equal => {
                self.known.extend(other.known);
                self
            }
            Ordering::Greater => self,
        }
    }

    fn message(&self, steps: &[&str]) -> String {
        let mut known = self.known.clone();
        known.sort_unstable();
        known.dedup();
        let (of, step) = (&self.of, steps.get(self.depth).copied().unwrap_or_default());
        match known.is_empty() {
            true => format!("`{of}` has no keys"),
            false if of.is_empty() => {
                format!("scenes have no key `{step}`: {}", suggest(step, "keys", known))
            }
            false => format!("`{of}` has no key `{step}`: {}", suggest(step, "keys", known)),
        }
    }
}

/// Places of the path.
fn walk<'a>(tree: &'a Tree, kind: &'a Value, steps: &[&str]) -> Result<Vec<Place<'a>>, Miss<'a>> {
    let mut places = vec![Place { path: String::new(), table: None, schema: kind }];
    for (depth, step) in steps.iter().enumerate() {
        let next: Vec<_> = places.iter().flat_map(|place| children(tree, place, step)).collect();
        if next.is_empty() {
            let tables = places.iter().flat_map(|place| tree.tables(place.schema));
            let known = tables.flat_map(|t| properties(t).map(|(key, _)| key)).collect();
            let of = places.first().map_or(String::new(), |place| place.path.clone());
            return Err(Miss { depth, of, known });
        }
        places = next;
    }
    Ok(places)
}

/// Places one step further: a key, or a name where names stand. A key below names may follow at once.
fn children<'a>(tree: &'a Tree, place: &Place<'a>, step: &str) -> Vec<Place<'a>> {
    let mut found = Vec::new();
    for table in tree.tables(place.schema) {
        if let Some(own) = property(table, step) {
            let path = joined(&place.path, step);
            found.push(Place { path, table: Some((table, step.into())), schema: own });
        }
        let named = &table["additionalProperties"];
        if named.is_object() {
            let entry = Place { path: joined(&place.path, "NAME"), table: None, schema: named };
            let inner = children(tree, &entry, step);
            found.extend(if inner.is_empty() { vec![entry] } else { inner });
        }
    }
    found
}

fn joined(path: &str, step: &str) -> String {
    if path.is_empty() { step.into() } else { format!("{path}.{step}") }
}

/// All keys below a schema.
fn below<'a>(tree: &'a Tree, schema: &'a Value, path: &str, depth: usize) -> Vec<Place<'a>> {
    if depth > DEEPEST {
        return Vec::new();
    }
    let mut all = Vec::new();
    for table in tree.tables(schema) {
        for (key, schema) in properties(table) {
            let path = joined(path, key);
            all.extend(below(tree, schema, &path, depth + 1));
            all.push(Place { path, table: Some((table, key.into())), schema });
        }
        let named = &table["additionalProperties"];
        if named.is_object() {
            all.extend(below(tree, named, &joined(path, "NAME"), depth + 1));
        }
    }
    all
}

/// A key with a default that holds in most scenes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DocumentedDefault {
    /// Path, with `NAME` for names.
    pub path: String,
    /// Default as a scene gives it.
    pub default: String,
    /// Kinds of run to which it belongs.
    pub kinds: Vec<Kind>,
}

/// Keys with defaults.
#[must_use]
pub fn documented() -> Vec<DocumentedDefault> {
    let tree = Tree::new();
    let mut found = Vec::new();
    for (kind, all) in tree.kinds().zip([&OF_BODIES[..], &[Kind::Sliders]]) {
        for place in below(&tree, kind, "", 0) {
            let Some((table, key)) = &place.table else { continue };
            let unit = row_of(&tree, table, key).unit;
            let Some(default) = key_default::entry(&place.schema["x-default"], &unit) else { continue };
            let own = foreign_keys::kinds(place.schema).unwrap_or_else(|| all.to_vec());
            let kinds: Vec<Kind> = own.into_iter().filter(|kind| all.contains(kind)).collect();
            if kinds.is_empty() {
                continue;
            }
            found.push(DocumentedDefault { path: place.path, default, kinds });
        }
    }
    found
}

/// True if a path ends with these steps, apart from names.
fn ends_with(path: &str, steps: &[&str]) -> bool {
    let own: Vec<&str> = path.split('.').filter(|step| *step != "NAME").collect();
    own.ends_with(steps)
}

/// The keys of places, with one entry for each key of a definition.
fn keys(tree: &Tree, places: Vec<Place<'_>>) -> Vec<Key> {
    let mut keys: Vec<Key> = Vec::new();
    for place in places {
        let tables = entries(tree, place.schema);
        let rows = tables.iter().flat_map(|t| properties(t).map(|(key, _)| row_of(tree, t, key)));
        let (value, choices) = (value::words(tree, place.schema), value::choices(tree, place.schema));
        let row = match &place.table {
            Some((table, key)) => row_of(tree, table, key),
            None => Row {
                key: "NAME".into(),
                unit: String::new(),
                text: tables.iter().find_map(|t| t["description"].as_str()).unwrap_or_default().into(),
                default: String::new(),
                kinds: String::new(),
                needed: false,
            },
        };
        let mut below: Vec<Row> = Vec::new();
        for row in rows {
            if !below.contains(&row) {
                below.push(row);
            }
        }
        let key = Key { paths: Vec::new(), row, value, choices, keys: below };
        match keys.iter_mut().find(|known| Key { paths: Vec::new(), ..(*known).clone() } == key) {
            Some(known) if known.paths.contains(&place.path) => {}
            Some(known) => known.paths.push(place.path),
            None => keys.push(Key { paths: vec![place.path], ..key }),
        }
    }
    keys
}

/// Tables among the values of a key; of a table of names, those of its entries.
fn entries<'a>(tree: &'a Tree, schema: &'a Value) -> Vec<&'a Value> {
    let tables = tree.tables(schema).into_iter();
    let named = |table: &'a Value| table.get("additionalProperties").filter(|entry| entry.is_object());
    tables.flat_map(|table| named(table).map_or_else(|| vec![table], |entry| tree.tables(entry))).collect()
}

/// Message about a path that leads nowhere.
fn unknown(text: &str, steps: &[&str], missed: &Miss<'_>, all: &[Place<'_>]) -> String {
    if missed.depth > 0 {
        return missed.message(steps);
    }
    let last = |place: &Place<'_>| place.path.rsplit('.').next().unwrap_or_default().to_string();
    let mut names: Vec<String> = all.iter().map(last).collect();
    names.sort();
    names.dedup();
    let end = steps.last().copied().unwrap_or_default();
    let Some(near) = nearest(end, names.iter().map(String::as_str)) else {
        return format!("scenes have no key `{text}`; `asperity explain` lists the keys to begin with");
    };
    let mut paths: Vec<&str> = all.iter().filter(|p| last(p) == near).map(|p| p.path.as_str()).collect();
    paths.dedup();
    let more = if paths.len() > LISTED { ", .." } else { "" };
    paths.truncate(LISTED);
    format!("scenes have no key `{text}`; did you mean `{near}`, as in {}{more}?", paths.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(text: &str) -> Vec<Key> {
        match find(text) {
            KeySearch::Keys(keys) => keys,
            KeySearch::None(why) => panic!("{text}: {why}"),
        }
    }

    fn why(text: &str) -> String {
        match find(text) {
            KeySearch::Keys(keys) => panic!("{text}: {keys:?}"),
            KeySearch::None(why) => why,
        }
    }

    #[test]
    fn a_key_is_found_with_its_name_without_it_and_by_its_end() {
        let a = keys("faults.main.law.a");
        assert_eq!(a[0].paths, ["faults.NAME.law.a"]);
        assert_eq!((a[0].row.unit.as_str(), a[0].row.text.as_str()), ("-", "Direct effect a."));
        assert_eq!(keys("faults.law.a"), a);
        assert!(keys("law.a")[0].paths.len() > 1);
        assert_eq!(keys("stages[0].conditions[1].x")[0].paths, ["stages.conditions.x"]);
        let stepper = keys("time.stepper");
        assert!(stepper[0].choices.iter().any(|(name, _)| name == "fault-ode"), "{stepper:?}");
        assert!(keys("faults")[0].keys.iter().any(|row| row.key == "normal" && row.unit == "Pa"));
        assert!(keys("bodies.A.mesh.block.size").len() == 1);
        assert!(keys("output.probes.fault")[0].value.contains("whole number"));
    }

    #[test]
    fn a_misspelled_key_is_answered_with_the_nearest_one() {
        assert!(why("time.steper").contains("did you mean `stepper`?"), "{}", why("time.steper"));
        assert!(why("nromal").contains("`normal`, as in"), "{}", why("nromal"));
        assert!(why("faults.law.aa b").contains("no path of keys"));
        assert!(why("title.x").contains("has no keys"), "{}", why("title.x"));
        assert!(why("qwertyuiop").contains("asperity explain"), "{}", why("qwertyuiop"));
    }
}
