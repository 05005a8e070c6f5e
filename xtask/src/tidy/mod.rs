//! Checks of the workspace that neither the compiler nor clippy makes. Every rule has a test with a text it must catch.

mod book;
mod circles;
mod defects;
mod docstrings;
mod features;
mod graph;
mod house;
mod keys;
mod lints;
mod locals;
mod names;
mod problem;
mod readers;
mod sentences;
mod source;
mod text;
mod tree;
mod unbuilt_tests;
mod variation;

use crate::stage::Failure;
use problem::Problem;
use std::path::Path;

/// All problems of the workspace, sorted by position.
pub fn check(root: &Path) -> Result<Vec<Problem>, Failure> {
    let mut found = graph::check(root)?;
    found.extend(features::check(root)?);
    let files = tree::files(root)?;
    for file in &files {
        found.extend(text::check(&file.path, &file.text));
        found.extend(sentences::check(file));
        if file.path.ends_with(".rs") {
            found.extend(source::check(&file.path, &file.text));
            found.extend(docstrings::check(&file.path, &file.text));
            found.extend(names::check(&file.path, &file.text));
            found.extend(locals::check(&file.path, &file.text));
        }
    }
    found.extend(house::check(&files));
    found.extend(keys::check(&files));
    found.extend(lints::check(&files));
    found.extend(book::check(&files, &|path| root.join(path).exists()));
    found.extend(circles::check(&files));
    found.extend(defects::check(&files));
    found.extend(readers::check(&files));
    found.extend(unbuilt_tests::check(&files));
    found.extend(variation::check(&files));
    found.sort();
    found.dedup();
    Ok(found)
}
