//! Notices of the libraries that the program is built on: names, versions, licences and their texts.

use crate::stage::Failure;
use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, Package};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// Package whose dependencies are listed.
const PROGRAM: &str = "asperity";

/// Beginnings of the names of files with licences, in lower case.
const LICENCES: [&str; 4] = ["license", "licence", "copying", "notice"];

/// Prints the notices.
pub fn print(root: &Path) -> Result<(), Failure> {
    let metadata = MetadataCommand::new().manifest_path(root.join("Cargo.toml")).exec()?;
    let mut packages: Vec<&Package> = used(&metadata);
    packages.retain(|package| package.source.is_some());
    packages.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    let mut text = String::from("asperity is built on these libraries.\n\n");
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in packages {
        let title = format!("{} {}", package.name, package.version);
        let licence = package.license.as_deref().unwrap_or("see its text");
        text += &format!("{title}: {licence}, {}\n", package.repository.as_deref().unwrap_or("-"));
        for licence in licences(package) {
            texts.entry(licence).or_default().push(title.clone());
        }
    }
    for (licence, titles) in texts {
        text += &format!("\n{}\n{}\n\n{}\n", "-".repeat(72), titles.join(", "), licence.trim_end());
    }
    // A reader that has seen enough may close the pipe.
    let _ = io::stdout().lock().write_all(text.as_bytes());
    Ok(())
}

/// Packages that the program is built on, itself included.
fn used(metadata: &Metadata) -> Vec<&Package> {
    let nodes = metadata.resolve.iter().flat_map(|resolve| &resolve.nodes);
    let nodes: BTreeMap<_, _> = nodes.map(|node| (&node.id, node)).collect();
    let program = metadata.packages.iter().find(|package| package.name.as_str() == PROGRAM);
    let mut open: Vec<_> = program.iter().map(|package| &package.id).collect();
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        let needed = nodes.get(id).into_iter().flat_map(|node| &node.deps);
        let built = needed.filter(|dep| dep.dep_kinds.iter().any(|kind| kind.kind == DependencyKind::Normal));
        open.extend(built.map(|dep| &dep.pkg));
    }
    metadata.packages.iter().filter(|package| seen.contains(&package.id)).collect()
}

/// Texts of the licences in the folder of a package.
fn licences(package: &Package) -> Vec<String> {
    let folder = package.manifest_path.parent().map(|folder| folder.as_std_path().to_owned());
    let files = folder.and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
    let named = files.filter(|file| {
        let name = file.file_name().to_string_lossy().to_lowercase();
        LICENCES.iter().any(|begin| name.starts_with(begin))
    });
    let mut texts: Vec<String> = named.filter_map(|file| fs::read_to_string(file.path()).ok()).collect();
    texts.sort();
    texts
}
