//! The tree that a result belongs to: its hash, and those of the files that a defect touches.

use super::definition::{Defect, FOLDER};
use crate::stage::Failure;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Digits of a hash that are kept.
const DIGITS: usize = 12;

/// Hash of the committed tree.
pub fn hash(root: &Path) -> Result<String, Failure> {
    Ok(git(root, &["rev-parse", "HEAD^{tree}"])?.chars().take(DIGITS).collect())
}

/// Hashes of the contents of the files that a defect touches, by their paths: those that it changes, and its definition.
pub fn files(root: &Path, defect: &Defect) -> Result<BTreeMap<String, String>, Failure> {
    let mut paths: Vec<String> = defect.change.iter().map(|change| change.file.clone()).collect();
    paths.push(format!("{FOLDER}/{}.toml", defect.name));
    paths.sort();
    paths.dedup();
    let mut arguments = vec!["hash-object", "--"];
    arguments.extend(paths.iter().map(String::as_str));
    let hashes = git(root, &arguments)?;
    let short = |hash: &str| hash.chars().take(DIGITS).collect();
    Ok(paths.iter().cloned().zip(hashes.lines().map(short)).collect())
}

fn git(root: &Path, arguments: &[&str]) -> Result<String, Failure> {
    let output = Command::new("git").current_dir(root).args(arguments).output();
    let output = output.map_err(|source| Failure::Start { program: "git".into(), source })?;
    if !output.status.success() {
        return Err(Failure::Stage { stage: arguments.join(" "), code: output.status.code() });
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
