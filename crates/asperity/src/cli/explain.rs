//! The command `explain`: rows of the reference of keys.

use super::end::End;
use asperity_output::terminal::printing::out;
use asperity_plan::reading::scene::keys::{self, Key, KeySearch, Row};
use miette::miette;

/// Longest line \[characters\].
pub const WIDTH: usize = 100;

/// Prints the rows of a key, or the keys that a scene begins with.
pub(super) fn print(key: Option<&str>) -> miette::Result<End> {
    match key.map(keys::find) {
        None => out(format_args!("{}", beginnings())),
        Some(KeySearch::Keys(keys)) => {
            let texts: Vec<String> = keys.iter().map(text).collect();
            out(format_args!("{}", texts.join("\n")));
        }
        Some(KeySearch::None(why)) => return Err(miette!("{why}")),
    }
    Ok(End::Done)
}

/// Keys that scenes begin with.
fn beginnings() -> String {
    let [bodies, sliders] = keys::roots();
    format!(
        "Keys of a scene of bodies or faults:\n{}\nKeys of a scene of spring-sliders:\n{}",
        table(&bodies),
        table(&sliders)
    )
}

/// A key in full.
fn text(key: &Key) -> String {
    let mut text = key.paths.join("\n") + "\n";
    text += &folded("  ", &plain(&key.row.text));
    let needed = if key.row.needed { "; needed" } else { "" };
    text += &folded("  value: ", &format!("{}{needed}", key.value));
    if !key.row.unit.is_empty() {
        text += &format!("  unit: {}\n", key.row.unit);
    }
    for (what, words) in [("default", &key.row.default), ("only for", &key.row.kinds)] {
        if !words.is_empty() {
            text += &folded(&format!("  {what}: "), &plain(words));
        }
    }
    for (name, meaning) in &key.choices {
        text += &folded(&format!("  \"{name}\": "), &plain(meaning));
    }
    if !key.keys.is_empty() {
        text += "  keys:\n";
        text += &table(&key.keys);
    }
    text
}

/// Rows in columns.
fn table(rows: &[Row]) -> String {
    let width = |of: fn(&Row) -> &str| rows.iter().map(|row| of(row).chars().count()).max().unwrap_or(0);
    let (keys, units) = (width(|row| &row.key), width(|row| &row.unit));
    let line = |row: &Row| {
        let (key, unit) = (&row.key, &row.unit);
        folded(&format!("    {key:keys$}  {unit:units$}  "), &plain(&row.full()))
    };
    rows.iter().map(line).collect()
}

/// Text in lines of limited length, the first of which begins with `head`.
pub fn folded(head: &str, text: &str) -> String {
    let indent = head.chars().count();
    let (mut lines, mut length) = (head.to_string(), indent);
    for (i, word) in text.split(' ').enumerate() {
        let more = word.chars().count();
        if i > 0 && length + 1 + more > WIDTH {
            lines += &format!("\n{:indent$}", "");
            length = indent;
        } else if i > 0 {
            lines.push(' ');
            length += 1;
        }
        lines += word;
        length += more;
    }
    lines.trim_end().to_string() + "\n"
}

/// Markdown as plain text: links without their targets, and no escapes.
pub fn plain(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('[') {
        let Some((words, target)) = after.split_once("](").filter(|_| !before.ends_with('\\')) else {
            plain += before;
            plain.push('[');
            rest = after;
            continue;
        };
        plain = plain + before + words;
        rest = target.split_once(')').map_or("", |(_, rest)| rest);
    }
    plain += rest;
    plain.chars().filter(|c| *c != '\\').collect()
}
