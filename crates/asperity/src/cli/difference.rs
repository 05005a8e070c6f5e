//! The comparison of two output directories.

use super::end::End;
use super::inputs;
use asperity_output::terminal::printing::out;
use asperity_reference::difference::{Difference, Overlap, Table, TableComparison, compare};
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

/// Relative difference up to which results agree, by default: far above the rounding that another processor leaves in bodies,
/// 4e-13, and at the tolerance to which faults and sliders are integrated.
pub(super) const TOLERANCE: f64 = 1e-6;

/// Verdict on two tables: whether they agree, and how many rows were compared.
type Verdict = (bool, usize);

/// Compares the tables of two directories.
pub(super) fn directories(a: &Path, b: &Path, tolerance: f64) -> End {
    let (mut first, mut second) = (BTreeSet::new(), BTreeSet::new());
    for (folder, found) in [(a, &mut first), (b, &mut second)] {
        if let Err(error) = collect(folder, Path::new(""), found) {
            return End::Unreadable(format!("cannot read {}: {error}", folder.display()));
        }
        if found.is_empty() {
            return End::Unreadable(format!("{} has no tables", folder.display()));
        }
    }
    let (mut agree, mut differ, mut compared) = (0, 0, 0);
    for name in first.union(&second) {
        let (same, rows) = match (first.contains(name), second.contains(name)) {
            (true, true) => match table(&a.join(name), &b.join(name), name, tolerance) {
                Ok(verdict) => verdict,
                Err(why) => return End::Unreadable(why),
            },
            (only, _) => {
                let folder = if only { a } else { b };
                out(format_args!("{}: only in {}, differs\n", name.display(), folder.display()));
                (false, 0)
            }
        };
        if same {
            agree += 1
        } else {
            differ += 1
        }
        compared += rows;
    }
    out(format_args!(
        "{agree} tables agree to {tolerance:e} of their largest values, {differ} differ; {compared} rows compared\n"
    ));
    match (differ, compared) {
        (0, 0) => {
            out(format_args!("no table has a row: there is nothing to agree\n"));
            End::Differs
        }
        (0, _) => End::Done,
        _ => End::Differs,
    }
}

/// Prints what was compared of two tables, and their differences.
fn table(a: &Path, b: &Path, name: &Path, tolerance: f64) -> Result<Verdict, String> {
    let read = |path: &Path| {
        let bytes = fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        Table::read(&bytes).map_err(|error| format!("{}: {error}", path.display()))
    };
    let (a, b) = (read(a)?, read(b)?);
    let (columns, overlap) = match compare(&a, &b) {
        TableComparison::Columns(columns, overlap) => (columns, overlap),
        TableComparison::Other(why) => {
            out(format_args!("{}: {why}, differs\n", name.display()));
            return Ok((false, 0));
        }
    };
    let (within, enough) = (columns.iter().all(|c| c.within(tolerance)), overlap.suffices(tolerance));
    let verdict = match (columns.is_empty(), within, enough) {
        (_, _, false) => "too little is compared, differs",
        (true, _, _) => "equal",
        (false, true, _) => "agrees",
        (false, false, _) => "differs",
    };
    out(format_args!("{}: {}, {verdict}\n", name.display(), extent(&overlap)));
    print(&columns, tolerance);
    Ok((within && enough, overlap.rows))
}

/// Rows compared and, where the times are others, the share of the time.
fn extent(overlap: &Overlap) -> String {
    let Overlap { rows, of, share, interpolated, .. } = *overlap;
    if !interpolated {
        return format!("{rows} rows");
    }
    let share = match share {
        1.0 => "all".to_string(),
        // Rounded down: what is not all of the time does not look like it.
        share => format!("{} %", (share * PER_CENT * PARTS).floor() / PARTS),
    };
    format!("{rows} of {of} rows, the first at the times of the second, {share} of the time")
}

/// Per cent.
const PER_CENT: f64 = 100.0;
/// Parts of a per cent that are printed.
const PARTS: f64 = 1000.0;

/// Prints differences of columns.
fn print(columns: &[Difference], tolerance: f64) {
    let width = columns.iter().map(|column| column.name.chars().count()).max().unwrap_or(0);
    for column in columns {
        let Difference { name, largest, relative, row, exact } = column;
        let beyond = if column.within(tolerance) { "" } else { "  differs" };
        if *exact {
            out(format_args!("  {name:width$}  another entry in row {row}{beyond}\n"));
        } else {
            out(format_args!(
                "  {name:width$}  {largest:.3e} in row {row}, {relative:.1e} of the largest value{beyond}\n"
            ));
        }
    }
}

/// True for a file that is a table of a run: CSV, files of stations and platforms, models of finite faults.
fn is_table(within: &Path) -> bool {
    let folder = within.parent().and_then(Path::to_str).unwrap_or_default();
    let end = within.extension().and_then(OsStr::to_str).unwrap_or_default();
    matches!((folder, end), (_, "csv" | "fsp") | ("stations", _) | ("platform", "txt" | "dat"))
}

/// Tables of a run below a folder, as paths within it. Copies of its inputs are not among them.
fn collect(folder: &Path, within: &Path, found: &mut BTreeSet<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder.join(within))? {
        let entry = entry?;
        let path = within.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            if path != Path::new(inputs::FOLDER) {
                collect(folder, &path, found)?;
            }
        } else if is_table(&path) {
            found.insert(path);
        }
    }
    Ok(())
}
