//! Columns of tables: name, unit, sign and meaning. Headers, the text beside a run and the pages of the book follow from them.

use super::csv_rows::Rows;
use super::describe::Row;

/// Direction of positive values, in the words of the page "Signs in files".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Along positive slip; a magnitude where slip has no direction.
    Slip,
    /// As slip; with vector slip the component along the rake.
    Along,
    /// Motion of one side relative to the other, or its traction, along the axis in the name.
    Vector,
    /// Along direction 2 or 3 of the head.
    Component,
    /// Never negative.
    Size,
    /// Decadic logarithm of a magnitude.
    Log,
    /// Positive where the sides are pressed together.
    Compression,
    /// Positive where the sides are apart.
    Apart,
    /// Positive in tension.
    Tension,
    /// Along the axis in the name.
    Axis,
    /// Positive along the rake of a plane, or where it brings the plane closer to failure.
    Driving,
    /// Positive where the traction that drove the slip decreased.
    Fall,
    /// Without a direction.
    None,
}

impl Sign {
    /// Word of the page.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Slip => "slip",
            Self::Along => "along",
            Self::Vector => "vector",
            Self::Component => "component",
            Self::Size => "size",
            Self::Log => "log",
            Self::Compression => "compression",
            Self::Apart => "apart",
            Self::Tension => "tension",
            Self::Axis => "axis",
            Self::Driving => "driving",
            Self::Fall => "fall",
            Self::None => "none",
        }
    }
}

/// A column of a table, or a number of columns that differ by the place they are of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name; of columns headed by places, what each of them is of.
    pub name: String,
    /// Unit; empty without one.
    pub unit: &'static str,
    /// Direction of positive values.
    pub sign: Sign,
    /// Meaning; empty if the name says it.
    pub meaning: &'static str,
    /// Fault or other part of the scene that the column is of; the name in headers says it.
    pub part: Option<String>,
    /// Places that head columns: they follow the name and the unit, or stand alone for columns that have no name of their own.
    heads: Heads,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Heads {
    Name,
    After(String),
    Alone(Vec<String>),
}

impl Column {
    /// A column.
    #[must_use]
    pub fn new(name: impl Into<String>, unit: &'static str, sign: Sign, meaning: &'static str) -> Self {
        Self { name: name.into(), unit, sign, meaning, part: None, heads: Heads::Name }
    }

    /// Columns that are headed by places alone, and their `name` where they are described.
    #[must_use]
    pub fn each(
        name: &str,
        unit: &'static str,
        sign: Sign,
        meaning: &'static str,
        places: impl IntoIterator<Item = String>,
    ) -> Self {
        let heads = Heads::Alone(places.into_iter().collect());
        Self { heads, ..Self::new(name, unit, sign, meaning) }
    }

    /// The column of a fault or another part of the scene, which its name says.
    #[must_use]
    pub fn for_part(self, part: &str) -> Self {
        Self { part: Some(part.into()), ..self }
    }

    /// The column at a place, which its header says after the unit.
    #[must_use]
    pub fn at(self, place: &str) -> Self {
        Self { heads: Heads::After(format!(" at {place}")), ..self }
    }

    /// Cells of the header.
    fn cells(&self) -> Vec<String> {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" [{}]", self.unit) };
        let part = self.part.as_ref().map_or(String::new(), |part| format!(" of {part}"));
        match &self.heads {
            Heads::Name => vec![format!("{}{part}{unit}", self.name)],
            Heads::After(place) => vec![format!("{}{part}{unit}{place}", self.name)],
            Heads::Alone(places) => places.clone(),
        }
    }
}

impl Row for Column {
    const HEAD: &'static str = "column | unit | sign | meaning";
    const TOGETHER: bool = true;

    fn row(&self) -> String {
        let part = if self.part.is_some() { " of *" } else { "" };
        let name = match &self.heads {
            Heads::Alone(_) => self.name.clone(),
            _ => format!("`{}{part}`", self.name),
        };
        format!("{name} | {} | {} | {}", self.unit, self.sign.word(), self.meaning)
    }
}

/// Time of a row.
#[must_use]
pub fn time() -> Column {
    Column::new("time", "s", Sign::None, "time of the row")
}

/// Columns with the names of three axes, in this order.
#[must_use]
pub fn axes(name: &str, unit: &'static str, sign: Sign, meaning: &'static str) -> [Column; 3] {
    ["x", "y", "z"].map(|axis| Column::new(format!("{name}_{axis}"), unit, sign, meaning))
}

/// Coordinates of a position.
#[must_use]
pub fn position() -> [Column; 3] {
    ["x", "y", "z"].map(|axis| Column::new(axis, "m", Sign::None, "position"))
}

/// The six components of a stress.
#[must_use]
pub fn stress() -> [Column; 6] {
    ["xx", "yy", "zz", "xy", "yz", "zx"]
        .map(|of| Column::new(format!("stress_{of}"), "Pa", Sign::Tension, "stress"))
}

/// Header of a table, with the end of its line.
#[must_use]
pub fn header(columns: &[Column]) -> String {
    let mut rows = Rows::default();
    rows.push(columns.iter().flat_map(Column::cells));
    rows.text()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_have_names_units_parts_and_places() {
        let rate = || Column::new("rate", "m/s", Sign::Slip, "");
        let columns =
            [time(), rate().for_part("main"), rate().at("(0, 1)"), Column::new("turns", "", Sign::None, "")];
        assert_eq!(header(&columns), "time [s],rate of main [m/s],\"rate [m/s] at (0, 1)\",turns\n");
        let each = Column::each("each point", "m", Sign::Slip, "slip", ["0".into(), "2.5".into()]);
        assert_eq!(header(&[time(), each]), "time [s],0,2.5\n");
    }
}
