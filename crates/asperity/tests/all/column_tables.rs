//! Tables of the columns of output files in the book, which are generated from what runs of the scenes in the reference say about their files.
#![allow(clippy::disallowed_methods)]

use crate::common::written::{Described, described};
use crate::documents::blocks;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const BEGIN: &str = "<!-- columns ";
const END: &str = "<!-- end -->";

fn book() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src")
}

/// A column as the page shows it.
fn shown(column: &Described) -> String {
    match (column.column.as_str(), column.unit.as_str()) {
        ("each point", _) => "one column per point, headed by its distance along the fault \\[m\\]".into(),
        (name, "" | "-") => format!("`{name}`"),
        (name, unit) => format!("`{name}` \\[{unit}\\]"),
    }
}

/// Rows for the output tables of the scene on a page of the reference.
fn rows(page: &str) -> String {
    let text = fs::read_to_string(book().join(format!("scene/{page}.md"))).unwrap();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), &blocks(&text, "toml")[0]).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let run = run.args(["run", "scene.toml", "--no-plots"]).current_dir(folder.path()).output().unwrap();
    assert!(run.status.success(), "{page}: {}", String::from_utf8_lossy(&run.stderr));
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for column in described(&folder.path().join("out/scene")) {
        let files: Vec<String> = column.files.iter().map(|file| format!("`{file}`")).collect();
        found.entry(files.join(", ")).or_default().push(shown(&column));
    }
    assert!(!found.is_empty(), "{page} leaves no tables");
    found.into_iter().map(|(files, columns)| format!("| {files} | {} |\n", columns.join(", "))).collect()
}

#[test]
fn the_tables_of_columns_are_those_of_the_program() {
    let path = book().join("outputs.md");
    let text = fs::read_to_string(&path).unwrap();
    let mut parts = text.split(BEGIN);
    let mut page = parts.next().unwrap().to_string();
    for part in parts {
        let (scenes, rest) = part.split_once(" -->").unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        let rows: String = scenes.split(' ').map(rows).collect();
        page += &format!("{BEGIN}{scenes} -->\n| file | columns |\n|---|---|\n{rows}{END}{tail}");
    }
    if std::env::var_os("UPDATE_TABLES").is_some() {
        fs::write(&path, &page).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap() == page,
        "a table is stale: run the test with UPDATE_TABLES=1"
    );
    assert_eq!(page.matches(BEGIN).count(), 3);
}
