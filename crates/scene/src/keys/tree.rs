//! The schema of scenes as a tree of keys.

use crate::schema::schema;
use serde_json::Value;

/// Schema of scenes, with its definitions.
pub(crate) struct Tree(Value);

impl Tree {
    pub fn new() -> Self {
        Self(schema().to_value())
    }

    /// Schemas of both kinds of scenes: of bodies, and of spring-sliders.
    pub fn kinds(&self) -> impl Iterator<Item = &Value> {
        self.0["anyOf"].as_array().into_iter().flatten()
    }

    /// The schema that this one refers to, or itself.
    fn resolved<'a>(&'a self, schema: &'a Value) -> &'a Value {
        match schema["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
            Some(name) => self.resolved(self.definition(name)),
            None => schema,
        }
    }

    /// Alternatives of a value.
    pub fn forms<'a>(&'a self, schema: &'a Value) -> Vec<&'a Value> {
        let schema = self.resolved(schema);
        let several = ["anyOf", "oneOf"].iter().find_map(|key| schema[*key].as_array());
        match several {
            Some(several) => several.iter().flat_map(|one| self.forms(one)).collect(),
            None => vec![schema],
        }
    }

    /// Tables among the alternatives of a value, and among the entries of a list.
    pub fn tables<'a>(&'a self, schema: &'a Value) -> Vec<&'a Value> {
        let table = |form: &'a Value| {
            let (own, items) = (&form["properties"], &form["items"]);
            match own.is_object() || form["additionalProperties"].is_object() {
                true => vec![form],
                false if items.is_object() => self.tables(items),
                false => Vec::new(),
            }
        };
        self.forms(schema).into_iter().flat_map(table).collect()
    }

    /// Unit of the values of a schema.
    pub fn unit(&self, schema: &Value) -> Option<String> {
        let found = self.resolved(schema);
        if let Some(unit) = found["x-unit"].as_str() {
            return Some(unit.into());
        }
        let forms = found["anyOf"].as_array().into_iter().flatten();
        let several = found["prefixItems"].as_array().into_iter().flatten();
        forms.chain(found.get("items")).chain(several).find_map(|part| self.unit(part))
    }

    /// Definitions of all tables and values.
    #[cfg(test)]
    pub fn definitions(&self) -> impl Iterator<Item = &Value> {
        self.0["$defs"].as_object().into_iter().flat_map(|all| all.values())
    }

    /// Definition of this name.
    pub fn definition(&self, name: &str) -> &Value {
        &self.0["$defs"][name]
    }

    /// True if the value of a key is a table whose keys are names.
    pub fn is_named(&self, schema: &Value) -> bool {
        self.resolved(schema)["additionalProperties"].is_object()
    }
}

/// Keys of a table with fixed keys.
pub(super) fn properties(table: &Value) -> impl Iterator<Item = (&str, &Value)> {
    let all = table["properties"].as_object().into_iter().flatten();
    all.filter(|(_, value)| owner(value).is_none()).map(|(key, value)| (key.as_str(), value))
}

/// A key of a table with fixed keys, if it has this one.
pub(super) fn property<'a>(table: &'a Value, key: &str) -> Option<&'a Value> {
    let own = &table["properties"][key];
    (own.is_object() && owner(own).is_none()).then_some(own)
}

/// Definition whose key stands in another table, where it is refused.
pub(super) fn owner(schema: &Value) -> Option<&str> {
    schema["x-of"].as_str()
}
