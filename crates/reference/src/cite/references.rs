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
