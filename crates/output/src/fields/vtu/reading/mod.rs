//! Reads points, cells and arrays of unstructured grids of VTK in XML (`.vtu`).
//!
//! Arrays are in the file as text, in base64, or raw at its end, plain or compressed by zlib. The layout is that of VTK's
//! `vtkXMLDataParser`.

mod array;
mod binary;
mod error;
mod grid;
mod pieces;
mod xml;

pub use error::{ArrayError, VtuError};
pub use grid::{Grid, NamedArray};

/// Grid of a file, with the arrays of this name alone.
///
/// # Errors
/// [`VtuError`] with the part of the file.
pub fn read(bytes: &[u8], name: &str) -> Result<Grid, VtuError> {
    pieces::grid(&xml::document(bytes)?, name)
}

/// True if a file begins as XML.
#[must_use]
pub fn is_xml(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.trim_ascii_start().starts_with(b"<?xml") || bytes.trim_ascii_start().starts_with(b"<VTKFile")
}
