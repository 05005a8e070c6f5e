//! Errors in a scene, found when it is read or when it is planned.

mod position;

pub use position::line_column;

use std::fmt;
use std::ops::Range;

/// Something wrong in a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Diagnostic {
    /// The fault.
    pub message: String,
    /// Remedy.
    pub help: Option<String>,
    /// Bytes of the scene file it is about; empty when there is no file.
    pub span: Range<usize>,
    /// Other places that take part in it, each with a few words.
    pub also: Vec<(Range<usize>, String)>,
}

impl Diagnostic {
    /// An error with a place and a remedy.
    #[must_use]
    pub fn at(span: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), span, also: Vec::new() }
    }

    /// An error about a body.
    #[must_use]
    pub fn body(name: &str, span: Range<usize>, message: String) -> Self {
        Self { message: format!("body `{name}`: {message}"), help: None, span, also: Vec::new() }
    }

    /// The same error, pointing to another place as well.
    #[must_use]
    pub fn and(mut self, span: Range<usize>, words: impl Into<String>) -> Self {
        self.also.push((span, words.into()));
        self
    }
}

/// Everything wrong in a scene, in the order of the file.
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
