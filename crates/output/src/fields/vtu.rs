//! VTK XML unstructured grids: appended data, base64, zlib blocks, 64-bit headers (file format version 1.0).
//!
//! Layout of one array in the appended section, after VTK's `vtkXMLDataParser`. The header `[blocks, block size, size of the last
//! block if partial else 0, compressed size of each block]` is little-endian u64, base64-encoded separately. The zlib streams of
//! all blocks follow, concatenated and base64-encoded together. Offsets count characters after `_`.

mod cell;
pub mod reading;
mod single;

pub use cell::Cell;
pub use single::array;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::io::Write as _;

/// Uncompressed bytes per zlib block, the default of VTK.
const BLOCK: usize = 1 << 15;

/// Values of a data array.
#[derive(Clone, Copy, Debug)]
pub enum Values<'a> {
    /// `Float64`.
    F64(&'a [f64]),
    /// `Int64`.
    I64(&'a [i64]),
    /// `UInt8`.
    U8(&'a [u8]),
}

/// A named array with `names.len().max(1)` components per point or cell.
#[derive(Clone, Debug)]
pub struct Array<'a> {
    name: &'a str,
    components: usize,
    component_names: &'a [&'a str],
    encoded: EncodedArray,
}

/// An array as encoded in the file.
#[derive(Clone, Debug)]
struct EncodedArray {
    kind: &'static str,
    length: usize,
    text: String,
}

impl<'a> Array<'a> {
    /// A scalar per point or cell.
    #[must_use]
    pub fn scalar(name: &'a str, values: Values<'_>) -> Self {
        Self { name, components: 1, component_names: &[], encoded: EncodedArray::new(values) }
    }

    /// A vector of three components.
    #[must_use]
    pub fn vector(name: &'a str, values: &[[f64; 3]]) -> Self {
        Self {
            name,
            components: 3,
            component_names: &[],
            encoded: EncodedArray::new(Values::F64(values.as_flattened())),
        }
    }

    /// A symmetric tensor in VTK's order xx, yy, zz, xy, yz, xz.
    #[must_use]
    pub fn tensor(name: &'a str, values: &[[f64; 6]]) -> Self {
        let component_names = &["XX", "YY", "ZZ", "XY", "YZ", "XZ"];
        Self {
            name,
            components: 6,
            component_names,
            encoded: EncodedArray::new(Values::F64(values.as_flattened())),
        }
    }

    /// Number of tuples.
    #[must_use]
    pub fn tuples(&self) -> usize {
        self.encoded.length / self.components
    }
}

/// VTK cell type of a face with this many nodes, in the order of its element; a polygon of corners if none has as many.
#[must_use]
pub fn face_type(nodes: usize) -> u8 {
    match nodes {
        3 => 5,
        4 => 9,
        6 => 22,
        8 => 23,
        9 => 28,
        _ => 7,
    }
}

/// Part of a file that does not change with time: points and cells, encoded once.
#[derive(Clone, Debug)]
pub struct Grid {
    points: EncodedArray,
    connectivity: EncodedArray,
    offsets: EncodedArray,
    types: EncodedArray,
}

impl Grid {
    /// Encodes node positions \[m\] and cells.
    #[must_use]
    pub fn new(points: &[[f64; 3]], cells: &[Cell]) -> Self {
        let connectivity: Vec<i64> = cells.iter().flat_map(|cell| &cell.points).map(|&n| n as i64).collect();
        let mut end = 0;
        let offsets: Vec<i64> = cells
            .iter()
            .map(|cell| {
                end += cell.points.len() as i64;
                end
            })
            .collect();
        let types: Vec<u8> = cells.iter().map(|cell| cell.kind).collect();
        Self {
            points: EncodedArray::new(Values::F64(points.as_flattened())),
            connectivity: EncodedArray::new(Values::I64(&connectivity)),
            offsets: EncodedArray::new(Values::I64(&offsets)),
            types: EncodedArray::new(Values::U8(&types)),
        }
    }

    /// Number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.points.length / 3
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.types.length
    }

    /// Contents of a file with these arrays at `time` \[s\]. The lengths of the arrays must fit the grid; callers ensure this,
    /// and debug builds assert it.
    #[must_use]
    pub fn file(&self, time: f64, point_data: &[Array<'_>], cell_data: &[Array<'_>]) -> Vec<u8> {
        debug_assert!(point_data.iter().all(|array| array.tuples() == self.points()));
        debug_assert!(cell_data.iter().all(|array| array.tuples() == self.cells()));
        let mut out = Writer::default();
        out.line("<?xml version=\"1.0\"?>");
        out.line(
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\">",
        );
        out.line("<UnstructuredGrid>");
        out.line("<FieldData>");
        out.array("Name=\"TimeValue\" NumberOfTuples=\"1\"", &EncodedArray::new(Values::F64(&[time])));
        out.line("</FieldData>");
        out.line(&format!("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", self.points(), self.cells()));
        out.line("<Points>");
        out.array("Name=\"Points\" NumberOfComponents=\"3\"", &self.points);
        out.line("</Points>");
        out.line("<Cells>");
        out.array("Name=\"connectivity\"", &self.connectivity);
        out.array("Name=\"offsets\"", &self.offsets);
        out.array("Name=\"types\"", &self.types);
        out.line("</Cells>");
        out.section("PointData", point_data);
        out.section("CellData", cell_data);
        out.line("</Piece>");
        out.line("</UnstructuredGrid>");
        out.finish()
    }
}

impl EncodedArray {
    fn new(values: Values<'_>) -> Self {
        let (kind, length, text) = match values {
            Values::F64(v) => ("Float64", v.len(), encode(&little_endian(v, f64::to_le_bytes))),
            Values::I64(v) => ("Int64", v.len(), encode(&little_endian(v, i64::to_le_bytes))),
            Values::U8(v) => ("UInt8", v.len(), encode(v)),
        };
        Self { kind, length, text }
    }
}

fn little_endian<T: Copy>(values: &[T], bytes: impl Fn(T) -> [u8; 8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(8 * values.len());
    values.iter().for_each(|v| out.extend_from_slice(&bytes(*v)));
    out
}

/// Encodes header and blocks of one array as described in the module.
fn encode(bytes: &[u8]) -> String {
    let mut header = vec![bytes.len().div_ceil(BLOCK) as u64, BLOCK as u64, (bytes.len() % BLOCK) as u64];
    let mut data = Vec::with_capacity(bytes.len() / 2);
    for block in bytes.chunks(BLOCK) {
        let compressed = deflate(block);
        header.push(compressed.len() as u64);
        data.extend(compressed);
    }
    let header: Vec<u8> = header.iter().flat_map(|word| word.to_le_bytes()).collect();
    let mut text = STANDARD.encode(header);
    STANDARD.encode_string(data, &mut text);
    text
}

/// Compresses to a zlib stream at the fast level. On fields of doubles it takes a seventh of the time of the default level, for
/// files 3 % larger.
pub(crate) fn deflate(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).expect("writing to a Vec cannot fail")
}

/// Head and appended section of a file while they grow.
#[derive(Default)]
struct Writer {
    head: String,
    appended: String,
}

impl Writer {
    fn line(&mut self, text: &str) {
        self.head.push_str(text);
        self.head.push('\n');
    }

    fn array(&mut self, attributes: &str, encoded: &EncodedArray) {
        let (kind, offset) = (encoded.kind, self.appended.len());
        self.line(&format!(
            "<DataArray type=\"{kind}\" {attributes} format=\"appended\" offset=\"{offset}\"/>"
        ));
        self.appended.push_str(&encoded.text);
    }

    fn section(&mut self, tag: &str, arrays: &[Array<'_>]) {
        self.line(&format!("<{tag}>"));
        for array in arrays {
            let mut attributes = format!("Name=\"{}\"", escape(array.name));
            if array.components > 1 {
                // Writing to a String cannot fail.
                let _ = write!(attributes, " NumberOfComponents=\"{}\"", array.components);
            }
            for (i, name) in array.component_names.iter().enumerate() {
                let _ = write!(attributes, " ComponentName{i}=\"{name}\"");
            }
            self.array(&attributes, &array.encoded);
        }
        self.line(&format!("</{tag}>"));
    }

    fn finish(mut self) -> Vec<u8> {
        self.line("<AppendedData encoding=\"base64\">");
        self.head.push('_');
        self.head.push_str(&self.appended);
        self.head.push_str("\n</AppendedData>\n</VTKFile>\n");
        self.head.into_bytes()
    }
}

/// Replaces characters that XML does not admit, mostly control characters, by U+FFFD.
pub(crate) fn admitted(text: &str) -> String {
    let bad = |c: char| (c.is_control() && !matches!(c, '\t' | '\n')) || matches!(c, '\u{fffe}' | '\u{ffff}');
    text.replace(bad, "\u{fffd}")
}

/// Escapes text for the value of an XML attribute or for content.
pub(crate) fn escape(text: &str) -> String {
    admitted(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A data set of a collection.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PvdEntry {
    /// Time \[s\].
    pub time: f64,
    /// Part number: 0 for the bodies, from 1 for the interfaces.
    pub part: usize,
    /// Name of the part.
    pub name: String,
    /// Path relative to the collection.
    pub file: String,
}

/// Contents of a ParaView collection file.
#[must_use]
pub fn pvd(entries: &[PvdEntry]) -> Vec<u8> {
    let mut out = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
         <Collection>\n",
    );
    for PvdEntry { time, part, name, file } in entries {
        let (name, file) = (escape(name), escape(file));
        let _ = writeln!(
            out,
            "<DataSet timestep=\"{time}\" group=\"\" part=\"{part}\" name=\"{name}\" file=\"{file}\"/>"
        );
    }
    out.push_str("</Collection>\n</VTKFile>\n");
    out.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read as _;

    /// Reads one array of the appended section, independently of how it was written.
    fn decode(appended: &str, offset: usize) -> Vec<u8> {
        let words = |text: &str| -> Vec<u64> {
            STANDARD
                .decode(text)
                .unwrap()
                .chunks(8)
                .map(|w| u64::from_le_bytes(w.try_into().unwrap()))
                .collect()
        };
        let text = &appended[offset..];
        // Three words take exactly 32 characters.
        let blocks = words(&text[..32])[0] as usize;
        let header_length = ((3 + blocks) * 8).div_ceil(3) * 4;
        let header = words(&text[..header_length]);
        let compressed: usize = header[3..].iter().sum::<u64>() as usize;
        let data = STANDARD.decode(&text[header_length..header_length + compressed.div_ceil(3) * 4]).unwrap();
        let (mut out, mut at) = (Vec::new(), 0);
        for (i, &size) in header[3..].iter().enumerate() {
            let mut block = Vec::new();
            flate2::read::ZlibDecoder::new(&data[at..at + size as usize]).read_to_end(&mut block).unwrap();
            let partial = i + 1 == blocks && header[2] > 0;
            assert_eq!(block.len() as u64, if partial { header[2] } else { header[1] });
            out.extend(block);
            at += size as usize;
        }
        out
    }

    fn arrays(file: &[u8]) -> Vec<(String, Vec<u8>)> {
        let text = std::str::from_utf8(file).unwrap();
        let (head, rest) = text.split_once("<AppendedData encoding=\"base64\">\n_").unwrap();
        let (appended, _) = rest.split_once("\n</AppendedData>").unwrap();
        let value = |line: &str, key: &str| {
            let (_, rest) = line.split_once(&format!(" {key}=\"")).unwrap();
            rest.split_once('"').unwrap().0.to_string()
        };
        let lines = head.lines().filter(|line| line.starts_with("<DataArray"));
        lines
            .map(|line| (value(line, "Name"), decode(appended, value(line, "offset").parse().unwrap())))
            .collect()
    }

    fn f64s(bytes: &[u8]) -> Vec<f64> {
        bytes.chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
    }

    #[test]
    fn a_file_decodes_to_what_went_in() {
        // 4096 points are exactly three blocks of positions; 5000 leave a partial block.
        for n in [4096, 5000] {
            let points: Vec<[f64; 3]> = (0..n).map(|i| [i as f64, 0.5 * i as f64, -1.0]).collect();
            let cells: Vec<Cell> = (0..n - 1).map(|i| Cell::new(3, vec![i, i + 1])).collect();
            let status: Vec<u8> = (0..n).map(|i| (i % 3) as u8).collect();
            let stress = vec![[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]; n - 1];
            let grid = Grid::new(&points, &cells);
            let file = grid.file(
                9.66,
                &[Array::vector("displacement", &points), Array::scalar("status", Values::U8(&status))],
                &[Array::tensor("stress", &stress)],
            );
            let found = arrays(&file);
            let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(
                names,
                [
                    "TimeValue",
                    "Points",
                    "connectivity",
                    "offsets",
                    "types",
                    "displacement",
                    "status",
                    "stress"
                ]
            );
            assert_eq!(f64s(&found[0].1), [9.66]);
            assert_eq!(f64s(&found[1].1), points.as_flattened());
            assert_eq!(found[2].1.len(), 8 * 2 * (n - 1));
            assert_eq!(found[3].1[found[3].1.len() - 8..], (2 * (n as i64 - 1)).to_le_bytes());
            assert_eq!(found[4].1, vec![3; n - 1]);
            assert_eq!(f64s(&found[5].1), points.as_flattened());
            assert_eq!(found[6].1, status);
            assert_eq!(f64s(&found[7].1), stress.as_flattened());
        }
    }

    #[test]
    fn names_are_escaped() {
        let entry = PvdEntry { time: 0.5, part: 1, name: "a<\"b\"&c".into(), file: "fields/a.vtu".into() };
        let text = String::from_utf8(pvd(&[entry])).unwrap();
        assert!(text.contains("timestep=\"0.5\" group=\"\" part=\"1\" name=\"a&lt;&quot;b&quot;&amp;c\""));
        assert_eq!(escape("a\u{7}\u{1b}[1m\u{ffff}µ\tb"), "a\u{fffd}\u{fffd}[1m\u{fffd}µ\tb");
    }
}
