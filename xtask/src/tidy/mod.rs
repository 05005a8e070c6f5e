//! Checks of the workspace that neither the compiler nor clippy makes. Every rule has a test with a text it must catch.

mod book;
mod graph;
mod house;
mod source;
mod text;
mod tree;

use crate::stage::Failure;
use std::fmt;
use std::path::Path;

/// Something a rule found.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Problem {
    /// File, relative to the workspace.
    pub path: String,
    /// Line, from 1; 0 for the file as a whole.
    pub line: usize,
    /// What is wrong.
    pub message: String,
    /// Whether it only warns.
    pub warning: bool,
}

impl Problem {
    /// An error.
    pub fn new(path: &str, line: usize, message: impl Into<String>) -> Problem {
        Problem { path: path.to_owned(), line, message: message.into(), warning: false }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.warning { "warning: " } else { "" };
        write!(f, "{}:{}: {kind}{}", self.path, self.line.max(1), self.message)
    }
}

/// All problems of the workspace, sorted by place.
pub fn check(root: &Path) -> Result<Vec<Problem>, Failure> {
    let mut found = graph::check(root)?;
    let files = tree::files(root)?;
    for file in &files {
        found.extend(text::check(&file.path, &file.text));
        if file.path.ends_with(".rs") {
            found.extend(source::check(&file.path, &file.text));
        }
    }
    found.extend(house::check(&files));
    found.extend(book::check(&files, &|path| root.join(path).exists()));
    found.sort();
    found.dedup();
    Ok(found)
}
