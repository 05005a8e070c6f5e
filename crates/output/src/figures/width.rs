//! Width of text.

/// Mean width of a character of DejaVu Sans over its em, for text with capitals and digits: slightly more than for plain text.
pub(super) const CHARACTER: f64 = 0.62;
/// Smallest em size in a legend.
const LEAST: f64 = 6.0;
/// Part of a character that rounding may take from a text that just fits.
const ROUNDING: f64 = 1e-9;

/// Em size, at most `size`, at which a line fits a width of `room`; it is never smaller than [`LEAST`].
pub(super) fn within(text: &str, room: f64, size: f64) -> f64 {
    size.min(room / (CHARACTER * text.chars().count().max(1) as f64)).max(LEAST)
}

/// A text of at most the em size `size`, shortened if it does not fit a width of `room` even in the smallest size.
pub(super) fn fitting(text: &str, room: f64, size: f64) -> (String, f64) {
    let size = within(text, room, size);
    let most = (room / (CHARACTER * size) + ROUNDING) as usize;
    if text.chars().count() <= most {
        return (text.to_owned(), size);
    }
    (text.chars().take(most.saturating_sub(1)).chain(['\u{2026}']).collect(), size)
}
