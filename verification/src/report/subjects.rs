//! Subjects of the cases: the headings of the list of cases in the book.

/// The chapter of the book with the list of cases.
const CHAPTER: &str = include_str!("../../../docs/src/verification.md");

/// Subject of cases that are not listed in the chapter.
const OTHER: &str = "Other";

/// A subject and the names of its cases.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Subject {
    /// Heading.
    pub title: String,
    /// Names, in the order of the chapter.
    pub names: Vec<String>,
}

/// All subjects in the order of the chapter.
pub fn all() -> Vec<Subject> {
    parse(CHAPTER)
}

/// Subjects of a chapter in Markdown: the headings of its lists of cases.
pub fn parse(chapter: &str) -> Vec<Subject> {
    let (mut found, mut heading) = (Vec::new(), "");
    for line in chapter.lines() {
        if let Some(title) = line.strip_prefix("### ") {
            heading = title.trim();
        } else if let Some(rest) = line.strip_prefix("<!-- cases ") {
            let names = rest.trim_end_matches("-->").split_whitespace().map(str::to_owned).collect();
            found.push(Subject { title: heading.to_owned(), names });
        }
    }
    found
}

/// The subject of a case.
pub fn subject(subjects: &[Subject], name: &str) -> String {
    let found = subjects.iter().find(|s| s.names.iter().any(|n| n == name));
    found.map_or(OTHER, |s| s.title.as_str()).to_owned()
}
