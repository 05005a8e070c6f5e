//! Tables of keys in the scene reference, which are generated from the schema of scenes.
#![allow(clippy::disallowed_methods)]

use asperity_scene::schema::schema;
use serde_json::Value;
use std::fs;
use std::path::Path;

const BEGIN: &str = "<!-- keys ";
const END: &str = "<!-- end -->";

/// Definition that a schema refers to, or the schema itself.
fn resolved<'a>(definitions: &'a Value, schema: &'a Value) -> &'a Value {
    match schema["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
        Some(name) => resolved(definitions, &definitions[name]),
        None => schema,
    }
}

/// Unit of the values of a schema.
fn unit(definitions: &Value, schema: &Value) -> Option<String> {
    let found = resolved(definitions, schema);
    if let Some(unit) = found["x-unit"].as_str() {
        return Some(unit.into());
    }
    let forms = found["anyOf"].as_array().into_iter().flatten();
    let parts = forms.chain(found.get("items")).chain(found["prefixItems"].as_array().into_iter().flatten());
    parts.filter_map(|part| unit(definitions, part)).next()
}

/// Text and unit of a description that ends with ` \[unit\].`
fn parted(description: &str) -> (String, Option<&str>) {
    let end = description.strip_suffix("\\].").and_then(|text| text.rsplit_once(" \\["));
    end.map_or((description.to_string(), None), |(text, unit)| (format!("{text}."), Some(unit)))
}

/// Row of a key.
fn row(definitions: &Value, of: &str, key: &str) -> String {
    let property = &definitions[of]["properties"][key];
    let description = property["description"].as_str().unwrap_or_else(|| panic!("{of} has no key {key}"));
    let (text, said) = parted(description);
    let typed = unit(definitions, property);
    if let (Some(said), Some(typed)) = (said, &typed) {
        assert_eq!(said, typed, "unit of {key} of {of}");
    }
    let unit = said.map(str::to_string).or(typed).unwrap_or_default();
    let named = resolved(definitions, property)["additionalProperties"].is_object();
    let name = if named { ".NAME" } else { "" };
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = text.split('|').collect::<Vec<_>>().join("\\|");
    format!("| `{key}{name}` | {unit} | {text} |\n")
}

/// A page with the tables of the program.
fn written(definitions: &Value, text: &str) -> String {
    let mut parts = text.split(BEGIN);
    let mut page = parts.next().unwrap().to_string();
    for part in parts {
        let (head, rest) = part.split_once(" -->").unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        let (of, keys) = head.split_once(": ").unwrap();
        let rows: String = keys.split(' ').map(|key| row(definitions, of, key)).collect();
        page += &format!("{BEGIN}{head} -->\n| key | unit | |\n|---|---|---|\n{rows}{END}{tail}");
    }
    page
}

#[test]
fn the_tables_of_keys_are_those_of_the_program() {
    let schema = serde_json::to_value(schema()).unwrap();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/scene");
    let mut tables = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let page = written(&schema["$defs"], &text);
        if std::env::var_os("UPDATE_TABLES").is_some() {
            fs::write(&path, &page).unwrap();
        }
        let now = fs::read_to_string(&path).unwrap();
        assert!(now == page, "a table of {} is stale: run the test with UPDATE_TABLES=1", path.display());
        tables += text.matches(BEGIN).count();
    }
    assert!(tables > 15, "{tables} tables");
}
