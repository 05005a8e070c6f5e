//! Field files, read without the code that writes them.
//!
//! An array of the appended section has a head of words of eight bytes: the number of blocks, two sizes, and the compressed
//! size of each block. The blocks follow as zlib streams. Head and blocks are each in base64.

use crate::CaseError;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read as _;

/// Bytes of a word.
const WORD: usize = 8;

/// An array of a file.
pub struct Array {
    name: String,
    /// Names of components, where the file has them.
    pub components: Vec<String>,
    /// Values, tuple by tuple.
    pub values: Vec<f64>,
}

/// The arrays of a field file.
pub struct Fields(Vec<Array>);

/// Characters of base64 that hold so many bytes.
fn characters(bytes: usize) -> usize {
    bytes.div_ceil(3) * 4
}

/// Value of an attribute of an element.
fn attribute<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = line.split_once(&format!(" {key}=\""))?;
    Some(rest.split_once('"')?.0)
}

/// Words from their text.
fn words(text: &str) -> Result<Vec<usize>, CaseError> {
    let bytes = STANDARD.decode(text)?;
    let word = |w: &[u8]| Ok(usize::try_from(u64::from_le_bytes(w.try_into()?))?);
    bytes.chunks_exact(WORD).map(word).collect()
}

/// Bytes of an array.
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

/// Numbers of an array of this type.
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
    /// If it is none of a grid with appended arrays.
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

    /// Array of this name.
    ///
    /// # Errors
    /// If there is none.
    pub fn array(&self, name: &str) -> Result<&Array, CaseError> {
        self.0.iter().find(|a| a.name == name).ok_or_else(|| format!("no array {name}").into())
    }

    /// Numbers of an array that counts or points.
    ///
    /// # Errors
    /// If there is none.
    pub fn indices(&self, name: &str) -> Result<Vec<usize>, CaseError> {
        Ok(self.array(name)?.values.iter().map(|v| *v as usize).collect())
    }
}
