//! Numbers of a scene that are in files of columns.

use crate::defaults::TIME_COLUMN;
use crate::diagnostic::Diagnostic;
use crate::model::{Scene, Spanned, TableFile, TableOver, TimeSeries};
use crate::plausibility;
use crate::units::{Dimension, Length};
use asperity_run::Warning;
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

/// Fills the tables and traces of a scene whose numbers are in files.
///
/// Returns warnings of implausible values.
///
/// # Errors
/// The first error of the reader.
pub(super) fn fill(scene: &mut Scene, columns: &mut Columns<'_>) -> Result<Vec<Warning>, Diagnostic> {
    let doubts = fill_tables(scene.tables_mut(), columns)?;
    for trace in scene.traces_mut() {
        let Some(file) = trace.file().map(|given| given.file.clone()) else { continue };
        let wanted = ["x", "y"].map(|name| Column { name, place: file.span(), dimension: Dimension::Length });
        let mut found = columns(&file, &wanted)?.into_iter();
        let (x, y) = (found.next().unwrap_or_default(), found.next().unwrap_or_default());
        trace.fill(x.into_iter().zip(y).map(|(x, y)| [Length(x), Length(y)]).collect());
    }
    Ok(doubts)
}

/// Fills tables whose numbers are in files. Returns warnings of implausible values.
pub(super) fn fill_tables<'a>(
    tables: impl Iterator<Item = TableOver<'a>>,
    columns: &mut Columns<'_>,
) -> Result<Vec<Warning>, Diagnostic> {
    let mut doubts = Vec::new();
    for TableOver { table, dimension, keys, duration, holds } in tables {
        let Some(given) = table.file().cloned() else { continue };
        let time = given.time.as_ref().map_or((TIME_COLUMN, given.file.span()), |t| (t.get_ref(), t.span()));
        let wanted = [
            Column { name: time.0, place: time.1, dimension: Dimension::Time },
            Column { name: given.column.get_ref(), place: given.column.span(), dimension },
        ];
        let mut found = columns(&given.file, &wanted)?.into_iter();
        let (times, values) = (found.next().unwrap_or_default(), found.next().unwrap_or_default());
        table.fill(taken(&given, times.into_iter().zip(values).collect(), (duration, holds))?);
        doubts.extend(doubt(&given, (keys, dimension), table));
    }
    Ok(doubts)
}

/// Warning of implausible values of a table that stands under these keys.
fn doubt(
    file: &TableFile,
    (keys, dimension): (&[&str], Dimension),
    points: &[(f64, f64)],
) -> Option<Warning> {
    let (message, help) = plausibility::judge_file(keys, dimension.si(), points.iter().map(|p| p.1))?;
    let (column, name) = (&file.column, file.file.get_ref());
    Some(Warning::at(column.span(), format!("column `{}` of `{name}`: {message}", column.get_ref()), help))
}

/// Entries of a file that a scene takes.
fn taken(
    file: &TableFile,
    mut points: Vec<(f64, f64)>,
    (duration, holds): (Option<f64>, bool),
) -> Result<TimeSeries, Diagnostic> {
    let tare = file.tare.as_ref().is_some_and(|tare| *tare.get_ref());
    if let Some(&(_, zero)) = points.first().filter(|_| tare) {
        points.iter_mut().for_each(|p| p.1 -= zero);
    }
    let points = TimeSeries::from(points);
    let Some(from) = &file.from else { return Ok(points) };
    points.part(from.get_ref().0, duration, holds).ok_or_else(|| {
        let [first, last] = [points.first(), points.last()].map(|p| p.map_or(0.0, |p| p.0));
        Diagnostic::at(
            from.span(),
            format!(
                "the times of `{}` run from {first:?} s to {last:?} s: none lies in what begins at {:?} s",
                file.file.get_ref(),
                from.get_ref().0
            ),
            "`from` is the time in the file at which the stage begins",
        )
    })
}
