//! `README.md` of an output directory: what each file there is.

use super::begin::{README, REPORT};
use super::entries;
use asperity_output::fields::Field;
use asperity_output::tables::Column;
use asperity_output::tables::describe::{FileParts, Row, describe};
use asperity_output::{OutputError, atomic};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

/// Writes the text about the files that exist, about the columns of these tables among them, and about these fields.
pub(super) fn write(
    folder: &Path,
    title: &str,
    tables: &[FileParts<Column>],
    fields: &[FileParts<Field>],
) -> Result<(), OutputError> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.file_name().to_str()?.to_string()))
        .chain([README.to_string(), REPORT.to_string()])
        .collect();
    names.sort();
    names.dedup();
    let row = |name: &String| {
        let meaning = entries::named(OsStr::new(name))?.meaning;
        let slash = if folder.join(name).is_dir() { "/" } else { "" };
        Some(format!("- `{name}{slash}`: {meaning}\n"))
    };
    let rows: String = names.iter().filter(|name| !name.starts_with('.')).filter_map(row).collect();
    let mut text = format!(
        "# {title}\n\nResults of a run of asperity {}, described in the chapter \"Files and columns\" of its book.\n\n{rows}",
        env!("CARGO_PKG_VERSION")
    );
    text.push_str(&section(folder, "Columns of tables", tables));
    text.push_str(&section(folder, "Arrays of fields", fields));
    atomic::write(&folder.join(README), text.as_bytes())
}

/// Section about the parts of the files of these paths that exist; empty if none does.
fn section<R: Row + Clone>(folder: &Path, title: &str, files: &[FileParts<R>]) -> String {
    let written: Vec<_> = files.iter().filter(|file| exists(folder, &file.path)).cloned().collect();
    if written.is_empty() {
        return String::new();
    }
    let signs = "The chapter \"Signs in files\" explains the words of signs.";
    format!("\n## {title}\n\n{signs}\n\n{}", describe(&written))
}

/// True if there is a file of this path below a folder, where `*` is any text in its name.
fn exists(folder: &Path, path: &str) -> bool {
    let Some((begin, end)) = path.split_once('*') else { return folder.join(path).exists() };
    let (inner, begin) = begin.rsplit_once('/').unwrap_or(("", begin));
    let names = fs::read_dir(folder.join(inner)).into_iter().flatten().flatten();
    names
        .filter_map(|entry| entry.file_name().into_string().ok())
        .any(|name| name.starts_with(begin) && name.ends_with(end))
}
