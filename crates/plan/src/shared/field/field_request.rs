//! Requests of a scene for the file of a field, and checks of what the file gives.

use super::axes::NAMES;
use super::cells::Cells;
use super::lattice::Lattice;
use super::samples::Samples;
use crate::reading::columns::Wrong;
use crate::reading::scene::model::{Field as Given, FieldInterpolation};
use crate::reading::scene::units::Dimension;

/// Bound of the values of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Bound {
    Positive,
    NotNegative,
    /// Of this sign, which is that of `rate`.
    Signed(f64),
    /// Of any sign.
    Free,
}

/// A parameter that a file gives.
pub(crate) struct Parameter {
    pub key: &'static str,
    /// Dimension; none of a number.
    pub dimension: Option<Dimension>,
    pub bound: Bound,
}

/// Values at positions.
pub(super) enum Source {
    Samples(Samples),
    Lattice(Lattice),
    Cells(Cells),
}

/// Name and units that a scene gives for a field.
pub(super) struct FieldRequest<'a> {
    /// Name of the column, variable or array.
    pub name: &'a str,
    pub parameter: &'a Parameter,
    pub unit: Option<&'a str>,
    pub coordinate_unit: Option<&'a str>,
    pub interpolation: Option<FieldInterpolation>,
    pub given: &'a Given,
}

/// Start of the names of lists that hold decimal logarithms of values in SI, such as this program writes.
const LOGARITHM: &str = "log10_";

impl FieldRequest<'_> {
    /// True if the values are decimal logarithms.
    fn logarithmic(&self) -> bool {
        self.name.starts_with(LOGARITHM)
    }

    /// Dimension of the values in the file; logarithms are numbers.
    pub fn dimension(&self) -> Option<Dimension> {
        self.parameter.dimension.filter(|_| !self.logarithmic())
    }

    /// Values of which the file has these: logarithms are of magnitudes, which take the sign of the parameter.
    pub fn plain(&self, mut values: Vec<f64>) -> Vec<f64> {
        if self.logarithmic() {
            let sign = if let Bound::Signed(sign) = self.parameter.bound { sign } else { 1.0 };
            values.iter_mut().for_each(|v| *v = sign * 10_f64.powf(*v));
        }
        values
    }
}

/// Refuses values out of bounds. `row` names the place of a value, `what` its list.
pub(super) fn checked(
    values: &[f64],
    asked: &FieldRequest<'_>,
    what: &str,
    row: &dyn Fn(usize) -> String,
) -> Result<(), Wrong> {
    let (name, parameter) = (asked.name, asked.parameter);
    let (bad, must): (&dyn Fn(f64) -> bool, &str) = match parameter.bound {
        Bound::Positive => (&|v| v <= 0.0, "be positive"),
        Bound::NotNegative => (&|v| v < 0.0, "not be negative"),
        Bound::Signed(sign) => (&move |v| v * sign <= 0.0, "have the sign of `rate`"),
        Bound::Free => (&|_| false, ""),
    };
    if let Some(k) = values.iter().position(|v| v.is_infinite() || bad(*v)) {
        let must = if values[k].is_infinite() { "be finite" } else { must };
        return Err(Wrong::new(
            format!("{}: `{name}` must {must}, found {:?}", row(k), values[k]),
            "check its sign and its unit",
        ));
    }
    let mut there = values.iter().filter(|v| !v.is_nan());
    if there.next().is_none() {
        return Err(Wrong::new(format!("all values of its {what} `{name}` are NaN"), "another file"));
    }
    Ok(())
}

/// Coordinates by their names in the scene and in the file: those that the scene names, or all that the file has.
pub(super) fn coordinates_of<'a>(
    asked: &'a FieldRequest<'_>,
    names: &[&'a str],
) -> Vec<(&'static str, &'a str)> {
    let mut named: Vec<(&'static str, &str)> =
        asked.given.coordinates.named().map(|(key, name)| (key, name.get_ref().as_str())).collect();
    if named.is_empty() {
        named = NAMES.into_iter().filter(|name| names.contains(name)).map(|n| (n, n)).collect();
    }
    named
}
