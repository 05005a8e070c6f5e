//! Files of a benchmark that are derived from its reference values and results.

use crate::CaseError;
use asperity_reference::benchmark::{Judgement, Reference, Submission};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// Marks that delimit the generated parts of a page.
const VALUES: [&str; 2] = ["<!-- values -->\n", "<!-- end of values -->\n"];
/// See [`VALUES`].
const RESULTS: [&str; 2] = ["<!-- results -->\n", "<!-- end of results -->\n"];

/// A derived file and its expected contents.
pub struct DerivedFile {
    /// Path.
    pub path: PathBuf,
    /// Text.
    pub text: String,
}

/// Derived files in the folder of a benchmark: tables of values, the template, the generated parts of the page.
///
/// # Errors
/// If a file cannot be read.
pub fn derived(folder: &Path) -> Result<Vec<DerivedFile>, CaseError> {
    let reference: Reference = serde_json::from_str(&read(&folder.join("reference.json"))?)?;
    let page = folder.join("README.md");
    let text = replaced(&read(&page)?, VALUES, &values(&reference))?;
    let text = replaced(&text, RESULTS, &results(folder, &reference)?)?;
    Ok(vec![
        DerivedFile { path: folder.join("reference.csv"), text: reference.csv() },
        DerivedFile { path: folder.join("template.csv"), text: reference.template() },
        DerivedFile { path: page, text },
    ])
}

fn read(path: &Path) -> Result<String, CaseError> {
    fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// The text with the part between two marks replaced.
fn replaced(text: &str, marks: [&str; 2], part: &str) -> Result<String, CaseError> {
    let cut = text.split_once(marks[0]).and_then(|(head, rest)| Some((head, rest.split_once(marks[1])?.1)));
    let (head, tail) = cut.ok_or_else(|| format!("the page has no part {}", marks[0].trim()))?;
    Ok(format!("{head}{}{part}{}{tail}", marks[0], marks[1]))
}

fn values(reference: &Reference) -> String {
    let mut text = String::from(
        "| quantity | unit | at | value | uncertainty | tolerance |\n|---|---|---|---|---|---|\n",
    );
    for quantity in &reference.quantities {
        let optional = if quantity.required { "" } else { " (optional)" };
        for (k, place) in quantity.places.iter().enumerate() {
            let name = if k == 0 { format!("`{}`{optional}", quantity.name) } else { String::new() };
            let unit = if k == 0 { quantity.unit.as_str() } else { "" };
            let at = place.at.map_or(String::new(), |at| {
                let unit = quantity.along.as_ref().map_or("1", |a| a.unit.as_str());
                if unit == "1" { at.to_string() } else { format!("{at} {unit}") }
            });
            let _ = writeln!(
                text,
                "| {name} | {unit} | {at} | {} | {} | {} |",
                place.value, place.uncertainty, place.tolerance
            );
        }
    }
    text.push('\n');
    for quantity in &reference.quantities {
        let _ = writeln!(
            text,
            "- `{}`: {}. *Value*: {}. *Tolerance*: {}.",
            quantity.name, quantity.meaning, quantity.source, quantity.because
        );
    }
    wrapped(&text)
}

/// Table of the results in the folder `results`.
fn results(folder: &Path, reference: &Reference) -> Result<String, CaseError> {
    let mut files: Vec<PathBuf> =
        fs::read_dir(folder.join("results"))?.map(|e| Ok(e?.path())).collect::<std::io::Result<_>>()?;
    files.retain(|path| path.extension().is_some_and(|e| e == "csv"));
    files.sort();
    let mut text = String::from(
        "| result | code | method | discretisation | required quantities that agree | largest difference over tolerance |\n\
         |---|---|---|---|---|---|\n",
    );
    for path in files {
        let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
        let result = Submission::read(&fs::read(&path)?, reference).map_err(|e| format!("{name}:{e}"))?;
        let judgement = Judgement::new(reference, &result);
        let (agree, all) = judgement.required();
        let says = |key: &str| result.says(key).unwrap_or_default().to_string();
        let _ = writeln!(
            text,
            "| [{name}](results/{name}) | {} | {} | {} | {agree} of {all} | {:.2} |",
            says("code"),
            says("method"),
            says("discretisation"),
            judgement.largest().unwrap_or(f64::NAN)
        );
    }
    Ok(text)
}

/// Longest line of a page outside of tables.
const WIDTH: usize = 100;

/// The text with long lines wrapped, except in tables.
fn wrapped(text: &str) -> String {
    let mut out = String::new();
    for line in text.lines() {
        if line.starts_with('|') {
            out += line;
            out.push('\n');
            continue;
        }
        let mut length = 0;
        for word in line.split(' ') {
            let n = word.chars().count();
            if length > 0 && length + 1 + n > WIDTH {
                out += "\n  ";
                length = 2;
            } else if length > 0 {
                out.push(' ');
                length += 1;
            }
            out += word;
            length += n;
        }
        out.push('\n');
    }
    out
}
