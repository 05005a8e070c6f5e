//! Files that are missing where a scene looks for them.

use asperity_scene::near::{closest, suggest};
use std::path::Path;

/// Largest number of files that a message lists: a line of them.
const MOST: usize = 6;

/// Path of a missing file, and the files of its kind found there instead.
pub(crate) fn looked_for(path: &Path, (what, extensions): (&str, &[&str])) -> String {
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
