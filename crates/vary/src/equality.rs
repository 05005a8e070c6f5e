//! Equality of values in scenes.

use toml_edit::{Item, TableLike, Value};

/// Returns true if an item of a scene equals this value, regardless of notation: 2 equals 2.0, and a table with a header equals
/// an inline one.
#[allow(clippy::float_cmp, reason = "two numbers as written are one number or they are not")]
pub fn same(item: &Item, value: &Value) -> bool {
    if let (Some(a), Some(b)) = (item.as_table_like(), value.as_inline_table()) {
        return same_tables(a, b);
    }
    if let (Item::ArrayOfTables(a), Value::Array(b)) = (item, value) {
        let tables = |b: &Value| b.as_inline_table().cloned();
        return a.len() == b.len()
            && a.iter().zip(b).all(|(a, b)| tables(b).is_some_and(|b| same_tables(a, &b)));
    }
    let Item::Value(old) = item else { return false };
    match (old, value) {
        (Value::String(a), Value::String(b)) => a.value() == b.value(),
        (Value::Boolean(a), Value::Boolean(b)) => a.value() == b.value(),
        (Value::Datetime(a), Value::Datetime(b)) => a.value() == b.value(),
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(&Item::Value(a.clone()), b))
        }
        _ => number(old).zip(number(value)).is_some_and(|(a, b)| a == b),
    }
}

fn same_tables(a: &dyn TableLike, b: &dyn TableLike) -> bool {
    a.len() == b.len()
        && a.iter().all(|(key, item)| b.get(key).and_then(Item::as_value).is_some_and(|b| same(item, b)))
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|i| i as f64))
}
