//! The table of references, in BibTeX.

use std::sync::LazyLock;

/// An entry of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reference {
    /// Key.
    pub key: &'static str,
    /// The entry in BibTeX.
    pub text: &'static str,
}

impl Reference {
    /// Value of a field, without its outer braces.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<&'static str> {
        self.text.lines().find_map(|line| {
            let (key, value) = line.trim().split_once(" = {")?;
            (key == name).then(|| value.strip_suffix("},"))?
        })
    }
}

/// All references, in the order of the table.
#[must_use]
pub fn references() -> &'static [Reference] {
    static TABLE: LazyLock<Vec<Reference>> = LazyLock::new(|| {
        // Entries are separated by empty lines; what does not begin with @ is a remark.
        include_str!("references.bib").split("\n\n").filter_map(entry).collect()
    });
    &TABLE
}

/// The reference with a key.
#[must_use]
pub fn reference(key: &str) -> Option<Reference> {
    references().iter().find(|r| r.key == key).copied()
}

fn entry(text: &'static str) -> Option<Reference> {
    let text = text.trim();
    let (_, rest) = text.strip_prefix('@')?.split_once('{')?;
    let (key, _) = rest.split_once(',')?;
    Some(Reference { key, text })
}

#[cfg(test)]
mod tests {
    use super::*;
    use biblatex::{Bibliography, ChunksExt};

    #[test]
    fn the_table_is_bibtex() {
        let parsed = Bibliography::parse(include_str!("references.bib")).unwrap();
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
        let parsed = Bibliography::parse(include_str!("references.bib")).unwrap();
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
}
