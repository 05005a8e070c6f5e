//! Files that are missing where a scene looks for them.

use asperity_scene::suggestions::{closest, suggest};
use std::io;
use std::path::Path;

/// Largest number of files that a message lists: a line of them.
const MOST: usize = 6;

/// Files of one kind.
#[derive(Clone, Copy)]
pub(crate) struct FileKind {
    /// The kind in words, in the plural.
    pub what: &'static str,
    pub extensions: &'static [&'static str],
}

/// Reason why a file cannot be read, and help: what lies where it is looked for, or what keeps it from being read.
pub(crate) fn unread(path: &Path, error: &io::Error, kind: FileKind) -> (String, String) {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    if path.is_dir() {
        let help = format!("{} is a folder: name a file in it", whole.display());
        return ("it is a folder".into(), help);
    }
    match error.kind() {
        io::ErrorKind::NotFound => (error.to_string(), looked_for(path, kind)),
        io::ErrorKind::PermissionDenied => (
            error.to_string(),
            format!("{} is there, and may not be read: see its permissions", whole.display()),
        ),
        _ => (error.to_string(), format!("{} is there, and reading it fails", whole.display())),
    }
}

/// Path of a missing file, and the files of its kind found there instead.
fn looked_for(path: &Path, FileKind { what, extensions }: FileKind) -> String {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let told =
        format!("looked for {}; paths are relative to the folder of the scene. There", whole.display());
    let name = whole.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let Some(entries) = whole.parent().and_then(|folder| std::fs::read_dir(folder).ok()) else {
        return format!("{told} is no folder that can be read");
    };
    let mut there: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|p| p.is_file() && p.extension().is_some_and(|e| extensions.iter().any(|m| e == *m)))
        .filter_map(|p| Some(p.file_name()?.to_string_lossy().into_owned()))
        .collect();
    there.sort();
    if there.is_empty() {
        return format!("{told} are no {what}");
    }
    let there: Vec<&str> = there.iter().map(String::as_str).collect();
    let listed = closest(&name, &there, MOST);
    let more = there.len() - listed.len();
    let rest = if more > 0 { format!(", and {more} more") } else { String::new() };
    format!("{told}: {}{rest}", suggest(&name, what, listed))
}
