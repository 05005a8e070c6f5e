//! Rows of a table of numbers, read one by one.

use crate::OutputError;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// Passes the rows of a table of numbers to `look` one by one; incomplete rows are skipped.
///
/// # Errors
/// If the table cannot be read.
pub fn each(path: &Path, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
    let failed = |e: csv::Error| OutputError::Draw { path: path.to_path_buf(), reason: e.into() };
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

/// Passes the rows of a table whose columns are apart by spaces to `look` one by one. Lines that begin with # and the line
/// with the names of the columns are skipped, as are incomplete rows.
///
/// # Errors
/// If the table cannot be read.
pub fn spaced(path: &Path, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
    let failed = |source: std::io::Error| OutputError::Read { path: path.to_path_buf(), source };
    let mut reader = BufReader::new(File::open(path).map_err(failed)?);
    let (mut line, mut row, mut width) = (String::new(), Vec::new(), None);
    while reader.read_line(&mut line).map_err(failed)? > 0 {
        if !line.starts_with('#') {
            match width {
                None => width = Some(line.split_whitespace().count()),
                Some(width) => {
                    row.clear();
                    row.extend(line.split_whitespace().map(|v| v.parse().unwrap_or(f64::NAN)));
                    // The last line of a file that is being written may end within a number.
                    if row.len() == width && width > 0 && line.ends_with('\n') {
                        look(&row);
                    }
                }
            }
        }
        line.clear();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_table_apart_by_spaces_has_its_whole_rows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("station");
        std::fs::write(&path, "# a\n# b\nt slip\n0 1.5\n1e9 nan\n2 \n3 4").unwrap();
        let mut rows = Vec::new();
        super::spaced(&path, &mut |row| rows.push(row.to_vec())).unwrap();
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[0], [0.0, 1.5]);
        assert!(rows[1][0] == 1e9 && rows[1][1].is_nan());
        assert!(super::spaced(&folder.path().join("none"), &mut |_| {}).is_err());
    }
}
