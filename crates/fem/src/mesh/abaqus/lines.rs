//! Lines of an input file: keywords with their parameters, and data.

use crate::mesh::error::{MeshError, Place};

/// Number of characters of a wrong value shown in an error.
const SHOWN: usize = 40;

/// Bits of the number of a node or element. Abaqus allows nine digits.
pub(super) const BITS: u32 = 48;

/// A keyword line with its continuations.
#[derive(Clone, Debug)]
pub(super) struct Keyword {
    /// Keyword in capitals with its star.
    pub name: String,
    /// Parameters in capitals, and values as written.
    pub parameters: Vec<(String, Option<String>)>,
    /// Line.
    pub line: usize,
}

impl Keyword {
    fn parse(text: &str, line: usize) -> Self {
        let mut parts = text.split(',').map(str::trim);
        let name = parts.next().unwrap_or_default().to_uppercase();
        let parameters = parts
            .filter(|p| !p.is_empty())
            .map(|p| match p.split_once('=') {
                Some((key, value)) => {
                    let value = value.trim().trim_matches('"').to_string();
                    (key.trim().to_uppercase(), Some(value))
                }
                None => (p.to_uppercase(), None),
            })
            .collect();
        Self { name, parameters, line }
    }

    /// Value of a parameter.
    pub(super) fn value(&self, key: &str) -> Option<&str> {
        self.parameters.iter().find(|(k, _)| k == key).and_then(|(_, v)| v.as_deref())
    }

    /// Value of a required parameter.
    pub(super) fn need(&self, key: &str, expected: &'static str) -> Result<&str, MeshError> {
        self.value(key).filter(|v| !v.is_empty()).ok_or_else(|| self.syntax(self.line, expected, &self.name))
    }

    /// True if a parameter is present.
    pub(super) fn has(&self, key: &str) -> bool {
        self.parameters.iter().any(|(k, _)| k == key)
    }

    pub(super) fn syntax(&self, line: usize, expected: &'static str, found: &str) -> MeshError {
        let found = found.chars().take(SHOWN).collect();
        MeshError::Syntax { section: self.name.clone(), place: Place::Line(line), expected, found }
    }

    pub(super) fn unsupported(&self, reason: &'static str) -> MeshError {
        MeshError::Unsupported { section: self.name.clone(), place: Place::Line(self.line), reason }
    }

    /// A node or element number.
    pub(super) fn number(&self, text: &str, line: usize) -> Result<u64, MeshError> {
        let number = text.parse().ok().filter(|number: &u64| number >> BITS == 0);
        number.ok_or_else(|| self.syntax(line, "a number of a node or element", text))
    }

    /// A real number; exponents may be written with D, as in Fortran.
    pub(super) fn real(&self, text: &str, line: usize) -> Result<f64, MeshError> {
        let wrong = |_| self.syntax(line, "a coordinate", text);
        text.parse().or_else(|_| text.replace(['d', 'D'], "e").parse()).map_err(wrong)
    }
}

/// Kind of a line.
pub(super) enum Line<'a> {
    /// A keyword.
    Keyword(Keyword),
    /// Values, and their line. A trailing comma is dropped.
    Data(Vec<&'a str>, usize),
}

/// The lines of a file without comments and empty lines. Bytes that are not text are shown as such in errors.
pub(super) struct Lines<'a> {
    rest: std::iter::Enumerate<std::str::Split<'a, char>>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text.split('\n').enumerate() }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        loop {
            let (number, text) = self.rest.next()?;
            let text = text.trim();
            if text.is_empty() || text.starts_with("**") {
                continue;
            }
            if !text.starts_with('*') {
                let mut values: Vec<&str> = text.split(',').map(str::trim).collect();
                if values.len() > 1 && values.last() == Some(&"") {
                    values.pop();
                }
                return Some(Line::Data(values, number + 1));
            }
            let mut keyword = text.to_string();
            while keyword.ends_with(',') {
                match self.rest.next() {
                    Some((_, more)) => keyword.push_str(more.trim()),
                    None => break,
                }
            }
            return Some(Line::Keyword(Keyword::parse(&keyword, number + 1)));
        }
    }
}
