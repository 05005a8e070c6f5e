//! Walk through the text of a scene along the schema of scenes.

use super::tree::Tree;
use serde_json::Value as Schema;
use std::ops::Range;
use toml_edit::{Document, Item, TableLike, Value};

/// A step of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<'a> {
    /// Key or name.
    pub key: &'a str,
    /// True for a name that the scene chooses.
    pub named: bool,
}

/// A key as a scene gives it.
pub(crate) struct GivenKey<'s, 't> {
    /// Key.
    pub key: &'t str,
    /// Its position, and that of its value.
    pub places: [Range<usize>; 2],
    /// Path of the table that has it.
    pub path: &'t [Step<'t>],
    /// Its schema, with its row.
    pub schema: &'s Schema,
    /// The table that has it.
    pub table: &'t dyn TableLike,
}

/// Receiver of what a walk meets.
pub(crate) trait Visitor<'s> {
    /// A key of a table; false to pass over its value.
    fn key(&mut self, _given: &GivenKey<'s, '_>) -> bool {
        true
    }

    /// A value that is no table and no list, with the forms that it may have.
    fn value(&mut self, _forms: &[&'s Schema], _value: &Value, _path: &[Step<'_>]) {}
}

/// Walks through the text of a scene of bodies, or of spring-sliders.
pub(crate) fn visit<'s>(
    tree: &'s Tree,
    document: &Document<&str>,
    sliders: bool,
    visitor: &mut impl Visitor<'s>,
) {
    let Some(kind) = tree.kinds().nth(usize::from(sliders)) else { return };
    Walk { tree, visitor }.table(&tree.forms(kind), document.as_table(), &[]);
}

struct Walk<'s, 'v, V> {
    tree: &'s Tree,
    visitor: &'v mut V,
}

impl<'s, V: Visitor<'s>> Walk<'s, '_, V> {
    fn table(&mut self, forms: &[&'s Schema], table: &dyn TableLike, path: &[Step<'_>]) {
        for (key, item) in table.iter() {
            let own = forms.iter().map(|f| &f["properties"][key]).find(|s| s.is_object());
            let places = [table.key(key).and_then(toml_edit::Key::span), item.span()];
            let [place, value] = places.map(Option::unwrap_or_default);
            let visited = own.is_none_or(|schema| {
                let places = [place.clone(), value.clone()];
                self.visitor.key(&GivenKey { key, places, path, schema, table })
            });
            if visited {
                let (named, forms) = self.below(forms, key);
                self.item(&forms, item, &[path, &[Step { key, named }]].concat());
            }
        }
    }

    fn item(&mut self, forms: &[&'s Schema], item: &Item, path: &[Step<'_>]) {
        if let Some(table) = item.as_table_like() {
            self.table(forms, table, path);
        } else if let Some(list) = item.as_array_of_tables() {
            let forms = self.entries(forms, 0);
            list.iter().for_each(|table| self.table(&forms, table, path));
        } else if let Some(value) = item.as_value() {
            self.value(forms, value, path);
        }
    }

    fn value(&mut self, forms: &[&'s Schema], value: &Value, path: &[Step<'_>]) {
        match value {
            Value::InlineTable(table) => self.table(forms, table, path),
            Value::Array(list) => {
                for (k, entry) in list.iter().enumerate() {
                    let forms = self.entries(forms, k);
                    self.value(&forms, entry, path);
                }
            }
            _ => self.visitor.value(forms, value, path),
        }
    }

    /// Forms that the value of a key of tables may have; true for a name.
    fn below(&self, forms: &[&'s Schema], key: &str) -> (bool, Vec<&'s Schema>) {
        let all = |of: &dyn Fn(&'s Schema) -> &'s Schema| -> Vec<&'s Schema> {
            forms.iter().map(|f| of(f)).filter(|s| s.is_object()).flat_map(|s| self.tree.forms(s)).collect()
        };
        let own = all(&|form| &form["properties"][key]);
        if own.is_empty() { (true, all(&|form| &form["additionalProperties"])) } else { (false, own) }
    }

    /// Forms of an entry of a list, by its number.
    fn entries(&self, forms: &[&'s Schema], number: usize) -> Vec<&'s Schema> {
        let of = |form: &&'s Schema| match form["prefixItems"].get(number) {
            Some(own) => self.tree.forms(own),
            None => form.get("items").map(|s| self.tree.forms(s)).unwrap_or_default(),
        };
        forms.iter().flat_map(of).collect()
    }
}
