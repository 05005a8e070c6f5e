//! Rows of a table of numbers, read one by one.

use crate::OutputError;
use std::path::Path;

/// Passes the rows of a table of numbers to `look` one by one; incomplete rows are skipped.
///
/// # Errors
/// If the table cannot be read.
pub fn each(path: &Path, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
    let failed = |e: csv::Error| OutputError::Draw { path: path.to_path_buf(), reason: e.to_string() };
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path).map_err(failed)?;
    let width = reader.headers().map_err(failed)?.len();
    let (mut record, mut row) = (csv::StringRecord::new(), Vec::with_capacity(width));
    while reader.read_record(&mut record).map_err(failed)? {
        row.clear();
        row.extend(record.iter().map(|v| v.parse().unwrap_or(f64::NAN)));
        if row.len() == width && width > 0 {
            look(&row);
        }
    }
    Ok(())
}
