//! The comparison of two output directories.

use super::end::End;
use crate::difference::{Compared, Table, compare};
use asperity_output::printing::out;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Relative difference up to which results agree, by default: far above the rounding that another processor leaves in bodies,
/// 4e-13, and at the tolerance to which faults and sliders are integrated.
pub(super) const TOLERANCE: f64 = 1e-6;

/// Compares the tables of two directories.
pub(super) fn directories(a: &Path, b: &Path, tolerance: f64) -> End {
    let (mut first, mut second) = (BTreeSet::new(), BTreeSet::new());
    for (folder, found) in [(a, &mut first), (b, &mut second)] {
        if let Err(error) = collect(folder, Path::new(""), found) {
            return End::Unreadable(format!("cannot read {}: {error}", folder.display()));
        }
        if found.is_empty() {
            return End::Unreadable(format!("{} has no tables (CSV)", folder.display()));
        }
    }
    let (mut agree, mut differ) = (0, 0);
    for name in first.union(&second) {
        let same = match (first.contains(name), second.contains(name)) {
            (true, true) => match table(&a.join(name), &b.join(name), name, tolerance) {
                Ok(same) => same,
                Err(why) => return End::Unreadable(why),
            },
            (only, _) => {
                let folder = if only { a } else { b };
                out(format_args!("{}: only in {}\n", name.display(), folder.display()));
                false
            }
        };
        if same { agree += 1 } else { differ += 1 }
    }
    out(format_args!("{agree} tables agree to {tolerance:e} of their largest values, {differ} differ\n"));
    if differ == 0 { End::Done } else { End::Differs }
}

/// Prints the differences of two tables; true if they agree.
fn table(a: &Path, b: &Path, name: &Path, tolerance: f64) -> Result<bool, String> {
    let read = |path: &Path| {
        let bytes = fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        Table::read(&bytes).map_err(|error| format!("{}: {error}", path.display()))
    };
    let (a, b) = (read(a)?, read(b)?);
    match compare(&a, &b) {
        Compared::Other(why) => {
            out(format_args!("{}: {why}\n", name.display()));
            Ok(false)
        }
        Compared::Columns(columns, interpolated) => {
            let width = columns.iter().map(|column| column.name.chars().count()).max().unwrap_or(0);
            if !columns.is_empty() {
                let times = if interpolated { " (the first at the times of the second)" } else { "" };
                out(format_args!("{}{times}\n", name.display()));
            }
            for column in &columns {
                let beyond = if column.relative > tolerance { "  differs" } else { "" };
                out(format_args!(
                    "  {:width$}  {:.3e} in row {}, {:.1e} of the largest value{beyond}\n",
                    column.name, column.largest, column.row, column.relative
                ));
            }
            Ok(columns.iter().all(|column| column.relative <= tolerance))
        }
    }
}

/// Tables below a folder, as paths within it.
fn collect(folder: &Path, within: &Path, found: &mut BTreeSet<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder.join(within))? {
        let entry = entry?;
        let path = within.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            collect(folder, &path, found)?;
        } else if path.extension().is_some_and(|end| end == "csv") {
            found.insert(path);
        }
    }
    Ok(())
}
