//! Files of netCDF-4, which are HDF5, by the library netcdf-reader.

use netcdf_reader::{NcAttrValue, NcFile, NcOpenOptions, NcType};

/// Most values of a variable that are read, those of a plate of 80 by 80 degrees at 0.02 degrees: small files may announce any number.
const MOST_VALUES: usize = 1 << 24;
/// Size of a value \[bytes\].
const VALUE: usize = 8;

/// Problem of a file of version 4.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Hdf5Error {
    /// A file that the library cannot read.
    #[error("{reason}")]
    Library {
        /// Reason of the library in one line.
        reason: String,
    },
    /// More values than are read.
    #[error("variable `{variable}` has {count} values, and up to {MOST_VALUES} are read")]
    Values {
        /// The variable.
        variable: String,
        /// Number of its values.
        count: usize,
    },
}

impl From<netcdf_reader::Error> for Hdf5Error {
    fn from(error: netcdf_reader::Error) -> Self {
        Self::Library { reason: error.to_string().replace('\n', " ") }
    }
}

/// Name, text and numbers of an attribute.
pub(super) type Attribute = (String, String, Vec<f64>);

/// A variable.
pub(super) struct Variable {
    pub name: String,
    /// Numbers of its dimensions.
    pub dimensions: Vec<usize>,
    pub attributes: Vec<Attribute>,
    /// True if it holds characters.
    pub text: bool,
}

/// Opens a file.
///
/// # Errors
/// [`Hdf5Error::Library`].
pub(super) fn open(bytes: &[u8]) -> Result<NcFile, Hdf5Error> {
    let options = NcOpenOptions { max_read_bytes: VALUE * MOST_VALUES, ..NcOpenOptions::default() };
    Ok(NcFile::from_bytes_with_options(bytes, options)?)
}

/// Dimensions by name with their sizes, and variables of a file.
type Parts = (Vec<(String, usize)>, Vec<Variable>);

/// Names and lengths of the dimensions, and the variables, of the first group.
///
/// # Errors
/// [`Hdf5Error::Library`].
pub(super) fn parts(file: &NcFile) -> Result<Parts, Hdf5Error> {
    let all = file.dimensions()?;
    let length = |size: u64| usize::try_from(size).unwrap_or(usize::MAX);
    let dimensions: Vec<(String, usize)> = all.iter().map(|d| (d.name.clone(), length(d.size))).collect();
    let mut variables = Vec::new();
    for variable in file.variables()? {
        let of = |name: &str| dimensions.iter().position(|own| own.0 == name);
        let own: Option<Vec<usize>> = variable.dimensions().iter().map(|d| of(&d.name)).collect();
        // A variable over dimensions that have no names is no grid.
        let Some(own) = own else { continue };
        let attributes = variable.attributes().iter().map(|a| attribute(&a.name, &a.value)).collect();
        let text = matches!(variable.dtype(), NcType::Char | NcType::String);
        variables.push(Variable { name: variable.name().into(), dimensions: own, attributes, text });
    }
    Ok((dimensions, variables))
}

fn attribute(name: &str, value: &NcAttrValue) -> Attribute {
    (name.into(), value.as_string().unwrap_or_default(), value.as_f64_vec().unwrap_or_default())
}

/// Values of a variable as the file has them, in the order in which the last dimension varies fastest.
///
/// # Errors
/// [`Hdf5Error`].
pub(super) fn values(file: &NcFile, name: &str, count: usize) -> Result<Vec<f64>, Hdf5Error> {
    if count > MOST_VALUES {
        return Err(Hdf5Error::Values { variable: name.into(), count });
    }
    Ok(file.read_variable_as_f64(name)?.iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::super::{NetcdfError, gridded_variable, rows};

    /// A synthetic plate with longitudes from 0 to 360 and depths below zero, written by the netCDF library with and without
    /// compression, and in the classic format.
    const PLAIN: &[u8] = include_bytes!("../../../tests/data/plate-nc4.grd");
    const PACKED: &[u8] = include_bytes!("../../../tests/data/plate-nc4-packed.grd");
    const CLASSIC: &[u8] = include_bytes!("../../../tests/data/plate-nc3.grd");

    #[test]
    fn netcdf_4_gives_the_rows_of_the_classic_format() {
        let expected = rows(CLASSIC).unwrap();
        let depth =
            |row: &[f64; 3]| -f64::from((5.0 + 8.0 * (row[0] - 233.0) + 0.8 * (row[1] - 40.0)) as f32);
        let near = |row: &[f64; 3]| row[2].is_nan() || (row[2] - depth(row)).abs() < 1e-5;
        assert!(expected.len() == 90 && expected.iter().all(near));
        for bytes in [PLAIN, PACKED] {
            let found = rows(bytes).unwrap();
            assert_eq!(found.len(), expected.len());
            for (a, b) in found.iter().zip(&expected) {
                assert!(a.iter().zip(b).all(|(a, b)| a == b || a.is_nan() && b.is_nan()), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_variable_of_netcdf_4_has_its_coordinates_and_units() {
        let grid = gridded_variable::variable(PLAIN, "z").unwrap();
        let found: Vec<(&str, &str)> =
            grid.coordinates.iter().map(|c| (c.name.as_str(), c.unit.as_str())).collect();
        assert_eq!(found, [("lat", "degrees_north"), ("lon", "degrees_east")]);
        let error = gridded_variable::variable(PACKED, "a").unwrap_err();
        assert!(matches!(error, NetcdfError::NoVariable { names, .. } if names.len() == 3));
    }

    /// All bytes of the head, and every seventh of the rest: the whole has been tried with all values (decisions/netcdf.md).
    #[test]
    fn netcdf_4_that_ends_early_or_has_a_changed_byte_never_panics() {
        for length in (0..PLAIN.len()).step_by(61) {
            let _ = rows(&PLAIN[..length]);
        }
        for at in (0..512).chain((512..PLAIN.len()).step_by(31)) {
            for value in [0, 255] {
                let mut bytes = PLAIN.to_vec();
                bytes[at] = value;
                let _ = rows(&bytes);
            }
        }
    }
}
