//! Errors in a scene, found in reading or in planning.

mod position;

pub use position::line_column;

use std::fmt;
use std::ops::Range;

/// An error in a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Diagnostic {
    /// Message.
    pub message: String,
    /// Suggested remedy.
    pub help: Option<String>,
    /// Byte range in the scene file; empty if there is no file.
    pub span: Range<usize>,
    /// Other positions involved, each with a short label.
    pub also: Vec<(Range<usize>, String)>,
}

impl Diagnostic {
    /// Creates an error with a position and a remedy.
    #[must_use]
    pub fn at(span: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), span, also: Vec::new() }
    }

    /// Creates an error about a body.
    #[must_use]
    pub fn body(name: &str, span: Range<usize>, message: String) -> Self {
        Self { message: format!("body `{name}`: {message}"), help: None, span, also: Vec::new() }
    }

    /// Adds another position to the error.
    #[must_use]
    pub fn and(mut self, span: Range<usize>, words: impl Into<String>) -> Self {
        self.also.push((span, words.into()));
        self
    }
}

/// All errors in a scene, in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            f.write_str(&error.message)?;
            if let Some(help) = &error.help {
                write!(f, " ({help})")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

impl From<Diagnostic> for Diagnostics {
    fn from(error: Diagnostic) -> Self {
        Self(vec![error])
    }
}
