//! Rules about the documents: line width, targets of links, the list of cases, pages in the table of contents.

use super::problem::Problem;
use super::tree::File;

/// Columns of a line of prose, which fit side by side in a diff or terminal.
const COLUMNS: usize = 100;
/// Sources of the book.
const BOOK: &str = "docs/src/";
/// The page that lists the cases.
const CASES: &str = "docs/src/verification.md";
/// The table of contents.
const SUMMARY: &str = "docs/src/SUMMARY.md";

/// Checks the documents; `exists` tells whether a path exists that is not a text file, such as a picture.
pub fn check(files: &[File], exists: &dyn Fn(&str) -> bool) -> Vec<Problem> {
    let mut found = Vec::new();
    for file in files.iter().filter(|file| file.path.ends_with(".md")) {
        found.extend(wide(file));
        found.extend(links(file, files, exists));
    }
    found.extend(unlisted_cases(files));
    found.extend(unlisted_pages(files));
    found
}

fn is_case(path: &str) -> bool {
    path.starts_with("verification/cases/") && path.ends_with("/README.md")
}

/// Lines outside code, with their numbers from 1.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fenced = false;
    text.lines().enumerate().filter_map(move |(number, line)| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        (!fenced && !fence).then_some((number + 1, line))
    })
}

fn wide(file: &File) -> Vec<Problem> {
    let mut found = Vec::new();
    for (number, line) in prose(&file.text) {
        let columns = line.chars().count();
        // Tables, markers of generated text and addresses of links cannot be wrapped.
        let breakable =
            !line.trim_start().starts_with(['|', '<']) && !line.contains("](") && !line.contains("://");
        if breakable && columns > COLUMNS {
            let message = format!("{columns} columns: break the line at {COLUMNS}");
            found.push(Problem::new(&file.path, number, message));
        }
    }
    found
}

fn links(file: &File, files: &[File], exists: &dyn Fn(&str) -> bool) -> Vec<Problem> {
    let mut found = Vec::new();
    for (number, line) in prose(&file.text) {
        for target in targets(line) {
            let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
            let path = if path.is_empty() { file.path.clone() } else { resolve(&file.path, path) };
            let page = files.iter().find(|other| other.path == path);
            if page.is_none() && !exists(&path) {
                found.push(Problem::new(&file.path, number, format!("the link {target} leads to no file")));
            } else if !anchor.is_empty() && !page.is_some_and(|page| headings(page).any(|h| h == anchor)) {
                let message = format!("the link {target} leads to no heading of {path}");
                found.push(Problem::new(&file.path, number, message));
            }
        }
    }
    found
}

/// Relative targets of the links in a line.
fn targets(line: &str) -> impl Iterator<Item = &str> {
    line.split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'))
        .map(|(target, _)| target)
        .filter(|target| !target.contains("://") && !target.starts_with("mailto:"))
}

/// The path of a link seen from a file.
fn resolve(from: &str, link: &str) -> String {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in link.split('/') {
        match part {
            "." => {}
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Anchors of a page, as mdBook and GitHub make them of headings.
fn headings(file: &File) -> impl Iterator<Item = String> {
    prose(&file.text).filter_map(|(_, line)| line.strip_prefix('#')).map(|line| {
        let kept = line.trim_start_matches('#').trim().chars();
        kept.filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'))
            .map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() })
            .collect()
    })
}

fn unlisted_cases(files: &[File]) -> Vec<Problem> {
    let Some(page) = files.iter().find(|file| file.path == CASES) else { return Vec::new() };
    let cases =
        files.iter().filter(|file| is_case(&file.path)).filter_map(|file| file.path.split('/').nth(2));
    let missing = cases.filter(|case| !page.text.contains(&format!("`{case}`")));
    missing.map(|case| Problem::new(CASES, 0, format!("the case `{case}` is not listed"))).collect()
}

fn unlisted_pages(files: &[File]) -> Vec<Problem> {
    let Some(summary) = files.iter().find(|file| file.path == SUMMARY) else { return Vec::new() };
    let pages =
        files.iter().filter_map(|file| file.path.strip_prefix(BOOK)).filter(|page| page.ends_with(".md"));
    let missing = pages.filter(|page| *page != "SUMMARY.md" && !summary.text.contains(&format!("({page})")));
    missing.map(|page| Problem::new(SUMMARY, 0, format!("the page {page} is not in the contents"))).collect()
}

#[cfg(test)]
mod tests {
    use super::{File, check};

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let files: Vec<File> = files
            .iter()
            .map(|(path, text)| File { path: (*path).to_owned(), text: (*text).to_owned() })
            .collect();
        check(&files, &|path| path == "docs/src/images/a.png").iter().map(ToString::to_string).collect()
    }

    #[test]
    fn wide_lines_are_caught_outside_tables_and_code() {
        let wide = "word ".repeat(20) + "w";
        let text = format!("{wide}\n\n| {wide} |\n\n```\n{wide}\n```\n{}\n", &wide[2..]);
        let found = found(&[("docs/src/a.md", &text)]);
        assert_eq!(found, ["docs/src/a.md:1: 101 columns: break the line at 100"]);
    }

    #[test]
    fn links_that_lead_nowhere_are_caught() {
        let text = "[b](b/c.md#two-words-) [c](b/d.md) [d](b/c.md#three) ![e](images/a.png) [f](https://g)\n";
        let found =
            found(&[("docs/src/a.md", text), ("docs/src/b/c.md", "# Two *words* `+`\n[a](../a.md)\n")]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].contains("b/d.md leads to no file"));
        assert!(found[1].contains("b/c.md#three leads to no heading"));
    }

    #[test]
    fn cases_and_pages_that_are_not_listed_are_caught() {
        let found = found(&[
            ("docs/src/SUMMARY.md", "[v](verification.md)\n"),
            ("docs/src/theory.md", ""),
            ("docs/src/verification.md", "| `one` |\n"),
            ("verification/cases/one/README.md", ""),
            ("verification/cases/two/README.md", ""),
        ]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].contains("`two`") && found[1].contains("theory.md"));
    }
}
