//! `README.md` of an output directory: what each file there is.

use super::begin::{README, REPORT};
use super::entries;
use asperity_output::{OutputError, atomic};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

/// Writes the text about the files that exist.
pub(super) fn write(folder: &Path, title: &str) -> Result<(), OutputError> {
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
    let text = format!(
        "# {title}\n\nResults of a run of asperity {}. The chapter \"Files and columns\" of its book has all columns.\n\n{rows}",
        env!("CARGO_PKG_VERSION")
    );
    atomic::write(&folder.join(README), text.as_bytes())
}
