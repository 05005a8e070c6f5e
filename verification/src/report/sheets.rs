//! Pages of the parts of a case that have a page of their own.

use super::ids;
use super::page::{Depth, escape, page};
use super::provenance::Provenance;
use super::tables::free;
use crate::ledger::Sheet;

/// File name of a sheet's page, beside the page of its case.
pub fn address(case: &str, sheet: &Sheet) -> String {
    format!("{case}-{}.html", ids::slug(&sheet.title))
}

/// Links from the page of a case to its sheets.
pub fn links(case: &str, sheets: &[Sheet]) -> String {
    if sheets.is_empty() {
        return String::new();
    }
    let link = |sheet: &Sheet| {
        format!("<li><a href=\"{}\">{}</a></li>\n", address(case, sheet), escape(&sheet.title))
    };
    format!(
        "<h2 id=\"sheets\">A page for each scene</h2>\n<ul>\n{}</ul>\n",
        sheets.iter().map(link).collect::<String>()
    )
}

/// The page of a sheet.
pub fn whole(case: &str, sheet: &Sheet, run: &Provenance) -> String {
    let tables: String = sheet.tables.iter().map(free).collect();
    let body = format!(
        "<p class=\"links\"><a href=\"{case}.html\">{case}</a></p>\n<h1>{}</h1>\n{tables}<h2>The scene</h2>\n<pre>{}</pre>\n",
        escape(&sheet.title),
        escape(&sheet.scene)
    );
    page(&sheet.title, Depth::Below, run, &body)
}
