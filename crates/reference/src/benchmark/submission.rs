//! A table of results: lines `quantity,at,value`, with remarks after `#`.

use super::reference::{Quantity, Reference};
use asperity_plan::reading::scene::suggestions::suggest;
use std::fmt;

/// Line of the names of the columns.
const HEAD: [&str; 3] = ["quantity", "at", "value"];

/// A table of results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Submission {
    /// Remarks of the form `# key: text`.
    pub remarks: Vec<(String, String)>,
    /// Values.
    pub rows: Vec<Row>,
}

/// A value of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Line in the file, from 1.
    pub line: usize,
    /// Name of the quantity.
    pub quantity: String,
    /// Coordinate, as in the reference.
    pub at: Option<f64>,
    /// Value.
    pub value: f64,
}

/// A place in a table that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Defect {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Message.
    pub message: String,
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

/// A field of a line.
#[derive(Clone, Copy)]
struct Field<'a> {
    text: &'a str,
    line: usize,
    column: usize,
}

impl<'a> Field<'a> {
    fn defect<T>(self, message: impl Into<String>) -> Result<T, Defect> {
        Err(Defect { line: self.line, column: self.column, message: message.into() })
    }

    fn number(self) -> Result<f64, Defect> {
        match self.text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => self.defect(format!("`{}` is not finite", self.text)),
            Err(_) => self.defect(format!("`{}` is not a number", self.text)),
        }
    }

    /// Fields of a line, without the spaces around them.
    fn split(line: usize, text: &'a str) -> Vec<Self> {
        let mut column = 1;
        let field = |text: &'a str| {
            let blank = text.chars().take_while(|c| c.is_whitespace()).count();
            let field = Field { text: text.trim(), line, column: column + blank };
            column += text.chars().count() + 1;
            field
        };
        text.split(',').map(field).collect()
    }
}

impl Submission {
    /// Reads a table of results for a benchmark.
    ///
    /// # Errors
    /// The first place that cannot be read.
    pub fn read(bytes: &[u8], reference: &Reference) -> Result<Self, Defect> {
        let text = decoded(bytes)?;
        let mut found = Self::default();
        let mut head = false;
        let mut last = 0;
        for (i, text) in text.lines().enumerate() {
            let line = i + 1;
            last = line;
            if let Some(remark) = text.trim_start().strip_prefix('#') {
                found.remark(remark);
            } else if text.trim().is_empty() {
            } else if head {
                if let Some(row) = row(&Field::split(line, text), reference)? {
                    found.add(row, reference)?;
                }
            } else {
                read_head(&Field::split(line, text))?;
                head = true;
            }
        }
        if !head {
            let message = format!("the table is empty; it begins with the line `{}`", HEAD.join(","));
            return Err(Defect { line: last + 1, column: 1, message });
        }
        Ok(found)
    }

    fn remark(&mut self, text: &str) {
        if let Some((key, value)) = text.split_once(':')
            && !value.trim().is_empty()
        {
            self.remarks.push((key.trim().to_string(), value.trim().to_string()));
        }
    }

    /// Text of a remark.
    #[must_use]
    pub fn says(&self, key: &str) -> Option<&str> {
        self.remarks.iter().find(|(k, _)| k == key).map(|(_, text)| text.as_str())
    }

    fn add(&mut self, (row, at): (Row, Field<'_>), reference: &Reference) -> Result<(), Defect> {
        let place = |row: &Row| reference.quantity(&row.quantity)?.place(row.at)?.at.map(f64::to_bits);
        let same = |r: &&Row| r.quantity == row.quantity && place(r) == place(&row);
        if let Some(first) = self.rows.iter().find(same) {
            return at.defect(format!("`{}` has this value in line {} already", row.quantity, first.line));
        }
        self.rows.push(row);
        Ok(())
    }

    /// The value given for a place of a quantity.
    #[must_use]
    pub fn value(&self, quantity: &Quantity, at: Option<f64>) -> Option<f64> {
        let wanted = quantity.place(at)?;
        let of = self.rows.iter().filter(|row| row.quantity == quantity.name);
        let mut found = of.filter(|row| quantity.place(row.at) == Some(wanted));
        found.next().map(|row| row.value)
    }
}

/// The text of a file, without the mark that some editors put at its beginning.
fn decoded(bytes: &[u8]) -> Result<&str, Defect> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    std::str::from_utf8(bytes).map_err(|error| {
        let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        let line = good.matches('\n').count() + 1;
        let column = good.rsplit('\n').next().map_or(0, |rest| rest.chars().count()) + 1;
        Defect { line, column, message: "the file is not text in UTF-8".into() }
    })
}

fn read_head(fields: &[Field<'_>]) -> Result<(), Defect> {
    for (field, name) in fields.iter().zip(HEAD) {
        if field.text != name {
            let message = format!(
                "`{}` is not the column `{name}`; the first line is `{}`",
                field.text,
                HEAD.join(",")
            );
            return field.defect(message);
        }
    }
    whole(fields)
}

/// Refuses a line with too few or too many fields.
fn whole(fields: &[Field<'_>]) -> Result<(), Defect> {
    let last = fields.last().copied().unwrap_or(Field { text: "", line: 1, column: 1 });
    match fields.len().cmp(&HEAD.len()) {
        std::cmp::Ordering::Equal => Ok(()),
        std::cmp::Ordering::Less => Field { column: last.column + last.text.chars().count(), ..last }
            .defect(format!("the line ends after {} of 3 fields, `{}`", fields.len(), HEAD.join(","))),
        std::cmp::Ordering::Greater => {
            fields[HEAD.len()].defect(format!("the line has {} fields; there are 3 columns", fields.len()))
        }
    }
}

/// The value of a line with its field of coordinates; `None` if the value is left empty.
fn row<'a>(fields: &[Field<'a>], reference: &Reference) -> Result<Option<(Row, Field<'a>)>, Defect> {
    whole(fields)?;
    let (name, at, value) = (fields[0], fields[1], fields[2]);
    let Some(quantity) = reference.quantity(name.text) else {
        let known = reference.quantities.iter().map(|q| q.name.as_str());
        return name.defect(format!(
            "`{}` is not a quantity of {}; {}",
            name.text,
            reference.benchmark,
            suggest(name.text, "quantities", known)
        ));
    };
    let coordinate = coordinate(quantity, at)?;
    if value.text.is_empty() {
        return Ok(None);
    }
    let value = value.number()?;
    let row = Row { line: name.line, quantity: quantity.name.clone(), at: coordinate, value };
    Ok(Some((row, at)))
}

fn coordinate(quantity: &Quantity, field: Field<'_>) -> Result<Option<f64>, Defect> {
    let name = &quantity.name;
    if quantity.along.is_none() {
        return match field.text {
            "" => Ok(None),
            _ => field.defect(format!("`{name}` is one value; leave `at` empty")),
        };
    }
    let list = || {
        let places: Vec<String> =
            quantity.places.iter().filter_map(|p| p.at).map(|at| at.to_string()).collect();
        places.join(", ")
    };
    if field.text.is_empty() {
        return field.defect(format!("`{name}` needs its coordinate `at`, one of {}", list()));
    }
    let at = field.number()?;
    if quantity.place(Some(at)).is_none() {
        return field.defect(format!("`{name}` is not asked for at {}; it is at {}", field.text, list()));
    }
    Ok(Some(at))
}
