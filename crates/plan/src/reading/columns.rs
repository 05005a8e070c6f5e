//! Columns of numbers with names and units, from the text of a CSV file.

pub mod file;
pub(crate) mod unit;

pub use crate::reading::wrong::Wrong;

use asperity_scene::suggestions::suggest;
use asperity_scene::units::{self, Dimension};

/// Columns of a table. Its first line has their names, with units in brackets, such as `x [km]`.
#[derive(Debug)]
pub struct Columns {
    heads: Vec<Head>,
    /// Number of the line and cells of each row.
    rows: Vec<(u64, Vec<String>)>,
}

/// Name of a column and its unit.
#[derive(Debug)]
struct Head {
    name: String,
    unit: Option<String>,
}

/// Form of a file, for messages.
const FORM: &str = "the first line names the columns, with units in brackets, such as `x [km],y [km],a`; numbers follow, separated by commas";

impl Columns {
    /// Columns of a text.
    ///
    /// # Errors
    /// [`Wrong`] for a text without a line of names or without rows, and for rows of another length.
    pub fn parse(bytes: &[u8]) -> Result<Self, Wrong> {
        let text = std::str::from_utf8(bytes).map_err(|_| Wrong::new("it is not a text", FORM))?;
        let text = text.trim_start_matches('\u{feff}');
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .has_headers(false)
            .from_reader(text.as_bytes());
        let mut heads: Option<Vec<Head>> = None;
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| Wrong::new(uneven(&e), FORM))?;
            let line = record.position().map_or(0, csv::Position::line);
            match heads {
                None => heads = Some(named(&record)?),
                Some(_) => rows.push((line, record.iter().map(str::to_string).collect())),
            }
        }
        let heads = heads.ok_or_else(|| Wrong::new("it is empty", FORM))?;
        for (k, head) in heads.iter().enumerate() {
            if heads[..k].iter().any(|other| other.name == head.name) {
                return Err(Wrong::new(format!("it has two columns `{}`", head.name), "one of each name"));
            }
        }
        if rows.is_empty() {
            return Err(Wrong::new("it has no rows below the names of its columns", FORM));
        }
        Ok(Self { heads, rows })
    }

    /// Names of the columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.heads.iter().map(|head| head.name.as_str())
    }

    /// Line of a row in the file.
    #[must_use]
    pub fn line(&self, row: usize) -> u64 {
        self.rows[row].0
    }

    /// True if a column has a unit.
    #[must_use]
    pub fn has_unit(&self, name: &str) -> bool {
        self.heads.iter().any(|head| head.name == name && head.unit.is_some())
    }

    /// Cells of a column as texts.
    ///
    /// # Errors
    /// [`Wrong`] if there is no such column.
    pub fn texts(&self, name: &str) -> Result<Vec<String>, Wrong> {
        let column = self.find(name)?;
        Ok(self.rows.iter().map(|(_, cells)| cells[column].clone()).collect())
    }

    fn find(&self, name: &str) -> Result<usize, Wrong> {
        let found = self.heads.iter().position(|head| head.name == name);
        found.ok_or_else(|| {
            Wrong::new(format!("it has no column `{name}`"), suggest(name, "columns", self.names()))
        })
    }

    /// Numbers of a column in SI units, or without a unit if they have no dimension.
    ///
    /// # Errors
    /// [`Wrong`] if there is no such column, its unit is missing or another one, or a cell is not a finite number.
    pub fn numbers(&self, name: &str, dimension: Option<Dimension>) -> Result<Vec<f64>, Wrong> {
        self.numbers_in(name, dimension, None)
    }

    /// Numbers as [`Self::numbers`], in a stated unit where the column has none.
    ///
    /// # Errors
    /// As [`Self::numbers`], and for a stated unit other than that of the column.
    pub fn numbers_in(
        &self,
        name: &str,
        dimension: Option<Dimension>,
        stated: Option<&str>,
    ) -> Result<Vec<f64>, Wrong> {
        let column = self.find(name)?;
        let own = self.heads[column].unit.as_deref();
        let unit = unit::chosen(unit::FilePart::new("column", name), own, stated, dimension)?;
        let cell = |(line, cells): &(u64, Vec<String>)| {
            let cell = cells[column].as_str();
            let number = cell.parse::<f64>().ok().filter(|v| v.is_finite());
            let number = number.ok_or_else(|| {
                Wrong::new(
                    format!("line {line}: `{cell}` in column `{name}` is not a finite number"),
                    "numbers such as 0.015 or 1.5e-2, with a decimal point and without their unit",
                )
            })?;
            match (unit, dimension) {
                // The text with its unit is read as in a scene, to the last digit.
                (Some(unit), Some(dimension)) => units::parse(&format!("{cell} {unit}"), dimension)
                    .map_err(|why| Wrong::new(format!("line {line}: {why}"), FORM)),
                _ => Ok(number),
            }
        };
        self.rows.iter().map(cell).collect()
    }
}

/// Names and units of the columns, from the first row.
fn named(row: &csv::StringRecord) -> Result<Vec<Head>, Wrong> {
    let other = [(';', "semicolons"), ('\t', "tabs")];
    if let (1, Some((_, name))) = (row.len(), other.iter().find(|(sign, _)| row[0].contains(*sign))) {
        return Err(Wrong::new(format!("its columns are separated by {name}"), FORM));
    }
    row.iter().map(head).collect()
}

/// Name and unit of a column.
fn head(cell: &str) -> Result<Head, Wrong> {
    if cell.is_empty() || cell.parse::<f64>().is_ok() {
        return Err(Wrong::new(format!("its first line has `{cell}` instead of the name of a column"), FORM));
    }
    let (name, unit) = match cell.split_once('[') {
        None => (cell, None),
        Some((name, rest)) => {
            let unit = rest.strip_suffix(']').ok_or_else(|| {
                Wrong::new(format!("the name of its column `{cell}` has no closing bracket"), FORM)
            })?;
            (name.trim(), Some(unit.trim().to_string()))
        }
    };
    Ok(Head { name: name.to_string(), unit })
}

/// Reason why a row cannot be read.
fn uneven(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            format!("line {line} has {len} cells, and {expected_len} columns have names")
        }
        _ => error.to_string(),
    }
}
