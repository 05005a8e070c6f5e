//! Warnings about settings of a scene that are admissible but probably not intended.

use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;
use std::ops::Range;

/// Position of a warning; lines and columns count from 1.
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
    /// Message.
    pub message: String,
    /// Suggested remedy.
    pub help: Option<String>,
    /// Position; absent if the scene was built in Rust or the warning is not about a single position.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<Place>,
    /// Byte range in the scene file; empty if there is no file.
    #[serde(skip)]
    pub span: Range<usize>,
}

impl Warning {
    /// Creates a warning with a position and a remedy.
    #[must_use]
    pub fn at(span: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), place: None, span }
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
