//! Sources of a case: its program and its scenes, on a page that needs no network.

use super::page::{Depth, escape, page};
use super::provenance::Provenance;
use crate::case::Case;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

/// Files of one case, by their path in the repository.
pub type Files = BTreeMap<String, String>;

/// Reads the files of a case: its folder without the README, files shared with other cases, and scenes that they include. None if
/// the sources are not available.
pub fn files(case: &Case) -> Files {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = package.parent().unwrap_or(package);
    let folder = package.join("cases").join(case.name);
    let mut found = Files::new();
    let Ok(entries) = std::fs::read_dir(&folder) else { return found };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.file_name().is_some_and(|name| name != "README.md") {
            add(&mut found, root, &path);
        }
    }
    let programs: Vec<String> = found.values().cloned().collect();
    for helper in programs.iter().flat_map(|text| helpers(text)) {
        add(&mut found, root, &package.join("cases").join(format!("{helper}.rs")));
    }
    let shared = package.join("cases");
    let helping: Vec<String> = found.values().filter(|text| !programs.contains(text)).cloned().collect();
    for include in helping.iter().flat_map(|text| includes(text)) {
        add(&mut found, root, &plain(&shared.join(include)));
    }
    for include in programs.iter().flat_map(|text| includes(text)) {
        add(&mut found, root, &plain(&folder.join(include)));
    }
    found
}

fn add(files: &mut Files, root: &Path, path: &Path) {
    const LONGEST: usize = 400_000;
    let Ok(text) = std::fs::read_to_string(path) else { return };
    if let (Ok(name), true) = (path.strip_prefix(root), text.len() < LONGEST) {
        files.insert(name.display().to_string(), text);
    }
}

/// Paths of scenes that a program includes.
pub fn includes(program: &str) -> Vec<String> {
    let parts = program.split("include_str!(\"").skip(1);
    let paths = parts.filter_map(|part| part.split_once('"')).map(|(path, _)| path.to_owned());
    paths.filter(|path| path.ends_with(".toml")).collect()
}

/// Names of the shared files, beside the case folders, that a program uses.
fn helpers(program: &str) -> Vec<String> {
    let parts = ["super::", "cases::"].into_iter().flat_map(|path| program.split(path).skip(1));
    let name = |part: &str| part.chars().take_while(|c| c.is_ascii_lowercase() || *c == '_').collect();
    parts.map(name).filter(|name: &String| name.len() > 1).collect()
}

/// A path with `..` resolved.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                out.pop();
            }
            part => out.push(part),
        }
    }
    out
}

/// The page of a case's files.
pub fn whole(case: &Case, files: &Files, run: &Provenance) -> String {
    let name = case.name;
    let mut body = format!(
        "<p><a href=\"../cases/{name}.html\">the case</a></p>\n<h1>Sources of <code>{name}</code></h1>\n"
    );
    for (path, text) in files {
        let open = if path.ends_with(".toml") { " open" } else { "" };
        body += &format!(
            "<details id=\"{}\"{open}><summary><code>{}</code></summary><pre>{}</pre></details>\n",
            super::ids::slug(path),
            escape(path),
            escape(text)
        );
    }
    page(&format!("Sources of {name}"), Depth::Below, run, &body)
}
