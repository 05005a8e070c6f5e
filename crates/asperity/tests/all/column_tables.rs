//! Tables of the columns of output files in the book, which are generated from the files of the scenes in the reference.
#![allow(clippy::disallowed_methods)]

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

/// Names and units of a table's columns, each once: without positions, and with a single name for columns headed by a
/// number.
fn columns(table: &str) -> Vec<String> {
    let seas = table.lines().find(|line| line.starts_with("t slip"));
    let names: Vec<&str> = match seas {
        Some(line) => line.split(' ').collect(),
        None => table.lines().next().unwrap().split(',').collect(),
    };
    let mut found = Vec::new();
    for name in names {
        let (name, unit) = name.split_once(" [").unwrap_or((name, ""));
        let unit = unit.split(']').next().unwrap();
        let text = match (name.parse::<f64>(), unit) {
            (Ok(_), _) => "one column per point, headed by its distance along the fault \\[m\\]".to_string(),
            (_, "" | "-") => format!("`{name}`"),
            (_, unit) => format!("`{name}` \\[{unit}\\]"),
        };
        if !found.contains(&text) {
            found.push(text);
        }
    }
    found
}

/// Tables below a folder, by their names: those of one folder share a row.
fn tables(root: &Path, folder: &Path, found: &mut BTreeMap<String, Vec<String>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.strip_prefix(root).unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            tables(root, &path, found);
        } else if path.extension().is_some_and(|e| e == "csv") || folder.ends_with("stations") {
            let extension = path.extension().map_or(String::new(), |e| format!(".{}", e.to_string_lossy()));
            // Files of events are of several kinds, which their names say before the number of the event.
            let kind =
                name.strip_prefix("events/").map_or("", |file| file.split(char::is_numeric).next().unwrap());
            let name = name
                .split_once('/')
                .map_or(name.clone(), |(folder, _)| format!("{folder}/{kind}*{extension}"));
            let columns = columns(&fs::read_to_string(&path).unwrap());
            let earlier = found.insert(name.clone(), columns.clone());
            assert!(earlier.is_none_or(|earlier| earlier == columns), "{name} has several sets of columns");
        }
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
    let mut found = BTreeMap::new();
    let out = folder.path().join("out/scene");
    tables(&out, &out, &mut found);
    assert!(!found.is_empty(), "{page} leaves no tables");
    found.into_iter().map(|(name, columns)| format!("| `{name}` | {} |\n", columns.join(", "))).collect()
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
