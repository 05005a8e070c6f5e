//! Values that a key takes, as text.

use super::tree::Tree;
use serde_json::Value;

/// Values that may stand in the position of a schema.
pub(super) fn words(tree: &Tree, schema: &Value) -> String {
    let mut parts: Vec<String> = Vec::new();
    for form in tree.forms(schema) {
        let part = words_of(tree, form);
        if !part.is_empty() && !parts.contains(&part) {
            parts.push(part);
        }
    }
    parts.join(", or ")
}

fn words_of(tree: &Tree, schema: &Value) -> String {
    if let Some(expected) = schema["description"].as_str().and_then(|text| text.strip_prefix("Expected: ")) {
        return expected.trim_end_matches('.').into();
    }
    if schema["const"].is_string() {
        return "one of the choices".into();
    }
    let types = match &schema["type"] {
        Value::Array(several) => several.iter().filter_map(Value::as_str).collect(),
        one => one.as_str().into_iter().collect::<Vec<_>>(),
    };
    let each = types.into_iter().filter_map(|name| word(tree, schema, name));
    each.collect::<Vec<_>>().join(" or ")
}

fn word(tree: &Tree, schema: &Value, name: &str) -> Option<String> {
    Some(match name {
        "number" => "a number".into(),
        "integer" => "a whole number".into(),
        "boolean" => "true or false".into(),
        "string" => "a text in quotes".into(),
        "object" if schema["additionalProperties"].is_object() => "a table of names".into(),
        "object" => "a table".into(),
        "array" => {
            let several = schema["prefixItems"].as_array();
            let length = match (several, &schema["maxItems"]) {
                (Some(parts), _) => format!(" of {}", parts.len()),
                (None, Value::Number(most)) if schema["minItems"] == schema["maxItems"] => {
                    format!(" of {most}")
                }
                _ => String::new(),
            };
            let parts = match several {
                Some(parts) => parts.iter().map(|part| words(tree, part)).collect::<Vec<_>>().join("; "),
                None => words(tree, &schema["items"]),
            };
            format!("a list{length}, each entry {parts}")
        }
        _ => return None,
    })
}

/// Choices of a key with their descriptions; empty if it has none.
pub(super) fn choices(tree: &Tree, schema: &Value) -> Vec<(String, String)> {
    let choice = |form: &&Value| {
        let name = form["const"].as_str()?.to_string();
        Some((name, form["description"].as_str().unwrap_or_default().to_string()))
    };
    tree.forms(schema).iter().filter_map(choice).collect()
}
