//! Coordinates in words.

/// A position \[m\].
#[must_use]
pub fn in_words<const D: usize>(x: &[f64; D]) -> String {
    let coordinates: Vec<String> = x.iter().map(|c| c.to_string()).collect();
    format!("({}) m", coordinates.join(", "))
}
