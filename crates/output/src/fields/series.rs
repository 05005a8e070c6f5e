//! Series of files for ParaView that have the same grid and the same fields.

use super::field::{Data, Field};
use super::vtu::{Array, Grid};
use crate::tables::describe::FileParts;
use crate::{OutputError, atomic};
use rayon::prelude::*;
use std::path::Path;
use std::sync::LazyLock;

/// Times at which a series has files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldTimes {
    /// Times during the run, with numbers of five digits.
    Intervals,
    /// Onsets of events, with numbers of three digits.
    Events,
    /// End of the run.
    End,
}

/// Values of a field at a state `S`; none where it has no values there.
type Read<'a, S> = Box<dyn for<'s> Fn(&'s S) -> Option<Data<'s>> + Send + Sync + 'a>;

/// Maker of a grid.
type MakeGrid<'a> = Box<dyn FnOnce() -> Grid + Send + 'a>;

/// A series of files: where they are, their times and their grid, and fields that are read from states `S`.
pub struct Series<'a, S> {
    /// Path below the output directory, with `*` for the number of the file.
    path: String,
    times: FieldTimes,
    /// Encoded with the first file.
    grid: LazyLock<Grid, MakeGrid<'a>>,
    fields: Vec<(Field, Read<'a, S>)>,
}

impl<S> std::fmt::Debug for Series<'_, S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Series").field("path", &self.path).field("times", &self.times).finish_non_exhaustive()
    }
}

impl<'a, S> Series<'a, S> {
    /// A series without fields.
    #[must_use]
    pub fn new(path: impl Into<String>, times: FieldTimes, grid: impl FnOnce() -> Grid + Send + 'a) -> Self {
        let grid = LazyLock::new(Box::new(grid) as MakeGrid<'a>);
        Self { path: path.into(), times, grid, fields: Vec::new() }
    }

    /// Adds a field with its values.
    #[must_use]
    pub fn with(self, field: Field, values: impl for<'s> Fn(&'s S) -> Data<'s> + Send + Sync + 'a) -> Self {
        self.with_some(field, move |state| Some(values(state)))
    }

    /// Adds a field that states may not have.
    #[must_use]
    pub fn with_some(
        mut self,
        field: Field,
        values: impl for<'s> Fn(&'s S) -> Option<Data<'s>> + Send + Sync + 'a,
    ) -> Self {
        self.fields.push((field, Box::new(values)));
        self
    }

    /// Path of its files with their fields, in the order of their arrays.
    #[must_use]
    pub fn fields(&self) -> FileParts<Field> {
        FileParts::new(&self.path, self.fields.iter().map(|(field, _)| field.clone()).collect())
    }

    /// Path below the output directory of the file with this number.
    #[must_use]
    pub fn file(&self, number: usize) -> String {
        let number = match self.times {
            FieldTimes::Intervals => format!("{number:05}"),
            FieldTimes::Events => format!("{number:03}"),
            FieldTimes::End => String::new(),
        };
        self.path.replacen('*', &number, 1)
    }

    /// Writes the file of this number below `out`, with a state at `time` \[s\]. Returns its size \[bytes\].
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, out: &Path, number: usize, time: f64, state: &S) -> Result<u64, OutputError> {
        let mut shown: Vec<(&Field, Data<'_>)> = Vec::with_capacity(self.fields.len());
        for (field, read) in &self.fields {
            shown.extend(read(state).map(|data| (field, data)));
        }
        let encoded = |by_cell: bool| -> Vec<Array<'_>> {
            let own = shown.par_iter().filter(|(field, _)| field.by_cell == by_cell);
            own.map(|(field, data)| field.array(data)).collect()
        };
        let bytes = self.grid.file(time, &encoded(false), &encoded(true));
        atomic::write(&out.join(self.file(number)), &bytes)?;
        Ok(bytes.len() as u64)
    }
}
