//! Defaults of keys, as parts of their rows.

use crate::units;
use serde::Serialize;
use serde_json::{Value, json};

/// Default of a key: a value, and others under some circumstances.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub(crate) struct KeyDefault(Vec<Value>);

/// A default.
pub(crate) fn usual(value: impl Serialize) -> KeyDefault {
    KeyDefault(vec![json!({ "value": value })])
}

impl KeyDefault {
    /// Makes the value a share of something.
    pub fn share_of(mut self, what: &str) -> Self {
        if let Some(case) = self.0.last_mut() {
            case["of"] = what.into();
        }
        self
    }

    /// Restricts the value to a circumstance.
    pub fn only(mut self, circumstance: &str) -> Self {
        if let Some(case) = self.0.last_mut() {
            case["with"] = circumstance.into();
        }
        self
    }

    /// Adds another value, under a circumstance.
    pub fn but(mut self, value: impl Serialize, circumstance: &str) -> Self {
        self.0.push(json!({ "value": value, "with": circumstance }));
        self
    }
}

/// A default in one line, in this unit.
pub(crate) fn line(default: &Value, unit: &str) -> String {
    let case = |case: &Value| {
        let value = match case["of"].as_str() {
            Some(of) => format!("{} of {of}", number(&case["value"])),
            None => code(&written(&case["value"], unit)),
        };
        case["with"].as_str().map_or(value.clone(), |with| format!("{value} {with}"))
    };
    default.as_array().into_iter().flatten().map(case).collect::<Vec<_>>().join(", ")
}

/// A text of a scene as code of Markdown; numbers do without.
fn code(text: &str) -> String {
    if text.starts_with(|c: char| c.is_ascii_digit()) { text.to_owned() } else { format!("`{text}`") }
}

/// The default that holds in most scenes, as text of a scene; `None` if it is a share of something.
pub(crate) fn entry(default: &Value, unit: &str) -> Option<String> {
    let case = default.get(0).filter(|case| case.get("of").is_none() && case.get("with").is_none())?;
    Some(written(&case["value"], unit))
}

/// Units in which values of an SI unit are usually written.
const FRIENDLY: [(&str, &str); 5] =
    [("bytes", "GiB"), ("bytes", "MB"), ("m/s", "mm/s"), ("rad", "deg"), ("s", "yr")];

/// Rounding of a number of tenths of a unit.
const ROUNDING: f64 = 1e-9;

fn written(value: &Value, unit: &str) -> String {
    let Some(size) = value.as_f64().filter(|size| *size != 0.0 && !unit.is_empty() && unit != "-") else {
        return number(value);
    };
    let tenths = |name: &str| 10.0 * size / units::si_value(&format!("1 {name}")).unwrap_or(f64::NAN);
    let short = |name: &str| {
        let tenths = tenths(name);
        (1.0..1e4).contains(&tenths) && (tenths - tenths.round()).abs() < ROUNDING * tenths
    };
    match FRIENDLY.iter().find(|(si, name)| *si == unit && short(name)) {
        Some((_, name)) => format!("\"{} {name}\"", tenths(name).round() / 10.0),
        None => format!("\"{} {unit}\"", number(value)),
    }
}

/// A number with few digits where that is short.
fn number(value: &Value) -> String {
    let Some(size) = value.as_f64() else { return value.to_string() };
    let plain = value.is_u64() || (1e-2..1e5).contains(&size.abs()) || size == 0.0;
    if plain { size.to_string() } else { format!("{size:e}") }
}
