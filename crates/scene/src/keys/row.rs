//! Rows of the reference of keys.

use super::foreign_keys;
use super::tree::{self, Tree};
use crate::key_default;
use serde_json::Value;

/// A row of the reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Key, with `.NAME` if its value is a table whose keys are names.
    pub key: String,
    /// Unit of its values; empty if they have none.
    pub unit: String,
    /// Description in one line of Markdown.
    pub text: String,
    /// Default in one line; empty if it has none.
    pub default: String,
    /// Kinds of run and choices beside it for which it is, as text; empty for all.
    pub kinds: String,
    /// True if the table must have this key.
    pub needed: bool,
}

impl Row {
    /// Description with the default and the kinds of run.
    #[must_use]
    pub fn full(&self) -> String {
        let default =
            if self.default.is_empty() { String::new() } else { format!(" Default {}.", self.default) };
        let kinds = if self.kinds.is_empty() { String::new() } else { format!(" Only for {}.", self.kinds) };
        format!("{}{default}{kinds}", self.text)
    }
}

/// A key of scenes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// Paths under which the same key stands.
    pub paths: Vec<String>,
    /// Its row of the reference.
    pub row: Row,
    /// Values that it takes.
    pub value: String,
    /// Choices that it has, with descriptions.
    pub choices: Vec<(String, String)>,
    /// Keys below it, if it is a table.
    pub keys: Vec<Row>,
}

/// Text and unit of a description that ends with ` \[unit\].`
fn parted(description: &str) -> (String, Option<&str>) {
    let end = description.strip_suffix("\\].").and_then(|text| text.rsplit_once(" \\["));
    end.map_or((description.to_string(), None), |(text, unit)| (format!("{text}."), Some(unit)))
}

/// Row of the key `key` of the table with this schema.
pub(super) fn row_of(tree: &Tree, table: &Value, key: &str) -> Row {
    let property = &table["properties"][key];
    // A kind of something, such as of mesh, is a table with one key; what it is stands at the table.
    let only = table["properties"].as_object().is_some_and(|all| all.len() == 1);
    let kind = table["description"].as_str().filter(|_| only);
    let (text, said) = parted(property["description"].as_str().or(kind).unwrap_or_default());
    let unit = said.map(str::to_string).or_else(|| tree.unit(property)).unwrap_or_default();
    let name = if tree.is_named(property) { ".NAME" } else { "" };
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let needed = table["required"].as_array().is_some_and(|all| all.iter().any(|one| one == key));
    let default = key_default::line(&property["x-default"], &unit);
    let kinds = foreign_keys::scope(property);
    Row { key: format!("{key}{name}"), unit, text, default, kinds, needed }
}

/// Row of a key of the definition `of`; `None` if there is no such key.
#[must_use]
pub fn row(of: &str, key: &str) -> Option<Row> {
    let tree = Tree::new();
    let table = tree.definition(of);
    table["properties"][key].is_object().then(|| row_of(&tree, table, key))
}

/// Rows of the keys of both kinds of scenes: of bodies, and of spring-sliders.
#[must_use]
pub fn roots() -> [Vec<Row>; 2] {
    let tree = Tree::new();
    let rows = |kind: &Value| {
        let tables = tree.tables(kind);
        let each = tables.iter().flat_map(|t| tree::properties(t).map(|(key, _)| row_of(&tree, t, key)));
        each.collect::<Vec<_>>()
    };
    let mut kinds = tree.kinds().map(rows);
    [kinds.next().unwrap_or_default(), kinds.next().unwrap_or_default()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_in_a_description_is_that_of_the_type() {
        let tree = Tree::new();
        for (key, value) in tree.definitions().flat_map(tree::properties) {
            let (_, said) = parted(value["description"].as_str().unwrap_or_default());
            if let (Some(said), Some(typed)) = (said, tree.unit(value)) {
                assert_eq!(said, typed, "{key}");
            }
        }
    }
}
