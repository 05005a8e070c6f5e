//! Tables of a value over time, in a scene or in a file.

use crate::spanned::Spanned;
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::Deref;

/// A value over time: pairs of time since the stage began \[s\] and value in SI units, linear in between.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tabled {
    /// The pairs; those of a file once it has been read.
    points: Vec<(f64, f64)>,
    /// The file that has them.
    file: Option<TableFile>,
}

impl Tabled {
    /// A table that a file has.
    #[must_use]
    pub fn in_file(file: TableFile) -> Self {
        Self { points: Vec::new(), file: Some(file) }
    }

    /// The file that has the pairs.
    #[must_use]
    pub fn file(&self) -> Option<&TableFile> {
        self.file.as_ref()
    }

    /// Sets the pairs that have been read from the file.
    pub fn fill(&mut self, points: Vec<(f64, f64)>) {
        self.points = points;
    }
}

impl From<Vec<(f64, f64)>> for Tabled {
    fn from(points: Vec<(f64, f64)>) -> Self {
        Self { points, file: None }
    }
}

impl Deref for Tabled {
    type Target = [(f64, f64)];

    fn deref(&self) -> &Self::Target {
        &self.points
    }
}

/// Columns of time and value in a CSV file.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TableFile {
    /// Path of a CSV file, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Column of the values.
    pub column: Spanned<String>,
    /// Column of the times since the stage began; default `"time"`.
    pub time: Option<Spanned<String>>,
}
