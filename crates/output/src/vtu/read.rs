//! Reading of single arrays of files of this program, for figures drawn after a run.

use crate::OutputError;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read as _;
use std::path::Path;

/// Bytes of a word.
const WORD: usize = 8;
/// Words of a header before the sizes of the blocks.
const FIRST: usize = 3;

/// Values of the array of numbers of this name.
///
/// # Errors
/// If the file cannot be read, or has no such array as this program writes it.
pub fn array(path: &Path, name: &str) -> Result<Vec<f64>, OutputError> {
    let failed = |source: std::io::Error| OutputError::Read { path: path.to_path_buf(), source };
    let text = std::fs::read_to_string(path).map_err(failed)?;
    let missing = || failed(std::io::Error::other(format!("it has no readable array `{name}`")));
    of_text(&text, name).ok_or_else(missing)
}

fn of_text(text: &str, name: &str) -> Option<Vec<f64>> {
    let (head, rest) = text.split_once("<AppendedData encoding=\"base64\">\n_")?;
    let named = format!("<DataArray type=\"Float64\" Name=\"{}\"", super::escape(name));
    let line =
        head.lines().find(|line| line.strip_prefix(&named).is_some_and(|after| after.starts_with(' ')))?;
    let offset = line.split_once(" offset=\"")?.1.split_once('"')?.0;
    let bytes = decoded(rest.get(offset.parse().ok()?..)?)?;
    let (whole, left) = bytes.as_chunks::<WORD>();
    left.is_empty().then(|| whole.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
}

/// Characters of this many encoded bytes.
fn characters(bytes: usize) -> usize {
    bytes.div_ceil(3) * 4
}

/// Contents of the array at the beginning of a text.
fn decoded(text: &str) -> Option<Vec<u8>> {
    let words = |count: usize| -> Option<Vec<usize>> {
        let bytes = STANDARD.decode(text.get(..characters(count.checked_mul(WORD)?))?).ok()?;
        let (whole, _) = bytes.as_chunks::<WORD>();
        whole.iter().map(|bytes| usize::try_from(u64::from_le_bytes(*bytes)).ok()).collect()
    };
    let count = FIRST.checked_add(*words(FIRST)?.first()?)?;
    let sizes = words(count)?.split_off(FIRST);
    let from = characters(count * WORD);
    let total = sizes.iter().try_fold(0_usize, |sum, size| sum.checked_add(*size))?;
    let data = STANDARD.decode(text.get(from..from.checked_add(characters(total))?)?).ok()?;
    let (mut out, mut at) = (Vec::new(), 0);
    for size in sizes {
        ZlibDecoder::new(data.get(at..at + size)?).read_to_end(&mut out).ok()?;
        at += size;
    }
    Some(out)
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
            let message = array(&path, "slip").unwrap_err();
            assert!(format!("{message:?}").contains("no readable array `slip`"), "{message:?}");
        }
        std::fs::write(&path, &text).unwrap();
        assert!(array(&path, "state").is_err());
    }
}
