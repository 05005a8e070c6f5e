//! Single arrays of files of this program, for figures drawn after a run.

use super::reading;
use crate::OutputError;
use std::path::Path;

/// Values of the array of numbers of this name, at points or in cells.
///
/// # Errors
/// If the file cannot be read, or has no such array of one component.
pub fn array(path: &Path, name: &str) -> Result<Vec<f64>, OutputError> {
    let failed = |source: std::io::Error| OutputError::Read { path: path.to_path_buf(), source };
    let bytes = std::fs::read(path).map_err(failed)?;
    let grid = reading::read(&bytes, name).map_err(|e| failed(std::io::Error::other(e)))?;
    let found = grid.at_points.into_iter().chain(grid.in_cells).find(|array| array.components == 1);
    let missing = || failed(std::io::Error::other(format!("its array `{name}` has several components")));
    Ok(found.ok_or_else(missing)?.values)
}

#[cfg(test)]
mod tests {
    use super::super::{Array, Grid, Values};
    use super::*;

    #[test]
    fn an_array_is_read_as_it_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.vtu");
        for n in [1, 4096, 5000] {
            let points: Vec<[f64; 3]> = (0..n).map(|i| [f64::from(i), 0.5, -1.0]).collect();
            let values: Vec<f64> =
                (0..n).map(|i| if i == 0 { f64::NAN } else { f64::from(i).sqrt() }).collect();
            let twice: Vec<f64> = values.iter().map(|v| 2.0 * v).collect();
            let arrays = [
                Array::scalar("slip", Values::F64(&values)),
                Array::scalar("slip_rate", Values::F64(&twice)),
            ];
            let file = Grid::new(&points, &[]).file(0.0, &arrays, &[]);
            std::fs::write(&path, file).unwrap();
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&array(&path, "slip").unwrap()), bits(&values));
            assert_eq!(bits(&array(&path, "slip_rate").unwrap()), bits(&twice));
        }
    }

    #[test]
    fn what_is_no_such_file_is_an_error_with_its_reason() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.vtu");
        assert!(array(&path, "slip").is_err());
        let whole = Grid::new(&[[0.0; 3]], &[]).file(0.0, &[Array::scalar("slip", Values::F64(&[1.0]))], &[]);
        let text = String::from_utf8(whole).unwrap();
        for damaged in ["", "text", &text[..text.len() - 60], &text[..text.len() / 2]] {
            std::fs::write(&path, damaged).unwrap();
            assert!(array(&path, "slip").is_err(), "{damaged}");
        }
        std::fs::write(&path, &text).unwrap();
        let OutputError::Read { source, .. } = array(&path, "state").unwrap_err() else { panic!() };
        assert!(source.to_string().contains("`state`"), "{source}");
    }
}
