//! Numbers of a `DataArray`.

use super::binary::{Source, Storage};
use super::error::{ArrayError, VtuError};
use super::xml::{Document, Element};
use std::cell::Cell;

/// Bytes of unpacked numbers over those of their packed form up to which a file is taken at its word. Positions and fields seldom
/// reach 20; zlib reaches 1032, with which a file of some megabytes announces gigabytes of zeros.
const RATIO: usize = 100;

/// Bytes of unpacked numbers beyond [`RATIO`] that a file may have in all its arrays: eight million zeros, such as a field that
/// vanishes on a large mesh.
const SPARE: usize = 64 << 20;

/// Reader of the arrays of a file.
pub(super) struct Arrays<'a> {
    pub document: &'a Document<'a>,
    storage: Storage,
    /// Remainder of [`SPARE`].
    spare: Cell<usize>,
}

impl<'a> Arrays<'a> {
    pub fn read(document: &'a Document<'a>) -> Result<Self, VtuError> {
        let root = &document.root;
        let given = |name: &str, default: &'static str| root.attribute(name).unwrap_or(default).to_string();
        let refuse = |attribute, found, read| Err(VtuError::Storage { attribute, found, read });
        let (order, header) = (given("byte_order", "LittleEndian"), given("header_type", "UInt32"));
        let compressor = given("compressor", "");
        let little = match order.as_str() {
            "LittleEndian" => true,
            "BigEndian" => false,
            _ => return refuse("byte_order", order, "`LittleEndian` or `BigEndian`"),
        };
        let header = match header.as_str() {
            "UInt32" => 4,
            "UInt64" => 8,
            _ => return refuse("header_type", header, "`UInt32` or `UInt64`"),
        };
        if !matches!(compressor.as_str(), "" | "vtkZLibDataCompressor") {
            return refuse("compressor", compressor, "`vtkZLibDataCompressor`");
        }
        let storage = Storage { little, header, compressed: !compressor.is_empty() };
        Ok(Self { document, storage, spare: Cell::new(SPARE) })
    }

    /// Numbers of an array.
    pub fn numbers(&self, element: &Element, count: usize) -> Result<Vec<f64>, VtuError> {
        let name = element.attribute("Name").unwrap_or_default().to_string();
        let values = self.values(element, count);
        let values = values.map_err(|why| VtuError::Array { name: name.clone(), why })?;
        if values.len() == count {
            return Ok(values);
        }
        let why = ArrayError::Count { found: values.len(), needed: count };
        Err(VtuError::Array { name, why })
    }

    fn values(&self, element: &Element, count: usize) -> Result<Vec<f64>, ArrayError> {
        let kind = element.attribute("type").unwrap_or_default();
        let (size, number) = number(kind).ok_or_else(|| ArrayError::Type(kind.into()))?;
        let wanted = count.checked_mul(size).ok_or(ArrayError::Long)?;
        let source = match element.attribute("format").unwrap_or("ascii") {
            "ascii" => return ascii(&element.text),
            "binary" => {
                return self
                    .unpacked(Source::Base64(&squeezed(&element.text), Vec::new()), (size, number, wanted));
            }
            "appended" => self.appended(element)?,
            other => return Err(ArrayError::Format(other.into())),
        };
        self.unpacked(source, (size, number, wanted))
    }

    fn appended(&self, element: &Element) -> Result<Source<'_>, ArrayError> {
        let offset = element.attribute("offset").unwrap_or_default();
        let rest = offset.trim().parse().ok().and_then(|at: usize| self.document.appended.get(at..));
        let rest = rest.ok_or_else(|| ArrayError::Offset(offset.into()))?;
        Ok(if self.document.in_base64 { Source::Base64(rest, Vec::new()) } else { Source::Raw(rest) })
    }

    /// Refuses numbers that take far more memory than their packed form makes likely, before they take it.
    fn admit(&self, count: usize, packed: usize) -> Result<(), ArrayError> {
        let needed = count.saturating_mul(size_of::<f64>());
        let beyond = needed.saturating_sub(packed.saturating_mul(RATIO));
        let Some(left) = self.spare.get().checked_sub(beyond) else {
            return Err(ArrayError::Announced { count, packed, ratio: RATIO });
        };
        self.spare.set(left);
        Ok(())
    }

    fn unpacked(&self, source: Source<'_>, (size, number, wanted): Layout) -> Result<Vec<f64>, ArrayError> {
        let bytes = self.storage.bytes(source, wanted, |packed| self.admit(wanted / size, packed))?;
        let little = |chunk: &[u8]| {
            let mut padded = [0; 8];
            padded[..chunk.len()].copy_from_slice(chunk);
            if !self.storage.little {
                padded[..chunk.len()].reverse();
            }
            number(padded)
        };
        Ok(bytes.chunks(size).map(little).collect())
    }
}

/// Size of a number, its value from its bytes, the least significant first, and the bytes of all numbers.
type Layout = (usize, Number, usize);

/// Value of a number from its bytes, the least significant first, filled up with zeros.
type Number = fn([u8; 8]) -> f64;

/// Size of a number of a type, and its value from its bytes, the least significant first.
fn number(kind: &str) -> Option<(usize, Number)> {
    Some(match kind {
        "Int8" => (1, |b| f64::from(b[0] as i8)),
        "UInt8" => (1, |b| f64::from(b[0])),
        "Int16" => (2, |b| f64::from(i16::from_le_bytes([b[0], b[1]]))),
        "UInt16" => (2, |b| f64::from(u16::from_le_bytes([b[0], b[1]]))),
        "Int32" => (4, |b| f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
        "UInt32" => (4, |b| f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
        "Float32" => (4, |b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
        "Int64" => (8, |b| i64::from_le_bytes(b) as f64),
        "UInt64" => (8, |b| u64::from_le_bytes(b) as f64),
        "Float64" => (8, f64::from_le_bytes),
        _ => return None,
    })
}

fn ascii(text: &str) -> Result<Vec<f64>, ArrayError> {
    let number = |word: &str| word.parse::<f64>().map_err(|_| ArrayError::Word(word.into()));
    text.split_ascii_whitespace().map(number).collect()
}

/// Text without white space.
fn squeezed(text: &str) -> Vec<u8> {
    text.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect()
}
