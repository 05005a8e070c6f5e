//! Descriptions of what is in files, as tables of text.

use std::collections::{BTreeMap, BTreeSet};

/// A part of a file that has a row where files are described: a column, or an array.
pub trait Row {
    /// Heads of the cells after that of the file.
    const HEAD: &'static str;
    /// True if all files of a folder are named together where they have the same parts.
    const TOGETHER: bool;

    /// Cells of the row: one for all parts and places.
    fn row(&self) -> String;
}

/// Parts of a file, such as its columns.
#[derive(Clone, Debug)]
pub struct FileParts<R> {
    /// Path below the folder of a run; `*` in it stands for any text.
    pub path: String,
    /// The parts.
    pub parts: Vec<R>,
}

impl<R> FileParts<R> {
    /// Parts of the file of this path.
    pub fn new(path: impl Into<String>, parts: Vec<R>) -> Self {
        Self { path: path.into(), parts }
    }
}

/// Description of the parts of files as a table of text: files of a folder with the same parts share their
/// rows.
#[must_use]
pub fn describe<R: Row>(all: &[FileParts<R>]) -> String {
    let mut groups: Vec<(Vec<String>, Vec<String>)> = Vec::new();
    let mut known: BTreeMap<Vec<String>, usize> = BTreeMap::new();
    for FileParts { path, parts } in all {
        let mut seen = BTreeSet::new();
        let mut lines: Vec<String> = parts.iter().map(Row::row).collect();
        lines.retain(|line| seen.insert(line.clone()));
        let group = *known.entry(lines).or_insert_with_key(|lines| {
            groups.push((Vec::new(), lines.clone()));
            groups.len() - 1
        });
        groups[group].0.push(path.clone());
    }
    let rule = "---|".repeat(R::HEAD.split('|').count());
    let mut text = format!("| file | {} |\n|---|{rule}\n", R::HEAD);
    let mut sizes: BTreeMap<&str, usize> = BTreeMap::new();
    for folder in all.iter().filter_map(|file| folder(&file.path)).filter(|_| R::TOGETHER) {
        *sizes.entry(folder).or_default() += 1;
    }
    for (paths, lines) in &groups {
        let files = files(paths, &sizes);
        for line in lines {
            text.push_str(&format!("| {files} | {line} |\n"));
        }
    }
    text
}

/// Folder of a path.
fn folder(path: &str) -> Option<&str> {
    path.rsplit_once('/').map(|(folder, _)| folder)
}

/// Names of these files, with `*` for all files of a folder together; `sizes` has the number of files in each.
fn files(paths: &[String], sizes: &BTreeMap<&str, usize>) -> String {
    let mut own: BTreeMap<&str, usize> = BTreeMap::new();
    for folder in paths.iter().filter_map(|path| folder(path)) {
        *own.entry(folder).or_default() += 1;
    }
    let name = |path: &String| match folder(path).filter(|folder| own.get(folder) == sizes.get(folder)) {
        Some(folder) => {
            let ending = path.rsplit_once('.').map_or(String::new(), |(_, ending)| format!(".{ending}"));
            format!("`{folder}/*{ending}`")
        }
        None => format!("`{path}`"),
    };
    let mut names: Vec<String> = paths.iter().map(name).collect();
    names.dedup();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::column::{Column, Sign, time};
    use super::{FileParts, describe};

    #[test]
    fn files_of_a_folder_with_the_same_columns_share_their_rows() {
        let part = |part| Column::new("u", "m", Sign::Axis, "moved").for_part(part);
        let moved = || vec![time(), part("a"), part("b")];
        let table = |path: &str, columns| FileParts::new(path, columns);
        let points = [table("points/a.csv", moved()), table("points/b.csv", moved())];
        let of_events = [table("events/u_*.csv", moved()), table("events/v_*.csv", vec![time()])];
        let expected = "| file | column | unit | sign | meaning |\n|---|---|---|---|---|\n\
            | `points/*.csv`, `events/u_*.csv` | `time` | s | none | time of the row |\n\
            | `points/*.csv`, `events/u_*.csv` | `u of *` | m | axis | moved |\n\
            | `events/v_*.csv` | `time` | s | none | time of the row |\n";
        assert_eq!(describe(&[&points[..], &of_events].concat()), expected);
    }
}
