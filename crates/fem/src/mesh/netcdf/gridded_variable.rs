//! Variables over one or two coordinates.

use super::{File, NetcdfError, Variable};

/// Coordinate of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Name of its dimension and variable.
    pub name: String,
    /// Attribute `units`; empty without one.
    pub unit: String,
    /// Values in the unit of the file.
    pub values: Vec<f64>,
}

/// Variable over one or two coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct GriddedVariable {
    /// Attribute `units`; empty without one.
    pub unit: String,
    /// Coordinates, the last of which varies fastest.
    pub coordinates: Vec<Coordinate>,
    /// Values in the unit of the file; NaN where there is none.
    pub values: Vec<f64>,
}

/// Variable of this name over one or two coordinates. Others of length one may come before them.
///
/// # Errors
/// [`NetcdfError`] with the name of the variable.
pub fn variable(bytes: &[u8], name: &str) -> Result<GriddedVariable, NetcdfError> {
    let file = File::read(bytes)?;
    let found = file.variables.iter().find(|v| v.name == name);
    let variable = found.ok_or_else(|| NetcdfError::NoVariable {
        name: name.into(),
        names: file.variables.iter().map(|v| v.name.clone()).collect(),
    })?;
    let dimensions = file.spanned(variable)?;
    let coordinates = dimensions.iter().map(|&d| {
        let (name, values) = (file.dimensions[d].name.clone(), file.coordinate(variable, d)?);
        let unit = file.variable_of(d).map_or("", |v| v.text("units")).to_string();
        Ok(Coordinate { name, unit, values })
    });
    let coordinates = coordinates.collect::<Result<_, _>>()?;
    Ok(GriddedVariable {
        unit: variable.text("units").to_string(),
        coordinates,
        values: file.values(variable)?,
    })
}

impl File<'_> {
    /// The last one or two dimensions of a variable, before which others have length one.
    fn spanned<'v>(&self, variable: &'v Variable) -> Result<&'v [usize], NetcdfError> {
        let all = &variable.dimensions;
        let skipped = all.iter().take_while(|d| self.dimensions[**d].length == 1).count();
        let rest = &all[skipped..];
        if matches!(rest.len(), 1 | 2) {
            return Ok(rest);
        }
        Err(NetcdfError::Dimensions { variable: variable.name.clone(), count: rest.len() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::file;
    use super::*;

    #[test]
    fn a_variable_has_its_coordinates_in_the_order_of_the_file() {
        let grid = variable(&file(), "z").unwrap();
        let names: Vec<&str> = grid.coordinates.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["lat", "lon"]);
        assert_eq!(grid.coordinates[1].values, [134.0, 135.0, 136.0]);
        assert_eq!(grid.values[5], 31.0);
        assert!(grid.values[4].is_nan());
    }

    #[test]
    fn a_variable_that_is_missing_is_refused_with_the_others() {
        let error = variable(&file(), "a").unwrap_err();
        assert_eq!(error.to_string(), "it has no variable `a`");
        assert!(matches!(error, NetcdfError::NoVariable { names, .. } if names.len() == 3));
    }

    #[test]
    fn a_file_that_ends_early_or_has_a_changed_byte_never_panics() {
        let whole = file();
        for length in 0..whole.len() {
            assert!(variable(&whole[..length], "z").is_err(), "{length}");
        }
        for at in 0..whole.len() {
            for value in [0, 1, 7, 127, 255] {
                let mut bytes = whole.clone();
                bytes[at] = value;
                let _ = variable(&bytes, "z");
            }
        }
    }
}
