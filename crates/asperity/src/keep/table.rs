//! Tables of a run that grow by whole rows.

use asperity_output::tables::GrowingTable;
use asperity_output::tables::column::{self, Column};
use asperity_output::{OutputError, atomic};
use asperity_run::Kind;
use std::path::Path;

/// Row of a moment of a run of a kind, after a number of steps.
type Row<'a, K> = Box<dyn for<'m> Fn(&<K as Kind>::Moment<'m>, u64) -> String + Send + 'a>;

/// A table of a kind of run: where it is, its columns, when its rows are due, and what they hold.
pub struct Table<'a, K: Kind, C> {
    /// Path below the output directory.
    pub path: String,
    /// Columns.
    pub columns: Vec<Column>,
    /// Header, if it is not the line of the columns.
    pub head: Option<String>,
    /// Course that its rows follow.
    pub course: C,
    /// Row of a moment.
    pub row: Row<'a, K>,
}

impl<'a, K: Kind, C> Table<'a, K, C> {
    /// A table whose rows need no number of steps.
    pub fn new(
        path: impl Into<String>,
        columns: Vec<Column>,
        course: C,
        row: impl for<'m> Fn(&K::Moment<'m>) -> String + Send + 'a,
    ) -> Self {
        Self { path: path.into(), columns, head: None, course, row: Box::new(move |now, _| row(now)) }
    }

    /// The table with a header of another format.
    #[must_use]
    pub fn headed(self, head: String) -> Self {
        Self { head: Some(head), ..self }
    }

    /// Creates the file of the table below `out`, or reopens it at a size in bytes; anything beyond is cut off.
    ///
    /// # Errors
    /// If the file cannot be written, or is missing or shorter than it was.
    pub fn open(&self, out: &Path, size: Option<u64>) -> Result<GrowingTable, OutputError> {
        let path = out.join(&self.path);
        path.parent().map_or(Ok(()), atomic::create_dir)?;
        match size {
            Some(size) => GrowingTable::reopen(path, size),
            None => {
                GrowingTable::create(path, self.head.clone().unwrap_or_else(|| column::header(&self.columns)))
            }
        }
    }
}
