//! Positions and depths in a text, one position a line.

use super::SheetError;

/// Rows of longitude, latitude and depth, separated by blanks, tabs or commas. Lines that begin with `#` or `>` are
/// comments or separate segments, and rows whose depth is `NaN` have no surface.
///
/// # Errors
/// [`SheetError::Line`] at a line that does not hold three numbers.
pub fn rows(text: &str) -> Result<Vec<[f64; 3]>, SheetError> {
    let mut all = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with(['#', '>']) {
            continue;
        }
        let row = row(line)
            .ok_or_else(|| SheetError::Line { line: k + 1, text: line.chars().take(SHOWN).collect() })?;
        if row[2].is_finite() {
            all.push(row);
        }
    }
    Ok(all)
}

/// Characters of a line that are shown.
const SHOWN: usize = 60;

/// Longitude, latitude and depth, which may be `NaN`.
fn row(line: &str) -> Option<[f64; 3]> {
    let mut numbers =
        line.split([',', ' ', '\t', ';']).filter(|word| !word.is_empty()).map(str::parse::<f64>);
    let row = [numbers.next()?.ok()?, numbers.next()?.ok()?, numbers.next()?.ok()?];
    let sound = row[0].is_finite() && row[1].is_finite() && !row[2].is_infinite();
    (numbers.next().is_none() && sound).then_some(row)
}
