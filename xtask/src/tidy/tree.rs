//! The text files of the workspace.

use crate::stage::Failure;
use std::path::Path;
use walkdir::{DirEntry, WalkDir};

/// A text file.
pub struct File {
    /// Path relative to the workspace, with `/`.
    pub path: String,
    /// Contents.
    pub text: String,
}

/// Folders of results, at the top only: anywhere else such a name would hide sources.
const RESULTS: [&str; 2] = ["target", "out"];

/// Entries to skip at any depth; in a linked worktree `.git` is a file.
const FOREIGN: [&str; 4] = [".git", "__pycache__", ".venv", "book"];

/// All UTF-8 files outside the skipped folders, sorted by path.
pub fn files(root: &Path) -> Result<Vec<File>, Failure> {
    let mut files = Vec::new();
    let walk = WalkDir::new(root).sort_by_file_name();
    for entry in walk.into_iter().filter_entry(|entry| entry.depth() == 0 || !skipped(entry)) {
        let entry = entry?;
        if !entry.file_type().is_file() {
            continue;
        }
        let path = entry.path();
        let bytes = std::fs::read(path).map_err(|source| Failure::Read { path: path.to_owned(), source })?;
        // Fonts and pictures are not text, and no rule applies to them.
        if let Ok(text) = String::from_utf8(bytes) {
            files.push(File { path: relative(root, path), text });
        }
    }
    Ok(files)
}

fn skipped(entry: &DirEntry) -> bool {
    let name = entry.file_name().to_string_lossy();
    let results = entry.depth() == 1 && RESULTS.contains(&name.as_ref());
    FOREIGN.contains(&name.as_ref()) || entry.file_type().is_dir() && results
}

fn relative(root: &Path, path: &Path) -> String {
    let inside = path.strip_prefix(root).unwrap_or(path);
    inside.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}
