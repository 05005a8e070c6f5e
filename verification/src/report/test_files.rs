//! Tests of the workspace that are evidence where cases cannot make claims: the scene reader, files, other programs.

use super::page::{Depth, escape, page};
use super::provenance::Provenance;
use crate::capability::Capability;
use std::path::{Path, PathBuf};

/// Files with tests that are evidence for a capability, by path prefix.
const GROUPS: [(Capability, &[&str]); 3] = [
    (
        Capability::Scenes,
        &[
            "crates/scene/src/",
            "crates/asperity/tests/all/doubtful_scenes.rs",
            "crates/asperity/tests/all/key_tables.rs",
            "crates/asperity/tests/all/law_tables.rs",
            "crates/asperity/tests/all/messages.rs",
            "crates/asperity/tests/all/names.rs",
            "crates/asperity/tests/all/samples.rs",
            "crates/asperity/tests/all/scene_schema.rs",
            "crates/asperity/tests/all/scenes.rs",
        ],
    ),
    (
        Capability::Outputs,
        &[
            "crates/output/src/",
            "crates/asperity/tests/all/column_tables.rs",
            "crates/asperity/tests/all/directories.rs",
            "crates/asperity/tests/all/fault_outputs.rs",
            "crates/asperity/tests/all/report_schema.rs",
            "crates/asperity/tests/all/resume",
            "crates/asperity/tests/all/signs.rs",
            "crates/asperity/tests/all/slider_outputs.rs",
            "crates/asperity/tests/all/snapshot.rs",
        ],
    ),
    (Capability::Interop, &["interop/", "crates/asperity/tests/all/mesh"]),
];

/// A file with the names of its tests as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TestFile {
    /// Path in the repository.
    pub path: String,
    /// Names of the tests as text.
    pub tests: Vec<String>,
}

/// Tests that are evidence for a capability.
#[derive(Clone, Debug)]
pub struct Group {
    /// The capability.
    pub capability: Capability,
    /// Files with tests.
    pub files: Vec<TestFile>,
}

impl Group {
    /// Number of tests.
    pub fn count(&self) -> usize {
        self.files.iter().map(|file| file.tests.len()).sum()
    }
}

/// Reads the tests from the sources, if these are available.
pub fn groups() -> Vec<Group> {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = package.parent().unwrap_or(package);
    let mut paths = Vec::new();
    for folder in ["crates", "interop"] {
        walk(&root.join(folder), &mut paths);
    }
    paths.sort();
    let named: Vec<(String, PathBuf)> = paths
        .into_iter()
        .filter_map(|path| Some((path.strip_prefix(root).ok()?.display().to_string(), path)))
        .collect();
    GROUPS.iter().map(|&(capability, starts)| group(capability, starts, &named)).collect()
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            walk(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs" || end == "py") {
            found.push(path);
        }
    }
}

fn group(capability: Capability, starts: &[&str], paths: &[(String, PathBuf)]) -> Group {
    let chosen = paths.iter().filter(|(name, _)| starts.iter().any(|start| name.starts_with(start)));
    let tested = |(name, path): &(String, PathBuf)| {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let tests = if name.ends_with(".py") { checks(&text) } else { tests(&text) };
        (!tests.is_empty()).then(|| TestFile { path: name.clone(), tests })
    };
    Group { capability, files: chosen.filter_map(tested).collect() }
}

/// Names of the tests of a Rust file, as text.
pub fn tests(text: &str) -> Vec<String> {
    let name = |part: &str| {
        let (_, rest) = part.split_once("fn ")?;
        Some(words(rest.split('(').next()?))
    };
    text.split("#[test]").skip(1).filter_map(name).collect()
}

/// Names of the checks of a Python file, as text.
pub fn checks(text: &str) -> Vec<String> {
    let names = text.lines().filter_map(|line| line.strip_prefix("def check_"));
    names.filter_map(|rest| rest.split('(').next()).map(|name| format!("check of {}", words(name))).collect()
}

fn words(name: &str) -> String {
    name.trim().split('_').collect::<Vec<_>>().join(" ")
}

/// The page of all tests.
pub fn whole(groups: &[Group], run: &Provenance) -> String {
    let state = if run.tested {
        "They passed just before this run: <code>cargo xtask verify</code> stops where one fails."
    } else {
        "They were not run with this report. <code>cargo xtask verify</code> runs them before the cases and stops \
         where one fails."
    };
    let mut body = format!(
        "<h1>Tests</h1>\n<p>Some capabilities cannot be compared with a solution: which scenes are refused, what \
         files hold. Tests of the workspace are the evidence for them. {state} <code>cargo xtask interop</code> \
         runs the checks by other programs.</p>\n"
    );
    for group in groups {
        let title = group.capability.title();
        body += &format!(
            "<h2 id=\"{}\">{}: {} tests</h2>\n",
            super::ids::slug(title),
            escape(title),
            group.count()
        );
        for file in &group.files {
            let tests: String =
                file.tests.iter().map(|test| format!("<li>{}</li>\n", escape(test))).collect();
            body += &format!(
                "<details><summary><code>{}</code>: {}</summary><ul>{tests}</ul></details>\n",
                escape(&file.path),
                file.tests.len()
            );
        }
    }
    page("Tests", Depth::Top, run, &body)
}
