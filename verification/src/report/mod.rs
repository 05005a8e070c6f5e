//! The report: `report.json` and the HTML pages, in one folder.

pub mod coverage;
pub mod html;
pub mod json;
pub mod provenance;
pub mod svg;

use crate::case::Outcome;
use provenance::Provenance;
use std::fs;
use std::path::{Path, PathBuf};

/// Reason why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file or folder.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// Reason.
        source: std::io::Error,
    },
    /// A plot.
    #[error("cannot draw the plot `{title}` of {case}: {source}")]
    Plot {
        /// Case.
        case: &'static str,
        /// Title of the plot.
        title: String,
        /// Reason.
        source: svg::SvgError,
    },
    /// Encoding.
    #[error("cannot encode report.json: {0}")]
    Encode(#[from] serde_json::Error),
}

/// Writes the whole report into `folder`, replacing the pages of an earlier one.
///
/// # Errors
/// If a file cannot be written or a plot not drawn.
pub fn write(folder: &Path, outcomes: &[Outcome], run: &Provenance) -> Result<(), ReportError> {
    let pages = folder.join("cases");
    if pages.exists() {
        fs::remove_dir_all(&pages).map_err(|source| ReportError::Write { path: pages.clone(), source })?;
    }
    fs::create_dir_all(&pages).map_err(|source| ReportError::Write { path: pages.clone(), source })?;
    put(&folder.join("report.json"), &serde_json::to_string_pretty(&json::report(outcomes, run))?)?;
    put(&folder.join("index.html"), &html::index(outcomes, run))?;
    for outcome in outcomes {
        let plots = drawings(outcome)?;
        put(&pages.join(format!("{}.html", outcome.case.name)), &html::case_page(outcome, &plots))?;
    }
    Ok(())
}

fn drawings(outcome: &Outcome) -> Result<Vec<String>, ReportError> {
    let draw = |plot| {
        svg::draw(plot).map_err(|source| ReportError::Plot {
            case: outcome.case.name,
            title: plot.title.clone(),
            source,
        })
    };
    outcome.record.plots.iter().map(draw).collect()
}

fn put(path: &Path, text: &str) -> Result<(), ReportError> {
    fs::write(path, text).map_err(|source| ReportError::Write { path: path.to_owned(), source })
}
