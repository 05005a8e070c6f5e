//! Tables of keys in the scene reference, which are generated from the schema of scenes.
#![allow(clippy::disallowed_methods)]

use asperity_scene::keys;
use std::fs;
use std::path::Path;

const BEGIN: &str = "<!-- keys ";
const END: &str = "<!-- end -->";

/// Row of a key.
fn row(of: &str, key: &str) -> String {
    let row = keys::row(of, key).unwrap_or_else(|| panic!("{of} has no key {key}"));
    assert!(!row.text.is_empty(), "{key} of {of} has no description");
    let full = row.full();
    let text = full.split('|').collect::<Vec<_>>().join("\\|");
    format!("| `{}` | {} | {text} |\n", row.key, row.unit)
}

/// A page with the tables of the program.
fn written(text: &str) -> String {
    let mut parts = text.split(BEGIN);
    let mut page = parts.next().unwrap().to_string();
    for part in parts {
        let (head, rest) = part.split_once(" -->").unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        let (of, keys) = head.split_once(": ").unwrap();
        let rows: String = keys.split(' ').map(|key| row(of, key)).collect();
        page += &format!("{BEGIN}{head} -->\n| key | unit | |\n|---|---|---|\n{rows}{END}{tail}");
    }
    page
}

#[test]
fn the_tables_of_keys_are_those_of_the_program() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/scene");
    let mut tables = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let page = written(&text);
        if std::env::var_os("UPDATE_TABLES").is_some() {
            fs::write(&path, &page).unwrap();
        }
        let now = fs::read_to_string(&path).unwrap();
        assert!(now == page, "a table of {} is stale: run the test with UPDATE_TABLES=1", path.display());
        tables += text.matches(BEGIN).count();
    }
    assert!(tables > 15, "{tables} tables");
}
