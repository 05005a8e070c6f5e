use asperity_reference::cite::references::*;
use biblatex::{Bibliography, ChunksExt};

#[test]
fn the_table_is_bibtex() {
    let parsed = Bibliography::parse(include_str!("../../../../reference/src/cite/references.bib")).unwrap();
    assert_eq!(parsed.len(), references().len());
    for entry in parsed.iter() {
        let has = |name: &str| entry.get(name).is_some_and(|v| !v.format_verbatim().is_empty());
        assert!(has("author") && has("title"), "{}", entry.key);
        // The documentation of one program has no year.
        assert!(has("year") || entry.key == "codeaster", "{}", entry.key);
        let needed = match entry.entry_type.to_string().as_str() {
            "article" => "journal",
            "book" => "publisher",
            "incollection" | "inproceedings" => "booktitle",
            _ => "title",
        };
        assert!(has(needed), "{} has no {needed}", entry.key);
    }
}

#[test]
fn fields_are_those_that_a_reader_of_bibtex_finds() {
    let parsed = Bibliography::parse(include_str!("../../../../reference/src/cite/references.bib")).unwrap();
    for reference in references() {
        let entry = parsed.get(reference.key).unwrap();
        let year = entry.get("year").map(|v| v.format_verbatim());
        assert_eq!(reference.field("year"), year.as_deref(), "{}", reference.key);
        let doi = entry.get("doi").map(|v| v.format_verbatim());
        assert_eq!(reference.field("doi"), doi.as_deref(), "{}", reference.key);
    }
}

#[test]
fn keys_are_unique_and_the_works_of_others_are_in_order() {
    let others = |r: &&Reference| !r.key.starts_with("asperity");
    let keys: Vec<&str> = references().iter().filter(others).map(|r| r.key).collect();
    assert!(keys.is_sorted_by(|a, b| a < b), "{keys:?}");
}

#[test]
fn the_program_is_cited_in_its_version() {
    let program = reference("asperity").unwrap();
    assert_eq!(program.field("version"), Some(env!("CARGO_PKG_VERSION")));
}
