//! HTML of values of a report.

use serde_json::{Map, Value};
use std::fmt::Write as _;

/// Largest number of rows of a table; a longer one ends with the number of the others.
const ROWS: usize = 200;
/// Digits of numbers, as in a printed report.
const DIGITS: usize = 6;
/// Powers of ten between which numbers are written without an exponent.
const PLAIN: std::ops::Range<i32> = -3..7;

/// Text with the characters that HTML reserves replaced.
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            other => safe.push(other),
        }
    }
    safe
}

/// A value as HTML: objects as tables of two columns, lists of objects as tables, other lists in one line.
pub fn value(value: &Value) -> String {
    match value {
        Value::Object(object) => object_table(object),
        Value::Array(list) if list.iter().any(Value::is_object) => row_table(list),
        Value::Array(list) => list.iter().map(scalar).collect::<Vec<_>>().join(", "),
        other => scalar(other),
    }
}

/// Name of a key for people.
fn named(key: &str) -> String {
    escape(&key.split('_').collect::<Vec<_>>().join(" "))
}

fn scalar(value: &Value) -> String {
    match value {
        Value::Null => "none".into(),
        Value::Bool(true) => "yes".into(),
        Value::Bool(false) => "no".into(),
        Value::Number(n) if n.is_f64() => n.as_f64().map_or(String::new(), number),
        Value::Number(n) => n.to_string(),
        Value::String(text) => escape(text),
        Value::Array(_) | Value::Object(_) => self::value(value),
    }
}

/// A number with few digits; the report has all of them.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    let scientific = format!("{value:.*e}", DIGITS - 1);
    let exponent = scientific.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok());
    let Some(exponent) = exponent.filter(|e| PLAIN.contains(e)) else {
        let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        return format!("{}e{exponent}", without_zeros(digits));
    };
    let decimals = usize::try_from(DIGITS as i32 - 1 - exponent).unwrap_or(0);
    without_zeros(&format!("{value:.decimals$}")).into()
}

fn without_zeros(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

fn object_table(object: &Map<String, Value>) -> String {
    let mut html = String::from("<table>");
    for (key, value) in object {
        // Writing to a String cannot fail.
        let _ = write!(html, "<tr><th>{}</th>{}</tr>", named(key), cell(value));
    }
    html + "</table>"
}

fn cell(value: &Value) -> String {
    let class = if value.is_number() { " class=\"number\"" } else { "" };
    format!("<td{class}>{}</td>", self::value(value))
}

/// A table with a column for each key that some row has.
fn row_table(rows: &[Value]) -> String {
    let mut keys: Vec<&String> = Vec::new();
    for key in rows.iter().filter_map(Value::as_object).flat_map(Map::keys) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let cells = |row: &Value| -> String {
        keys.iter().map(|&key| row.get(key).map_or("<td></td>".into(), cell)).collect()
    };
    let head: String = keys.iter().map(|key| format!("<th>{}</th>", named(key))).collect();
    framed(&head, rows.iter().map(cells))
}

/// A table of texts.
pub fn table(head: &[String], rows: &[Vec<String>]) -> String {
    let head: String = head.iter().map(|name| format!("<th>{}</th>", escape(name))).collect();
    let one = |field: &String| {
        let class = if field.parse::<f64>().is_ok() { " class=\"number\"" } else { "" };
        format!("<td{class}>{}</td>", escape(field))
    };
    framed(&head, rows.iter().map(|row| row.iter().map(one).collect()))
}

/// A table of rows, at most [`ROWS`] of them.
fn framed(head: &str, rows: impl ExactSizeIterator<Item = String>) -> String {
    let more = rows.len().saturating_sub(ROWS);
    let rows: String = rows.take(ROWS).map(|row| format!("<tr>{row}</tr>\n")).collect();
    let table = format!("<div class=\"wide\"><table><tr>{head}</tr>\n{rows}</table></div>");
    if more == 0 { table } else { format!("{table}<p class=\"facts\">and {more} more</p>") }
}

/// A section with a heading; nothing without a body.
pub fn section(heading: &str, body: &str) -> String {
    if body.is_empty() { String::new() } else { format!("<h2>{heading}</h2>\n{body}\n") }
}

/// Text in its own layout, shown on demand.
pub fn folded(summary: &str, text: &str) -> String {
    format!("<details><summary>{}</summary><pre>{}</pre></details>", escape(summary), escape(text))
}
