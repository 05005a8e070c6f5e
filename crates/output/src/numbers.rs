//! Numbers read back from JSON, which has neither infinity nor NaN: both are written as `null`.

use serde::{Deserialize, Deserializer};

/// Reads numbers; `null` represents infinity.
pub(crate) fn or_infinite<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    filled(from, f64::INFINITY)
}

/// Reads numbers; `null` represents NaN.
pub(crate) fn or_nan<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    filled(from, f64::NAN)
}

fn filled<'de, D: Deserializer<'de>>(from: D, other: f64) -> Result<Vec<f64>, D::Error> {
    let read = Vec::<Option<f64>>::deserialize(from)?;
    Ok(read.into_iter().map(|v| v.unwrap_or(other)).collect())
}
