//! Translation of errors of the TOML reader into terms of a scene.

use super::suggestions::suggest;
use crate::diagnostic::Diagnostic;
use std::ops::Range;

/// Keys of a scene that are tables, each with the header of such a table.
const TABLES: [(&str, &str); 4] = [
    ("materials", "[materials.NAME]"),
    ("bodies", "[bodies.NAME]"),
    ("stages", "[[stages]]"),
    ("time", "[time]"),
];

/// Explains an error of the TOML reader about `text`, with a suggestion of what was probably meant.
#[must_use]
pub(super) fn explain(error: &toml::de::Error, text: &str) -> Diagnostic {
    let place = error.span().unwrap_or(0..0);
    let found = text.get(place.clone()).unwrap_or_default().trim();
    let next = text.get(place.start..).and_then(|t| t.chars().next());
    let (message, help) = content(error.message())
        .or_else(|| syntax(error.message(), found, next))
        .unwrap_or_else(|| (error.message().to_string(), None));
    Diagnostic { message, help, span: visible(place, text), also: Vec::new() }
}

/// A message and, if known, a suggestion.
type Words = (String, Option<String>);

/// Explains errors in a file that is valid TOML but not a scene.
fn content(message: &str) -> Option<Words> {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let wrong = quoted.first().copied().unwrap_or_default();
    let listed = |what| Some(suggest(wrong, what, quoted.iter().skip(1).copied()));
    if message.starts_with("unknown field") {
        return Some((format!("there is no key `{wrong}` here"), listed("keys")));
    }
    if message.starts_with("unknown variant") {
        return Some((format!("there is no choice `{wrong}` here"), listed("choices")));
    }
    if message.starts_with("missing field") {
        let table = TABLES.iter().find(|t| t.0 == wrong);
        return Some(match table {
            Some((_, begin)) => {
                (format!("the scene has no `{wrong}`"), Some(format!("add a table `{begin}`")))
            }
            None => (format!("the key `{wrong}` is missing"), Some(format!("add `{wrong} = ..` here"))),
        });
    }
    if message.contains("expected newtype variant") {
        return Some((
            "a kind alone says too little".into(),
            Some("such as `mesh.block = { .. }`, or `triangles.stl = { .. }` of a fault".into()),
        ));
    }
    if let Some((kind, rest)) = message.split_once(", expected ")
        && let Some(found) = ["invalid type: ", "invalid value: "].iter().find_map(|p| kind.strip_prefix(p))
    {
        return Some((format!("expected {}, found {}", wanted(rest), given(found)), None));
    }
    if let Some((length, rest)) =
        message.strip_prefix("invalid length ").and_then(|m| m.split_once(", expected "))
    {
        let entries = if length == "1" { "entry" } else { "entries" };
        return Some((format!("expected {}, found {length} {entries}", wanted(rest)), None));
    }
    match message {
        "duplicate key" => Some(("this key is given twice".into(), Some("remove one of the two".into()))),
        "wanted string or table" => Some(("expected a text in quotes or a table".into(), None)),
        _ if message.starts_with("wanted exactly 1 element") => Some((
            "one kind is expected here, and only one".into(),
            Some("such as `mesh.block = { .. }`, or `triangles.stl = { .. }` of a fault".into()),
        )),
        _ => None,
    }
}

/// Explains errors in a file that is not TOML and whose messages by the reader are misleading.
fn syntax(message: &str, found: &str, next: Option<char>) -> Option<Words> {
    if message.starts_with("string values must be quoted") {
        return Some(if found.is_empty() {
            ("there is no value after `=`".into(), None)
        } else {
            let help = format!("a text, or a number with a unit, is written in quotes: `\"{found}\"`");
            (format!("`{found}` is not a value"), Some(help))
        });
    }
    if message.starts_with("invalid basic string, expected `\"`") {
        return Some(("the text does not end on its line".into(), Some("close it with `\"`".into())));
    }
    if message.starts_with("invalid boolean") {
        return Some((
            format!("`{found}` is not a value"),
            Some("it is `true` or `false`, in small letters".into()),
        ));
    }
    if message.starts_with("unexpected key or value") && next == Some(',') {
        let help = "the decimal sign is a point, and each line has one key";
        return Some(("unexpected comma".into(), Some(help.into())));
    }
    None
}

/// Plain names of the types that the reader expects.
fn wanted(expected: &str) -> &str {
    match expected {
        "a sequence" => "a list",
        "a map" => "a table",
        "a boolean" => "true or false",
        "a string" => "a text in quotes",
        "f64" => "a number",
        "usize" => "a whole number that is not negative",
        "u32" => "a whole number from 0 to 4294967295",
        other if other.starts_with("struct ") => "a table",
        other => other,
    }
}

/// Plain names of what the reader found.
fn given(found: &str) -> String {
    match found {
        "map" => return "a table".into(),
        "sequence" => return "a list".into(),
        _ => {}
    }
    for (type_, name) in
        [("string ", "the text "), ("integer ", ""), ("floating point ", ""), ("boolean ", "")]
    {
        if let Some(value) = found.strip_prefix(type_) {
            return format!("{name}{}", value.trim_matches('`'));
        }
    }
    found.to_string()
}

/// Extends an empty span to at least one character: for something missing, the reader points between two characters.
fn visible(span: Range<usize>, text: &str) -> Range<usize> {
    if !span.is_empty() || text.is_empty() {
        return span;
    }
    let width = |c: Option<char>| c.map_or(0, char::len_utf8);
    match text.get(span.start..).and_then(|t| t.chars().next()).filter(|c| *c != '\n') {
        Some(next) => span.start..span.start + next.len_utf8(),
        None => span.start - width(text.get(..span.start).and_then(|t| t.chars().next_back()))..span.start,
    }
}
