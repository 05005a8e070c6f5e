//! Reads depths on a grid from netCDF files in the classic format (versions 1 and 2) and of version 4, with the conventions COARDS
//! and CF.
//!
//! The layout is that of the specification of the classic format: a header with lists of dimensions, attributes and variables, then
//! the values of each variable at its offset, with the most significant byte first.

pub mod gridded_variable;
mod hdf5;

pub use hdf5::Hdf5Error;

use netcdf_reader::NcFile;
use thiserror::Error;

/// Problem of a netCDF file.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NetcdfError {
    /// A file of the version 4, which is HDF5, that cannot be read.
    #[error("it is netCDF-4 (HDF5), and damaged or of a kind that is not read: {reason}")]
    Hdf5 {
        /// Reason.
        reason: Hdf5Error,
    },
    /// A version of the classic format that is not read.
    #[error("it has version {version} of the classic netCDF format, and versions 1 and 2 are read")]
    Version {
        /// The version.
        version: u8,
    },
    /// The file is shorter than its header says.
    #[error("it ends after {bytes} bytes, within {part}")]
    Ends {
        /// Size of the file.
        bytes: usize,
        /// The part that is missing.
        part: String,
    },
    /// A part of the header that is not what the format requires.
    #[error("its header is damaged at byte {byte}, in {part}")]
    Damaged {
        /// Position in the file.
        byte: usize,
        /// Part of the header.
        part: String,
    },
    /// No variable of a name.
    #[error("it has no variable `{name}`")]
    NoVariable {
        /// The name.
        name: String,
        /// Names of all variables.
        names: Vec<String>,
    },
    /// A variable over no coordinates, or over three or more.
    #[error("variable `{variable}` is over {count} dimensions, and one or two are read")]
    Dimensions {
        /// The variable.
        variable: String,
        /// Number of its dimensions longer than one.
        count: usize,
    },
    /// No variable on a grid.
    #[error("it has no variable over two dimensions; its variables are {names}")]
    NoGrid {
        /// Names of all variables.
        names: String,
    },
    /// Several variables on a grid.
    #[error("it has several variables over two dimensions, {names}, and none of them is `z` or `depth`")]
    Several {
        /// Their names.
        names: String,
    },
    /// A dimension without coordinates.
    #[error("dimension `{dimension}` of variable `{variable}` has no coordinate variable of its name")]
    NoCoordinate {
        /// The variable.
        variable: String,
        /// The dimension.
        dimension: String,
    },
    /// A dimension that grows.
    #[error("variable `{variable}` has the dimension `{dimension}` that grows by records")]
    Grows {
        /// The variable.
        variable: String,
        /// The dimension.
        dimension: String,
    },
    /// Values that are not numbers.
    #[error("variable `{variable}` holds characters, and numbers are needed")]
    Characters {
        /// The variable.
        variable: String,
    },
    /// A coordinate that is not a number.
    #[error(
        "variable `{variable}` has the value {value} at position {position}, where a coordinate is needed"
    )]
    Coordinate {
        /// The variable.
        variable: String,
        /// Number of the value, from 1.
        position: usize,
        /// The value.
        value: String,
    },
}

/// True if a file is netCDF, in the classic format or in version 4.
#[must_use]
pub fn is_netcdf(bytes: &[u8]) -> bool {
    bytes.starts_with(CLASSIC) || bytes.starts_with(HDF5)
}

/// Rows of longitude, latitude and depth in the unit of the file, row by row along longitude; NaN where a grid has no depth.
///
/// # Errors
/// [`NetcdfError`] with the name of the variable.
pub fn rows(bytes: &[u8]) -> Result<Vec<[f64; 3]>, NetcdfError> {
    let file = File::read(bytes)?;
    let (depth, [first, second]) = file.grid()?;
    let values = file.values(depth)?;
    let [outer, inner] = [file.coordinate(depth, first)?, file.coordinate(depth, second)?];
    let longitude_first = file.is_longitude(first) && !file.is_longitude(second);
    let at = |o: usize, i: usize| values[o * inner.len() + i];
    let mut rows = Vec::with_capacity(values.len());
    if longitude_first {
        for (i, latitude) in inner.iter().enumerate() {
            rows.extend(outer.iter().enumerate().map(|(o, longitude)| [*longitude, *latitude, at(o, i)]));
        }
    } else {
        for (o, latitude) in outer.iter().enumerate() {
            rows.extend(inner.iter().enumerate().map(|(i, longitude)| [*longitude, *latitude, at(o, i)]));
        }
    }
    Ok(rows)
}

const CLASSIC: &[u8] = b"CDF";
const HDF5: &[u8] = b"\x89HDF";
/// Tags of lists.
const DIMENSIONS: u32 = 10;
const VARIABLES: u32 = 11;
const ATTRIBUTES: u32 = 12;
/// Type of characters.
const CHARACTERS: u32 = 2;

/// Size of a value by the number of its type \[bytes\].
fn size_of_type(kind: u32) -> Option<usize> {
    [1, 1, 2, 4, 4, 8].get((kind as usize).checked_sub(1)?).copied()
}

/// Value of a type from its bytes.
fn number(kind: u32, bytes: &[u8]) -> f64 {
    match (kind, bytes) {
        (1, &[a]) => f64::from(i8::from_be_bytes([a])),
        (3, &[a, b]) => f64::from(i16::from_be_bytes([a, b])),
        (4, &[a, b, c, d]) => f64::from(i32::from_be_bytes([a, b, c, d])),
        (5, &[a, b, c, d]) => f64::from(f32::from_be_bytes([a, b, c, d])),
        (6, &[a, b, c, d, e, f, g, h]) => f64::from_be_bytes([a, b, c, d, e, f, g, h]),
        _ => f64::NAN,
    }
}

struct Dimension {
    name: String,
    /// Length; 0 of one that grows.
    length: usize,
}

struct Attribute {
    name: String,
    text: String,
    numbers: Vec<f64>,
}

struct Variable {
    name: String,
    dimensions: Vec<usize>,
    attributes: Vec<Attribute>,
    kind: u32,
    begin: usize,
}

impl Variable {
    fn number(&self, name: &str) -> Option<f64> {
        self.attributes.iter().find(|a| a.name == name)?.numbers.first().copied()
    }

    fn text(&self, name: &str) -> &str {
        self.attributes.iter().find(|a| a.name == name).map_or("", |a| a.text.as_str())
    }
}

/// Reader of the header.
struct Header<'a> {
    bytes: &'a [u8],
    at: usize,
    /// True if offsets have eight bytes.
    wide: bool,
}

impl<'a> Header<'a> {
    fn take(&mut self, count: usize, part: &str) -> Result<&'a [u8], NetcdfError> {
        let end = self.at.checked_add(count).filter(|end| *end <= self.bytes.len());
        let Some(end) = end else {
            return Err(NetcdfError::Ends { bytes: self.bytes.len(), part: part.into() });
        };
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    fn number(&mut self, part: &str) -> Result<u32, NetcdfError> {
        let taken = self.take(4, part)?;
        Ok(taken.iter().fold(0, |sum, byte| sum << 8 | u32::from(*byte)))
    }

    fn offset(&mut self, part: &str) -> Result<usize, NetcdfError> {
        let high = if self.wide { u64::from(self.number(part)?) } else { 0 };
        let offset = high << 32 | u64::from(self.number(part)?);
        usize::try_from(offset).map_err(|_| self.damaged(part))
    }

    fn damaged(&self, part: &str) -> NetcdfError {
        NetcdfError::Damaged { byte: self.at, part: part.into() }
    }

    /// Bytes that are filled up to a multiple of four.
    fn filled(&mut self, count: usize, part: &str) -> Result<&'a [u8], NetcdfError> {
        let taken = self.take(count, part)?;
        self.take(count.next_multiple_of(4) - count, part)?;
        Ok(taken)
    }

    fn name(&mut self, part: &str) -> Result<String, NetcdfError> {
        let length = self.number(part)? as usize;
        Ok(String::from_utf8_lossy(self.filled(length, part)?).into_owned())
    }

    /// Number of elements of a list with a tag.
    fn list(&mut self, tag: u32, part: &str) -> Result<usize, NetcdfError> {
        let (found, count) = (self.number(part)?, self.number(part)?);
        if found == tag || (found == 0 && count == 0) { Ok(count as usize) } else { Err(self.damaged(part)) }
    }

    fn attributes(&mut self, part: &str) -> Result<Vec<Attribute>, NetcdfError> {
        let mut all = Vec::new();
        for _ in 0..self.list(ATTRIBUTES, part)? {
            let name = self.name(part)?;
            let (kind, count) = (self.number(part)?, self.number(part)? as usize);
            let size = size_of_type(kind).ok_or_else(|| self.damaged(part))?;
            let bytes = count.checked_mul(size).ok_or_else(|| self.damaged(part))?;
            let data = self.filled(bytes, part)?;
            let text =
                if kind == CHARACTERS { String::from_utf8_lossy(data).into_owned() } else { String::new() };
            all.push(Attribute { name, text, numbers: data.chunks(size).map(|v| number(kind, v)).collect() });
        }
        Ok(all)
    }
}

/// The parts of a file that are needed.
struct File<'a> {
    bytes: &'a [u8],
    dimensions: Vec<Dimension>,
    variables: Vec<Variable>,
    /// The file of version 4 that has the values.
    hdf5: Option<NcFile>,
}

impl<'a> File<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, NetcdfError> {
        if bytes.starts_with(HDF5) {
            return Self::read_version_4(bytes).map_err(|reason| NetcdfError::Hdf5 { reason });
        }
        let mut header = Header { bytes, at: 0, wide: false };
        let magic = header.take(4, "the magic number")?;
        if !matches!(magic, [b'C', b'D', b'F', 1 | 2]) {
            return Err(NetcdfError::Version { version: magic[3] });
        }
        header.wide = magic[3] == 2;
        header.number("the number of records")?;
        let mut dimensions = Vec::new();
        for _ in 0..header.list(DIMENSIONS, "the dimensions")? {
            let name = header.name("the dimensions")?;
            dimensions.push(Dimension { name, length: header.number("the dimensions")? as usize });
        }
        header.attributes("the attributes of the file")?;
        let mut variables = Vec::new();
        for _ in 0..header.list(VARIABLES, "the variables")? {
            variables.push(variable(&mut header, dimensions.len())?);
        }
        Ok(Self { bytes, dimensions, variables, hdf5: None })
    }

    /// The parts of a file of version 4.
    fn read_version_4(bytes: &'a [u8]) -> Result<Self, Hdf5Error> {
        let file = hdf5::open(bytes)?;
        let (dimensions, variables) = hdf5::parts(&file)?;
        let dimensions = dimensions.into_iter().map(|(name, length)| Dimension { name, length }).collect();
        let attribute = |(name, text, numbers)| Attribute { name, text, numbers };
        let variable = |v: hdf5::Variable| Variable {
            name: v.name,
            dimensions: v.dimensions,
            attributes: v.attributes.into_iter().map(attribute).collect(),
            // Types of numbers are those of the library.
            kind: if v.text { CHARACTERS } else { 0 },
            begin: 0,
        };
        let variables = variables.into_iter().map(variable).collect();
        Ok(Self { bytes, dimensions, variables, hdf5: Some(file) })
    }

    /// The variable with depths, and the dimensions of its grid. Others of length one may come before them.
    fn grid(&self) -> Result<(&Variable, [usize; 2]), NetcdfError> {
        let over = |variable: &Variable| {
            let (first, rest) = variable.dimensions.split_at(variable.dimensions.len().checked_sub(2)?);
            first.iter().all(|d| self.dimensions[*d].length == 1).then_some([rest[0], rest[1]])
        };
        let grids: Vec<_> = self.variables.iter().filter_map(|v| Some((v, over(v)?))).collect();
        let named = |name: &str| grids.iter().find(|grid| grid.0.name.eq_ignore_ascii_case(name)).copied();
        let names = |all: &mut dyn Iterator<Item = &Variable>| {
            all.map(|v| format!("`{}`", v.name)).collect::<Vec<_>>().join(", ")
        };
        match grids[..] {
            [one] => Ok(one),
            [] => Err(NetcdfError::NoGrid { names: names(&mut self.variables.iter()) }),
            _ => named("z")
                .or_else(|| named("depth"))
                .ok_or_else(|| NetcdfError::Several { names: names(&mut grids.iter().map(|grid| grid.0)) }),
        }
    }

    /// Values of a variable; NaN where it has none.
    fn values(&self, variable: &Variable) -> Result<Vec<f64>, NetcdfError> {
        if variable.kind == CHARACTERS {
            return Err(NetcdfError::Characters { variable: variable.name.clone() });
        }
        let ends = || NetcdfError::Ends {
            bytes: self.bytes.len(),
            part: format!("the values of variable `{}`", variable.name),
        };
        let mut count = 1_usize;
        for d in &variable.dimensions {
            let Dimension { name, length } = &self.dimensions[*d];
            if *length == 0 {
                let (variable, dimension) = (variable.name.clone(), name.clone());
                return Err(NetcdfError::Grows { variable, dimension });
            }
            count = count.checked_mul(*length).ok_or_else(ends)?;
        }
        if let Some(file) = &self.hdf5 {
            let values = hdf5::values(file, &variable.name, count);
            let values = values.map_err(|reason| NetcdfError::Hdf5 { reason })?;
            return Ok(meant(variable, values.into_iter()));
        }
        let size = size_of_type(variable.kind).unwrap_or(1);
        let end = count.checked_mul(size).and_then(|bytes| bytes.checked_add(variable.begin));
        let data = end.and_then(|end| self.bytes.get(variable.begin..end)).ok_or_else(ends)?;
        Ok(meant(variable, data.chunks(size).map(|bytes| number(variable.kind, bytes))))
    }

    fn variable_of(&self, dimension: usize) -> Option<&Variable> {
        let name = &self.dimensions[dimension].name;
        self.variables.iter().find(|v| v.name == *name && v.dimensions == [dimension])
    }

    /// Values of the coordinate variable of a dimension.
    fn coordinate(&self, of: &Variable, dimension: usize) -> Result<Vec<f64>, NetcdfError> {
        let variable = self.variable_of(dimension).ok_or_else(|| NetcdfError::NoCoordinate {
            variable: of.name.clone(),
            dimension: self.dimensions[dimension].name.clone(),
        })?;
        let values = self.values(variable)?;
        match values.iter().position(|value| !value.is_finite()) {
            Some(k) => Err(NetcdfError::Coordinate {
                variable: variable.name.clone(),
                position: k + 1,
                value: values[k].to_string(),
            }),
            None => Ok(values),
        }
    }

    /// True if the coordinate of a dimension is a longitude by its name or its unit.
    fn is_longitude(&self, dimension: usize) -> bool {
        let name = self.dimensions[dimension].name.to_ascii_lowercase();
        let unit = self.variable_of(dimension).map_or("", |v| v.text("units"));
        name.starts_with("lon")
            || name == "x"
            || unit.starts_with("degrees_east")
            || unit.starts_with("degree_east")
    }
}

/// Values that a file means by its numbers; NaN where it has none.
fn meant(variable: &Variable, raw: impl Iterator<Item = f64>) -> Vec<f64> {
    let missing = ["_FillValue", "missing_value"].map(|name| variable.number(name));
    let scale = variable.number("scale_factor").unwrap_or(1.0);
    let offset = variable.number("add_offset").unwrap_or(0.0);
    raw.map(|raw| if missing.contains(&Some(raw)) { f64::NAN } else { raw * scale + offset }).collect()
}

fn variable(header: &mut Header<'_>, dimensions: usize) -> Result<Variable, NetcdfError> {
    let name = header.name("the variables")?;
    let part = format!("variable `{name}`");
    let mut own = Vec::new();
    for _ in 0..header.number(&part)? {
        let dimension = header.number(&part)? as usize;
        if dimension >= dimensions {
            return Err(header.damaged(&part));
        }
        own.push(dimension);
    }
    let attributes = header.attributes(&part)?;
    let kind = header.number(&part)?;
    size_of_type(kind).ok_or_else(|| header.damaged(&part))?;
    header.number(&part)?;
    let begin = header.offset(&part)?;
    Ok(Variable { name, dimensions: own, attributes, kind, begin })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part of a header: numbers and names in turn.
    fn words(parts: &[Result<u32, &str>]) -> Vec<u8> {
        let mut bytes = Vec::new();
        for part in parts {
            match part {
                Ok(number) => bytes.extend(number.to_be_bytes()),
                Err(name) => {
                    bytes.extend((name.len() as u32).to_be_bytes());
                    bytes.extend(name.as_bytes());
                    bytes.resize(bytes.len().next_multiple_of(4), 0);
                }
            }
        }
        bytes
    }

    /// A grid of two latitudes and three longitudes, whose depths are scaled 16-bit integers.
    pub(super) fn file() -> Vec<u8> {
        let mut bytes = b"CDF\x01".to_vec();
        let none = [Ok(0), Ok(0)];
        bytes.extend(words(&[Ok(0), Ok(10), Ok(2), Err("lat"), Ok(2), Err("lon"), Ok(3)]));
        bytes.extend(words(&none));
        bytes.extend(words(&[Ok(11), Ok(3)]));
        let begin = 4 + 36 + 8 + 8 + 36 + 36 + 124;
        for (name, dimension, length, offset) in [("lat", 0, 8, 0), ("lon", 1, 12, 8)] {
            bytes.extend(words(&[Err(name), Ok(1), Ok(dimension)]));
            bytes.extend(words(&none));
            bytes.extend(words(&[Ok(5), Ok(length), Ok(begin + offset)]));
        }
        bytes.extend(words(&[Err("z"), Ok(2), Ok(0), Ok(1), Ok(12), Ok(3)]));
        bytes.extend(words(&[Err("scale_factor"), Ok(5), Ok(1), Ok(0.5_f32.to_bits())]));
        bytes.extend(words(&[Err("add_offset"), Ok(5), Ok(1), Ok(1.0_f32.to_bits())]));
        bytes.extend(words(&[Err("_FillValue"), Ok(3), Ok(1), Ok(0xFFFF_0000)]));
        bytes.extend(words(&[Ok(3), Ok(12), Ok(begin + 20)]));
        assert_eq!(bytes.len(), begin as usize);
        [33.0_f32, 34.0, 134.0, 135.0, 136.0].iter().for_each(|v| bytes.extend(v.to_be_bytes()));
        [10_i16, 20, 30, 40, -1, 60].iter().for_each(|v| bytes.extend(v.to_be_bytes()));
        bytes
    }

    #[test]
    fn scaled_integers_with_missing_values_are_read_in_order() {
        let rows = rows(&file()).unwrap();
        assert_eq!(rows.len(), 6);
        assert_eq!(rows[0], [134.0, 33.0, 6.0]);
        assert_eq!(rows[2], [136.0, 33.0, 16.0]);
        assert!(rows[4][2].is_nan());
        assert_eq!(rows[5], [136.0, 34.0, 31.0]);
    }

    #[test]
    fn a_file_that_ends_early_or_has_a_changed_byte_never_panics() {
        let whole = file();
        for length in 0..whole.len() {
            assert!(rows(&whole[..length]).is_err(), "{length}");
        }
        let error = rows(&whole[..whole.len() - 1]).unwrap_err().to_string();
        assert_eq!(error, "it ends after 283 bytes, within the values of variable `z`");
        for at in 0..whole.len() {
            for value in [0, 1, 7, 127, 255] {
                let mut bytes = whole.clone();
                bytes[at] = value;
                let _ = rows(&bytes);
            }
        }
    }

    #[test]
    fn files_of_other_versions_are_named() {
        assert!(matches!(rows(b"\x89HDF\r\n\x1a\n"), Err(NetcdfError::Hdf5 { .. })));
        assert_eq!(rows(b"CDF\x05\0\0\0\0"), Err(NetcdfError::Version { version: 5 }));
        assert!(is_netcdf(b"CDF\x01") && is_netcdf(b"\x89HDF") && !is_netcdf(b"135.0 33.0 5.0"));
    }

    #[test]
    fn a_file_whose_dimensions_lie_does_not_exhaust_the_memory() {
        let mut bytes = file();
        // Lengths of both dimensions.
        for at in [24, 36] {
            bytes[at..at + 4].copy_from_slice(&u32::MAX.to_be_bytes());
        }
        assert!(matches!(rows(&bytes), Err(NetcdfError::Ends { .. })));
    }
}
