//! Checks that every listed case has the fixed shape.
#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_verification::{cases, readme};
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn every_folder_is_in_the_list_and_the_list_names_folders() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let folders: BTreeSet<String> = std::fs::read_dir(root)
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_type().unwrap().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    let names: BTreeSet<String> = cases::ALL.iter().map(|case| case.name.to_owned()).collect();
    assert_eq!(names, folders);
    assert_eq!(names.len(), cases::ALL.len(), "a name is twice in the list");
}

#[test]
fn every_case_has_the_fixed_headings_and_covers_something() {
    for case in cases::ALL {
        assert_eq!(readme::problems(case.readme), Vec::<String>::new(), "{}", case.name);
        assert!(!case.covers.is_empty(), "{} covers nothing", case.name);
    }
}

/// Table rows of these cases.
fn rows(names: &str) -> String {
    let row = |name: &str| {
        let case =
            cases::ALL.iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"));
        let title = case.readme.lines().next().unwrap().trim_start_matches("# ");
        let suite = if case.quick { "quick" } else { "full" };
        format!("| `{name}` | {title} | {suite} |\n")
    };
    names.split(' ').map(row).collect()
}

#[test]
fn the_book_lists_every_case_once() {
    const BEGIN: &str = "<!-- cases ";
    const END: &str = "<!-- end -->";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src/verification.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut parts = text.split(BEGIN);
    let (mut page, mut listed) = (parts.next().unwrap().to_owned(), Vec::new());
    for part in parts {
        let (names, rest) = part.split_once(" -->").unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        listed.extend(names.split(' '));
        page += &format!(
            "{BEGIN}{names} -->\n| case | subject | suite |\n|---|---|---|\n{}{END}{tail}",
            rows(names)
        );
    }
    let mut all: Vec<&str> = cases::ALL.iter().map(|case| case.name).collect();
    listed.sort_unstable();
    all.sort_unstable();
    assert_eq!(listed, all);
    if std::env::var_os("UPDATE_TABLES").is_some() {
        std::fs::write(&path, &page).unwrap();
    }
    assert!(
        std::fs::read_to_string(&path).unwrap() == page,
        "the list is stale: run the test with UPDATE_TABLES=1"
    );
}

/// Section "Literature" of a page.
fn literature(readme: &str) -> &str {
    readme.split_once("## Literature\n").map_or("", |(_, rest)| rest).trim()
}

/// Four-digit years: in parentheses, or else at the end of an entry.
fn years(text: &str) -> Vec<String> {
    let digits = |part: &&str| part.len() == 4 && part.bytes().all(|b| b.is_ascii_digit());
    text.split(['(', ')']).filter(digits).map(str::to_owned).collect()
}

#[test]
fn the_program_cites_the_literature_of_every_case() {
    use asperity_reference::cite;
    let names: BTreeSet<&str> = cite::names().collect();
    assert_eq!(names, cases::ALL.iter().map(|case| case.name).collect());
    for case in cases::ALL {
        let text = literature(case.readme).split_whitespace().collect::<Vec<_>>().join(" ");
        let keys = cite::keys(case.name).unwrap();
        let references: Vec<_> = keys.iter().map(|key| cite::reference(key).unwrap()).collect();
        let mut named: Vec<String> =
            references.iter().filter_map(|r| r.field("year")).map(str::to_owned).collect();
        for reference in references.iter().filter(|r| r.field("year").is_some()) {
            let author = reference.field("author").unwrap();
            let first = author.split(',').next().unwrap().trim_matches(['{', '}']);
            assert!(text.contains(first), "{}: {first} is not in its literature", case.name);
        }
        let mut given = years(&text);
        named.sort_unstable();
        given.sort_unstable();
        assert_eq!(named, given, "{}: years of the table and of its literature", case.name);
    }
}
