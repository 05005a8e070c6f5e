//! Warnings: what a scene says that runs, and probably does not mean what its author wants.

use crate::diagnostic::line_column;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;
use std::ops::Range;

/// Place of a warning, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Place {
    /// Line of the scene file.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

/// A warning of a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Warning {
    /// Doubt.
    pub message: String,
    /// Remedy.
    pub help: Option<String>,
    /// Place; none where the scene was built in Rust, or where it is about no single place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<Place>,
    /// Bytes of the scene file it is about; empty when there is no file.
    #[serde(skip)]
    pub span: Range<usize>,
}

impl Warning {
    /// A warning with a place and a remedy.
    #[must_use]
    pub fn at(span: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), place: None, span }
    }

    /// Finds the line and column in the text of the scene.
    pub fn locate(&mut self, text: &str) {
        if !self.span.is_empty() {
            let (line, column) = line_column(text, self.span.start);
            self.place = Some(Place { line, column });
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(Place { line, column }) = self.place {
            write!(f, "line {line}, column {column}: ")?;
        }
        f.write_str(&self.message)?;
        match &self.help {
            Some(help) => write!(f, "; {help}"),
            None => Ok(()),
        }
    }
}
