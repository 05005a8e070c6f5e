//! Formatting of coordinates.

/// Formats a position \[m\].
#[must_use]
pub fn in_words<const D: usize>(x: &[f64; D]) -> String {
    // Adding zero turns -0 into 0.
    let coordinates: Vec<String> = x.iter().map(|c| (c + 0.0).to_string()).collect();
    format!("({}) m", coordinates.join(", "))
}
