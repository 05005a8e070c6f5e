//! Reader of field files that shares no code with the writer.
//!
//! An array of the appended section starts with a header of eight-byte words: the number of blocks, two sizes, and the
//! compressed size of each block. The blocks follow as zlib streams. Header and blocks are encoded in base64
//! separately.

use crate::CaseError;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read as _;

/// Bytes in a word.
const WORD: usize = 8;

/// An array of a file.
pub struct Array {
    name: String,
    /// Names of components, if the file gives them.
    pub components: Vec<String>,
    /// Values, tuple by tuple.
    pub values: Vec<f64>,
}

/// The arrays of a field file.
pub struct Fields(Vec<Array>);

/// Number of base64 characters that encode `bytes` bytes.
fn characters(bytes: usize) -> usize {
    bytes.div_ceil(3) * 4
}

/// Value of an attribute of an element.
fn attribute<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = line.split_once(&format!(" {key}=\""))?;
    Some(rest.split_once('"')?.0)
}

/// Decodes words from base64.
fn words(text: &str) -> Result<Vec<usize>, CaseError> {
    let bytes = STANDARD.decode(text)?;
    let word = |w: &[u8]| Ok(usize::try_from(u64::from_le_bytes(w.try_into()?))?);
    bytes.chunks_exact(WORD).map(word).collect()
}

/// Decoded and decompressed bytes of an array.
fn decode(text: &str) -> Result<Vec<u8>, CaseError> {
    let cut = |from: usize, length: usize| text.get(from..from + length).ok_or("the file ends early");
    let blocks = *words(cut(0, characters(3 * WORD))?)?.first().ok_or("no head")?;
    let head = characters((3 + blocks) * WORD);
    let sizes = words(cut(0, head)?)?.split_off(3);
    let data = STANDARD.decode(cut(head, characters(sizes.iter().sum()))?)?;
    let (mut out, mut rest) = (Vec::new(), data.as_slice());
    for size in sizes {
        let (block, next) = rest.split_at_checked(size).ok_or("a block ends early")?;
        ZlibDecoder::new(block).read_to_end(&mut out)?;
        rest = next;
    }
    Ok(out)
}

/// Numbers of an array of this VTK type.
fn numbers(kind: &str, bytes: &[u8]) -> Result<Vec<f64>, CaseError> {
    match kind {
        "Float64" => bytes.chunks_exact(WORD).map(|b| Ok(f64::from_le_bytes(b.try_into()?))).collect(),
        "Int64" => bytes.chunks_exact(WORD).map(|b| Ok(i64::from_le_bytes(b.try_into()?) as f64)).collect(),
        "UInt8" => Ok(bytes.iter().map(|b| f64::from(*b)).collect()),
        other => Err(format!("no numbers of type {other} are expected").into()),
    }
}

impl Fields {
    /// Reads the text of a file.
    ///
    /// # Errors
    /// If it is not a grid with appended arrays.
    pub fn read(text: &str) -> Result<Self, CaseError> {
        let (head, appended) =
            text.split_once("<AppendedData encoding=\"base64\">\n_").ok_or("no appended data")?;
        let array = |line: &str| -> Result<Array, CaseError> {
            let need = |key: &str| attribute(line, key).ok_or_else(|| format!("no {key} in {line}"));
            let from: usize = need("offset")?.parse()?;
            let bytes = decode(appended.get(from..).ok_or("the file ends early")?)?;
            let component = |k: usize| attribute(line, &format!("ComponentName{k}")).map(str::to_owned);
            Ok(Array {
                name: need("Name")?.to_owned(),
                components: (0..).map_while(component).collect(),
                values: numbers(need("type")?, &bytes)?,
            })
        };
        let lines = head.lines().filter(|line| line.starts_with("<DataArray"));
        Ok(Self(lines.map(array).collect::<Result<_, _>>()?))
    }

    /// Array with this name.
    ///
    /// # Errors
    /// If there is none.
    pub fn array(&self, name: &str) -> Result<&Array, CaseError> {
        self.0.iter().find(|a| a.name == name).ok_or_else(|| format!("no array {name}").into())
    }

    /// Values of an array of integers.
    ///
    /// # Errors
    /// If there is none.
    pub fn indices(&self, name: &str) -> Result<Vec<usize>, CaseError> {
        Ok(self.array(name)?.values.iter().map(|v| *v as usize).collect())
    }
}
