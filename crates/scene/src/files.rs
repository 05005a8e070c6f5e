//! Numbers of a scene that stand in files of columns.

use crate::diagnostic::Diagnostic;
use crate::model::{Scene, Spanned, Tabled};
use crate::units::{Dimension, Length};
use std::ops::Range;

/// A column of a file that a scene names.
#[derive(Clone, Debug)]
pub struct Column<'a> {
    /// Its name.
    pub name: &'a str,
    /// Position of the name in the scene, or of the file where a name is usual.
    pub place: Range<usize>,
    /// Dimension of its numbers.
    pub dimension: Dimension,
}

/// Reader of files: numbers of the columns of a file, in SI units and in their order.
pub type Columns<'a> = dyn FnMut(&Spanned<String>, &[Column<'_>]) -> Result<Vec<Vec<f64>>, Diagnostic> + 'a;

/// Name of the column of times, if none is given.
const TIME: &str = "time";

/// Fills the tables and traces of a scene whose numbers stand in files.
///
/// # Errors
/// The first error of the reader.
pub(super) fn fill(scene: &mut Scene, columns: &mut Columns<'_>) -> Result<(), Diagnostic> {
    fill_tables(scene.tables_mut(), columns)?;
    for trace in scene.traces_mut() {
        let Some(file) = trace.file().map(|given| given.file.clone()) else { continue };
        let wanted = ["x", "y"].map(|name| Column { name, place: file.span(), dimension: Dimension::Length });
        let mut found = columns(&file, &wanted)?.into_iter();
        let (x, y) = (found.next().unwrap_or_default(), found.next().unwrap_or_default());
        trace.fill(x.into_iter().zip(y).map(|(x, y)| [Length(x), Length(y)]).collect());
    }
    Ok(())
}

/// Fills tables whose numbers stand in files.
pub(super) fn fill_tables<'a>(
    tables: impl Iterator<Item = (&'a mut Tabled, Dimension)>,
    columns: &mut Columns<'_>,
) -> Result<(), Diagnostic> {
    for (table, dimension) in tables {
        let Some(given) = table.file().cloned() else { continue };
        let time = given.time.as_ref().map_or((TIME, given.file.span()), |t| (t.get_ref(), t.span()));
        let wanted = [
            Column { name: time.0, place: time.1, dimension: Dimension::Time },
            Column { name: given.column.get_ref(), place: given.column.span(), dimension },
        ];
        let mut found = columns(&given.file, &wanted)?.into_iter();
        let (times, values) = (found.next().unwrap_or_default(), found.next().unwrap_or_default());
        table.fill(times.into_iter().zip(values).collect());
    }
    Ok(())
}
