//! The report: `report.json` and the HTML pages, in one folder.

mod case_page;
mod claims;
pub mod convergence;
pub mod coverage;
pub mod defects;
pub mod fields;
mod figures;
pub mod history;
pub mod ids;
pub mod index;
pub mod json;
pub mod junit;
pub mod mathml;
pub mod page;
pub mod precision;
pub mod provenance;
pub mod read;
mod sheets;
pub mod sources;
pub mod subjects;
mod tables;
pub mod test_files;
pub mod words;

use crate::case::Outcome;
use crate::numbers;
use case_page::Context;
use provenance::Provenance;
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};

/// Reason why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file or folder could not be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// Path of the file or folder.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
    /// The list of numbers could not be read.
    #[error("verification/numbers.toml: {0}")]
    Numbers(String),
    /// A result could not be encoded.
    #[error("cannot encode a result: {0}")]
    Encode(#[from] serde_json::Error),
}

/// Writes the whole report into `folder`, replacing the pages of an earlier report.
///
/// # Errors
/// If a file cannot be written.
pub fn write(folder: &Path, outcomes: &[Outcome], run: &Provenance) -> Result<(), ReportError> {
    let (pages, sources) = (emptied(folder, "cases")?, emptied(folder, "sources")?);
    let releases = history::releases(&history::folder());
    let groups = test_files::groups();
    let numbers = numbers::all().map_err(ReportError::Numbers)?;
    put(&folder.join("report.json"), &text(&json::report(outcomes, run))?)?;
    put(&folder.join("index.html"), &index::whole(outcomes, &releases, run))?;
    put(&folder.join("coverage.html"), &coverage::whole(outcomes, (&groups, &numbers), run))?;
    put(&folder.join("precision.html"), &precision::whole(outcomes, run))?;
    put(&folder.join("defects.html"), &defects::whole(&defects::Defects::read(), run))?;
    put(&folder.join("history.html"), &history::whole(&releases, outcomes, run))?;
    put(&folder.join("tests.html"), &test_files::whole(&groups, run))?;
    put(&folder.join("words.html"), &words::whole(run))?;
    for (k, outcome) in outcomes.iter().enumerate() {
        let name = outcome.case.name;
        let at = |k: usize| outcomes.get(k).map(|outcome| outcome.case.name);
        let neighbours = [k.checked_sub(1).and_then(at), at(k + 1)];
        let files = sources::files(&outcome.case);
        let context = Context { neighbours, files: &files, releases: &releases, run };
        put(&pages.join(format!("{name}.html")), &case_page::whole(outcome, context))?;
        for sheet in &outcome.record.sheets {
            put(&pages.join(sheets::address(name, sheet)), &sheets::whole(name, sheet, run))?;
        }
        put(&pages.join(format!("{name}.json")), &text(&json::case(outcome))?)?;
        put(&sources.join(format!("{name}.html")), &sources::whole(&outcome.case, &files, run))?;
    }
    Ok(())
}

/// Writes a file of the history.
///
/// # Errors
/// If it cannot be written.
pub fn keep(path: &Path, tag: &str, outcomes: &[Outcome], run: &Provenance) -> Result<(), ReportError> {
    let earlier = fs::read_to_string(path).ok().and_then(|text| serde_json::from_str(&text).ok());
    put(path, &history::Release::from_outcomes(tag, outcomes, run, earlier).text()?)
}

fn text(value: &impl Serialize) -> Result<String, ReportError> {
    Ok(serde_json::to_string_pretty(value)?)
}

/// Creates or empties a folder inside a folder.
fn emptied(folder: &Path, name: &str) -> Result<PathBuf, ReportError> {
    let path = folder.join(name);
    let fault = |source| ReportError::Write { path: path.clone(), source };
    if path.exists() {
        fs::remove_dir_all(&path).map_err(fault)?;
    }
    fs::create_dir_all(&path).map_err(fault)?;
    Ok(path)
}

/// Writes a file and creates its parent folders.
///
/// # Errors
/// If it cannot be written.
pub fn put(path: &Path, text: &str) -> Result<(), ReportError> {
    let fault = |source| ReportError::Write { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(fault)?;
    }
    fs::write(path, text).map_err(fault)
}
