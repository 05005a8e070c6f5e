//! Grids in the classic netCDF format (version 1, the magic number `CDF\x01`), with the conventions COARDS and CF, as GMT and GIS
//! programs read them.
//!
//! Lengths are 4-byte integers and numbers 8-byte floats, all with the most significant byte first. Names and texts are filled up
//! to multiples of four bytes.

/// A coordinate of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<'a> {
    /// Name of the variable: `"lon"`, `"lat"`, `"x"` or `"y"`.
    pub name: &'a str,
    /// Meaning.
    pub meaning: &'a str,
    /// Unit.
    pub unit: &'a str,
    /// Values, ascending.
    pub values: &'a [f64],
}

/// Values on a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<'a> {
    /// Title.
    pub title: &'a str,
    /// Coordinate along a row.
    pub x: Axis<'a>,
    /// Coordinate from row to row.
    pub y: Axis<'a>,
    /// Meaning of the values.
    pub meaning: &'a str,
    /// Unit of the values.
    pub unit: &'a str,
    /// Values, row by row; NaN where there is none. The name of the variable is `z`.
    pub values: &'a [f64],
}

/// Tags of lists of dimensions, variables and attributes.
const DIMENSIONS: u32 = 10;
const VARIABLES: u32 = 11;
const ATTRIBUTES: u32 = 12;
/// Types of values: characters and 8-byte floats.
const CHARACTERS: u32 = 2;
const DOUBLES: u32 = 6;
/// Number of records: no dimension grows.
const NO_RECORDS: u32 = 0;

/// An attribute.
enum Attribute<'a> {
    Text(&'static str, &'a str),
    Numbers(&'static str, Vec<f64>),
}

/// A variable: name, dimensions, attributes and values.
struct Variable<'a> {
    name: &'a str,
    dimensions: Vec<u32>,
    attributes: Vec<Attribute<'a>>,
    values: &'a [f64],
}

impl Grid<'_> {
    /// The file.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        let variables = [coordinate_variable(&self.x, 0), coordinate_variable(&self.y, 1), self.values()];
        let size = |v: &Variable<'_>| size_of_val(v.values);
        // The length of the header does not depend on the offsets in it.
        let mut begin = self.header(&variables, &[0; 3]).len();
        let begins = variables.each_ref().map(|v| {
            let here = begin;
            begin += size(v);
            here
        });
        let mut bytes = self.header(&variables, &begins);
        for value in variables.iter().flat_map(|v| v.values) {
            bytes.extend(value.to_be_bytes());
        }
        bytes
    }

    fn values(&self) -> Variable<'_> {
        let attributes = vec![
            Attribute::Text("long_name", self.meaning),
            Attribute::Text("units", self.unit),
            Attribute::Numbers("_FillValue", vec![f64::NAN]),
            Attribute::Numbers("actual_range", range(self.values)),
        ];
        Variable { name: "z", dimensions: vec![1, 0], attributes, values: self.values }
    }

    fn header(&self, variables: &[Variable<'_>; 3], begins: &[usize; 3]) -> Vec<u8> {
        let mut bytes = b"CDF\x01".to_vec();
        number(&mut bytes, NO_RECORDS);
        number(&mut bytes, DIMENSIONS);
        number(&mut bytes, 2);
        for axis in [&self.x, &self.y] {
            text(&mut bytes, axis.name);
            number(&mut bytes, axis.values.len() as u32);
        }
        attributes(
            &mut bytes,
            &[Attribute::Text("Conventions", "CF-1.7"), Attribute::Text("title", self.title)],
        );
        number(&mut bytes, VARIABLES);
        number(&mut bytes, variables.len() as u32);
        for (variable, begin) in variables.iter().zip(begins) {
            text(&mut bytes, variable.name);
            number(&mut bytes, variable.dimensions.len() as u32);
            variable.dimensions.iter().for_each(|dimension| number(&mut bytes, *dimension));
            attributes(&mut bytes, &variable.attributes);
            number(&mut bytes, DOUBLES);
            number(&mut bytes, size_of_val(variable.values) as u32);
            number(&mut bytes, *begin as u32);
        }
        bytes
    }
}

fn coordinate_variable<'a>(axis: &Axis<'a>, dimension: u32) -> Variable<'a> {
    let attributes = vec![
        Attribute::Text("long_name", axis.meaning),
        Attribute::Text("units", axis.unit),
        Attribute::Numbers("actual_range", range(axis.values)),
    ];
    Variable { name: axis.name, dimensions: vec![dimension], attributes, values: axis.values }
}

/// Least and largest value that is a number.
fn range(values: &[f64]) -> Vec<f64> {
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let ends = finite().reduce(f64::min).zip(finite().reduce(f64::max));
    ends.map_or(vec![f64::NAN; 2], |(least, most)| vec![least, most])
}

fn number(bytes: &mut Vec<u8>, value: u32) {
    bytes.extend(value.to_be_bytes());
}

fn text(bytes: &mut Vec<u8>, text: &str) {
    number(bytes, text.len() as u32);
    bytes.extend(text.as_bytes());
    bytes.resize(bytes.len().next_multiple_of(4), 0);
}

fn attributes(bytes: &mut Vec<u8>, all: &[Attribute<'_>]) {
    number(bytes, ATTRIBUTES);
    number(bytes, all.len() as u32);
    for attribute in all {
        match attribute {
            Attribute::Text(name, value) => {
                text(bytes, name);
                number(bytes, CHARACTERS);
                text(bytes, value);
            }
            Attribute::Numbers(name, values) => {
                text(bytes, name);
                number(bytes, DOUBLES);
                number(bytes, values.len() as u32);
                values.iter().for_each(|value| bytes.extend(value.to_be_bytes()));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_lead_to_the_values() {
        let axis = |name, values| Axis { name, meaning: "position", unit: "m", values };
        let values = [1.0, f64::NAN, 3.0, -4.0, 5.0, 6.5];
        let grid = Grid {
            title: "odd",
            x: axis("x", &[0.0, 1.0, 2.0]),
            y: axis("y", &[7.0, 8.0]),
            meaning: "height",
            unit: "m",
            values: &values,
        };
        let bytes = grid.bytes();
        assert_eq!(&bytes[..4], b"CDF\x01");
        let of = |at: usize| f64::from_be_bytes(bytes[at..at + 8].try_into().unwrap());
        let first = bytes.len() - 8 * values.len();
        assert_eq!((of(first), of(first + 24), of(first - 16)), (1.0, -4.0, 7.0));
        // The last number of the header is the offset of the last variable.
        let header = first - 8 * 5;
        let offset = u32::from_be_bytes(bytes[header - 4..header].try_into().unwrap());
        assert_eq!(offset as usize, first);
        assert_eq!(range(&values), [-4.0, 6.5]);
        assert!(range(&[f64::NAN])[0].is_nan());
    }
}
