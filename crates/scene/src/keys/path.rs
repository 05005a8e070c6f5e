//! Paths of keys, such as `stages[0].conditions[1].x`.

use std::fmt;
use std::iter::Peekable;
use std::str::Chars;

/// A step of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A key of a table.
    Key(String),
    /// An entry of a list, counted from zero.
    Index(usize),
}

/// A path of keys. A name with other characters than letters, digits, `-` and `_` is written in quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Path(pub Vec<Step>);

impl Path {
    /// Reads a path; `None` if it is malformed.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        let mut rest = text.trim().chars().peekable();
        let mut steps = vec![Step::Key(key(&mut rest)?)];
        while let Some(c) = rest.next() {
            steps.push(match c {
                '.' => Step::Key(key(&mut rest)?),
                '[' => {
                    let digits: String = rest.by_ref().take_while(|c| *c != ']').collect();
                    Step::Index(digits.parse().ok()?)
                }
                _ => return None,
            });
        }
        Some(Self(steps))
    }
}

/// The next key, in quotes or bare.
fn key(rest: &mut Peekable<Chars<'_>>) -> Option<String> {
    if let Some(quote) = rest.next_if(|c| matches!(c, '"' | '\'')) {
        let mut name = String::new();
        loop {
            match rest.next()? {
                c if c == quote => return Some(name),
                c => name.push(c),
            }
        }
    }
    let mut name = String::new();
    while let Some(c) = rest.next_if(|c| is_bare(*c)) {
        name.push(c);
    }
    (!name.is_empty()).then_some(name)
}

fn is_bare(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '-' | '_')
}

/// A key as it is written in TOML.
#[must_use]
pub fn written(key: &str) -> String {
    match !key.is_empty() && key.chars().all(is_bare) {
        true => key.to_string(),
        false => format!("{key:?}"),
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            match step {
                Step::Key(name) if i == 0 => f.write_str(&written(name))?,
                Step::Key(name) => write!(f, ".{}", written(name))?,
                Step::Index(k) => write!(f, "[{k}]")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_read_as_it_is_written() {
        for text in
            ["time", "faults.main.law.a", "stages[0].conditions[12].x", "faults.\"my fault\".rate", "a[1][2]"]
        {
            assert_eq!(Path::read(text).unwrap().to_string(), text);
        }
        for text in ["", ".", "a.", ".a", "a[", "a[]", "a[b]", "a[-1]", "a b", "a=1", "\"a", "a]", "a[1]b"] {
            assert_eq!(Path::read(text), None, "{text}");
        }
    }
}
