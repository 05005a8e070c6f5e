//! Tables of the columns and arrays of output files in the book, with their signs, which are generated from what runs of every
//! kind say about their files.
#![allow(clippy::disallowed_methods)]

use crate::common::every_kind::{KINDS, files};
use crate::common::written::{ColumnDescription, fits};
use asperity::cli::entries;
use std::fs;
use std::path::Path;
use std::sync::Mutex;

const END: &str = "<!-- end -->";

/// Groups of values that have the same key, in the order in which keys first occur.
fn grouped<K: PartialEq, V: PartialEq>(pairs: impl Iterator<Item = (K, V)>) -> Vec<(K, Vec<V>)> {
    let mut groups: Vec<(K, Vec<V>)> = Vec::new();
    for (key, value) in pairs {
        match groups.iter_mut().find(|group| group.0 == key) {
            Some((_, values)) if values.contains(&value) => {}
            Some((_, values)) => values.push(value),
            None => groups.push((key, vec![value])),
        }
    }
    groups
}

/// Names in code, one after the other.
fn listed(names: &[String]) -> String {
    names.iter().map(|name| code(name)).collect::<Vec<_>>().join(", ")
}

fn code(name: &str) -> String {
    if name.starts_with("each ") { name.into() } else { format!("`{name}`") }
}

/// A column or an array as the page of outputs shows it, with its units in the plane and in space.
fn shown((column, array): &(&str, &Option<(usize, String)>), units: &[&str]) -> String {
    let head = match *column {
        "each point" => "one column per point, headed by its distance along the fault \\[m\\]",
        "each position" => "one column per position, headed by its x \\[m\\]",
        _ => "",
    };
    if !head.is_empty() {
        return head.into();
    }
    let units: Vec<&str> = units.iter().copied().filter(|unit| !matches!(*unit, "" | "-")).collect();
    let unit = if units.is_empty() { String::new() } else { format!(" \\[{}\\]", units.join(", ")) };
    let shape = match array {
        Some((1, at)) if at == "points" => "",
        Some((1, _)) => " (in cells)",
        Some((3, _)) => " (vectors)",
        Some((6, _)) => " (tensors, in cells)",
        _ => "",
    };
    format!("{}{unit}{shape}", code(column))
}

/// Each file with what a kind of run says of it.
fn by_file(kind: &str) -> impl Iterator<Item = (&'static str, &'static ColumnDescription)> {
    files(kind).iter().flat_map(|d| d.files.iter().map(move |file| (file.as_str(), d)))
}

/// Rows of a kind of run on the page of outputs.
fn columns(kind: &str) -> String {
    let whole = |(file, parts): (&'static str, Vec<&ColumnDescription>)| {
        let columns = grouped(parts.iter().map(|d| ((d.column.as_str(), &d.array), d.unit.as_str())));
        let columns: Vec<String> = columns.iter().map(|(column, units)| shown(column, units)).collect();
        (columns.join(", "), file.to_owned())
    };
    let mut files: Vec<(&'static str, Vec<&ColumnDescription>)> = grouped(by_file(kind));
    files.sort_by_key(|(file, _)| *file);
    let rows = grouped(files.into_iter().map(whole));
    let rows: String =
        rows.iter().map(|(columns, files)| format!("| {} | {columns} |\n", listed(files))).collect();
    format!("| file | columns or arrays |\n|---|---|\n{rows}")
}

/// Rows of a kind of run on the page of signs. A file whose name another pattern fits stands with that one.
fn signs(kind: &str) -> String {
    let names: Vec<&str> = by_file(kind).map(|(file, _)| file).collect();
    let name = |file: &'static str| {
        let wider = names.iter().filter(|other| fits(file, other));
        wider.min_by_key(|other| other.len()).copied().unwrap_or(file)
    };
    let all = by_file(kind).map(|(file, d)| ((name(file), d.sign.as_str()), d.column.clone()));
    let mut all = grouped(all);
    all.sort_by_key(|((file, _), _)| *file);
    let rows = grouped(all.into_iter().map(|((file, sign), columns)| ((sign, columns), file.to_owned())));
    let rows: String = rows
        .iter()
        .map(|((sign, columns), files)| format!("| {} | {} | {sign} |\n", listed(files), listed(columns)))
        .collect();
    format!("| file | columns or arrays | sign |\n|---|---|---|\n{rows}")
}

/// Rows of all files and folders that runs write, by their names; those of which users need not know are left out.
fn entries(_: &str) -> String {
    let hidden = |name: &str| name.starts_with('.') || name == "Thumbs.db";
    let mut all: Vec<_> = entries::all().iter().filter(|entry| !hidden(entry.name)).collect();
    all.sort_by_key(|entry| entry.name);
    let row = |entry: &&entries::Entry| {
        let slash = if entry.endings.is_some() { "/" } else { "" };
        format!("| `{}{slash}` | {} |\n", entry.name, entry.meaning)
    };
    format!("| file or folder | what it is |\n|---|---|\n{}", all.iter().map(row).collect::<String>())
}

/// Compares the tables of a page that begin with a comment of this name, one for each of these kinds of run, with these rows.
fn compare(page: &str, name: &str, kinds: &[&str], rows: fn(&str) -> String) {
    // Two tests may write the same page.
    static WRITING: Mutex<()> = Mutex::new(());
    let writing = WRITING.lock();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src").join(page);
    let (text, begin) = (fs::read_to_string(&path).unwrap(), format!("<!-- {name} "));
    let mut parts = text.split(&begin);
    let mut all = parts.next().unwrap().to_string();
    for part in parts {
        let (kind, rest) = part.split_once(" -->").unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        all += &format!("{begin}{kind} -->\n{}{END}{tail}", rows(kind));
    }
    if std::env::var_os("UPDATE_TABLES").is_some() {
        fs::write(&path, &all).unwrap();
    }
    let same = fs::read_to_string(&path).unwrap() == all;
    drop(writing);
    assert!(same, "a table of {page} is stale: run the test with UPDATE_TABLES=1");
    assert!(kinds.iter().all(|kind| all.contains(&format!("{begin}{kind} -->"))));
}

#[test]
fn the_tables_of_columns_are_those_of_the_program() {
    compare("outputs.md", "columns", &KINDS, columns);
}

#[test]
fn the_tables_of_signs_are_those_of_the_program() {
    compare("signs.md", "signs", &KINDS, signs);
}

#[test]
fn the_table_of_files_is_that_of_the_program() {
    compare("outputs.md", "files", &["all"], entries);
}
