//! `report.html` of an output directory: plan, checks, pictures, costs, energy and warnings of a run in one file that needs no other.

pub mod elements;

use super::begin::{PAGE, SCENE};
use super::entries;
use asperity_output::terminal::progress;
use asperity_output::{OutputError, atomic};
use elements::{escape, folded, section, table, value};
use serde_json::{Map, Value};
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// Bytes of pictures in the page; pictures beyond are linked. Browsers and mail programs become slow above some tens of megabytes.
const PICTURES: u64 = 20_000_000;

/// Beginning of lines that differ from run to run, as the part `run` of the report does.
pub const RUN: &str = "<!-- run -->";

/// Texts of a run beside its report.
pub struct Texts<'a> {
    /// The plan and its checks as printed.
    pub plan: &'a str,
    /// The scene as it was run.
    pub scene: &'a str,
}

/// Writes the page of a run with this report into its directory.
///
/// # Errors
/// If the file cannot be written.
pub fn write(folder: &Path, report: &Value, texts: &Texts<'_>) -> Result<(), OutputError> {
    atomic::write(&folder.join(PAGE), page(folder, report, texts).as_bytes())
}

/// The page; pictures and names of files are those of the directory.
#[must_use]
pub fn page(folder: &Path, report: &Value, texts: &Texts<'_>) -> String {
    let title = escape(text(report, "title"));
    let plan =
        if texts.plan.is_empty() { String::new() } else { format!("<pre>{}</pre>", escape(texts.plan)) };
    let sections = [
        section("Warnings", &warnings(report)),
        section("Pictures", &pictures(folder)),
        section("Events", &events(folder)),
        section("Energy", &value_at(report, "energy")),
        section("Balance of contact forces", &value_at(report, "balance")),
        section("Costs", &costs(report)),
        section("Plan and checks", &plan),
        section("Scene", &folded(SCENE, texts.scene)),
        section("Files", &files(folder)),
    ];
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>\n{}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{}\n{}</body>\n</html>\n",
        include_str!("style.css"),
        facts(report),
        sections.concat()
    )
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// Status, and where and how the run was made.
fn facts(report: &Value) -> String {
    let run = &report["run"];
    let mut html = format!(
        "{RUN}<p><strong>{}</strong>: a run of {} by asperity {} ({}), begun {}</p>",
        escape(text(report, "status")),
        escape(text(report, "kind")),
        escape(text(report, "version")),
        escape(text(run, "commit")),
        escape(text(run, "started")),
    );
    if let Some(outcome) = report["outcome"].as_object() {
        let _ = write!(html, "\n<p class=\"warning\">{}</p>", value(&Value::Object(outcome.clone())));
    }
    if let Some(reason) = report["reason"].as_str() {
        let _ = write!(html, "\n<p class=\"warning\">{}</p>", escape(reason));
    }
    html
}

fn warnings(report: &Value) -> String {
    let Some(list) = report["warnings"].as_array().filter(|list| !list.is_empty()) else {
        return String::new();
    };
    let one = |warning: &Value| {
        let line = warning["place"]["line"].as_u64().map_or(String::new(), |line| format!("line {line}: "));
        let help = text(warning, "help");
        let help = if help.is_empty() { String::new() } else { format!("; {}", escape(help)) };
        format!("<li>{line}<span class=\"warning\">{}</span>{help}</li>", escape(text(warning, "message")))
    };
    format!("<ul>{}</ul>", list.iter().map(one).collect::<String>())
}

/// The figures below `plots/`, by name; those beyond [`PICTURES`] as links.
fn pictures(folder: &Path) -> String {
    let mut names = names(&folder.join("plots"));
    names.retain(|name| name.ends_with(".svg"));
    let (mut html, mut room) = (String::new(), PICTURES);
    for name in names {
        let path = folder.join("plots").join(&name);
        let bytes = fs::metadata(&path).map_or(u64::MAX, |data| data.len());
        let shown = if bytes <= room { fs::read_to_string(&path).ok() } else { None };
        let stem = escape(name.trim_end_matches(".svg"));
        let link = format!("<a href=\"plots/{0}\">{stem}</a>", escape(&name));
        let Some(svg) = shown else {
            let _ = write!(html, "<figure><figcaption>{link}</figcaption></figure>");
            continue;
        };
        room -= bytes;
        let _ = writeln!(html, "<figure>{svg}<figcaption>{link}</figcaption></figure>");
    }
    if html.is_empty() { html } else { format!("<div class=\"pictures\">\n{html}</div>") }
}

/// The catalogue of events; empty without events.
fn events(folder: &Path) -> String {
    let mut reader = match csv::Reader::from_path(folder.join("events.csv")) {
        Ok(reader) => reader,
        Err(_) => return String::new(),
    };
    let head: Vec<String> = reader.headers().into_iter().flatten().map(str::to_owned).collect();
    let rows: Vec<Vec<String>> =
        reader.records().filter_map(Result::ok).map(|row| row.iter().map(cell).collect()).collect();
    if rows.is_empty() { String::new() } else { table(&head, &rows) }
}

/// A field of a table: numbers with few digits.
fn cell(field: &str) -> String {
    field.parse().map_or_else(|_| field.to_owned(), elements::number)
}

/// Counts, which do not differ from run to run, and times and memory, which do.
fn costs(report: &Value) -> String {
    // What differs from run to run is one line.
    let run: String = value_at(report, "run").lines().collect();
    format!("{}\n{RUN}{run}", value_at(report, "counts"))
}

/// Value of a key of a report; nothing where it is absent or empty.
fn value_at(report: &Value, key: &str) -> String {
    let found = &report[key];
    let empty = found.as_array().is_some_and(Vec::is_empty) || found.as_object().is_some_and(Map::is_empty);
    if found.is_null() || empty { String::new() } else { value(found) }
}

/// Files and folders of the directory with what they are.
fn files(folder: &Path) -> String {
    let row = |name: &String| {
        let meaning = entries::named(OsStr::new(name))?.meaning;
        let name = escape(name);
        Some(format!("<li><a href=\"{name}\">{name}</a>: {}</li>", escape(meaning)))
    };
    let names = names(folder);
    // The progress is there only while the run is under way.
    let shown = |name: &&String| !name.starts_with('.') && *name != progress::FILE;
    let rows: String = names.iter().filter(shown).filter_map(row).collect();
    format!("<ul>{rows}</ul>")
}

/// Names of the entries of a folder, sorted; none if it cannot be read.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
    let mut names: Vec<String> = entries.filter_map(|e| e.file_name().into_string().ok()).collect();
    names.sort();
    names
}
