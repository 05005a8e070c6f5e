//! The `asperity` program as a separate process.

use crate::CaseError;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// First argument that makes the suite's program act as `asperity`.
pub const NAME: &str = "asperity";
/// First argument that makes it run the scenes of several folders, one after the other. The name of the folder of results in each
/// follows, and the folders.
pub const IN_FOLDERS: &str = "asperity-in-folders";
/// Scene of such a folder.
pub const SCENE: &str = "scene.toml";

/// The command `asperity`, or the command `before` with `asperity` appended to its arguments.
///
/// # Errors
/// If the path of this program is not known.
pub fn asperity(before: &[&str]) -> Result<Command, CaseError> {
    acting_as(NAME, before)
}

/// Runs of the scenes of several folders in one process, `out` in each being that of results, after the command `before`.
///
/// # Errors
/// If the path of this program is not known.
pub fn in_folders(before: &[&str], out: &str, folders: &[PathBuf]) -> Result<Command, CaseError> {
    let mut command = acting_as(IN_FOLDERS, before)?;
    command.arg(out).args(folders);
    Ok(command)
}

fn acting_as(name: &str, before: &[&str]) -> Result<Command, CaseError> {
    let program = std::env::current_exe()?;
    let words = before.iter().map(OsStr::new).chain([program.as_os_str(), OsStr::new(name)]);
    let mut words = words.collect::<Vec<_>>().into_iter();
    let mut command = Command::new(words.next().ok_or("no program")?);
    command.args(words);
    Ok(command)
}

/// Runs a command to its end. Returns its exit code and output.
///
/// # Errors
/// If it cannot be started or exits with a code that is not among `codes`.
pub fn finished(command: &mut Command, codes: &[i32]) -> Result<Output, CaseError> {
    let output = command.output()?;
    match output.status.code() {
        Some(code) if codes.contains(&code) => Ok(output),
        _ => Err(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr)).into()),
    }
}

/// Contents of the files below a folder by relative path. The part `run` of `report.json`, which differs from run to run, is left
/// out, and so is the text of `report.html`.
///
/// # Errors
/// If a file cannot be read.
pub fn files(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, CaseError> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let mut bytes = std::fs::read(&path)?;
            if path.ends_with("report.json") {
                bytes = without_run(&bytes)?;
            } else if path.ends_with("report.html") {
                // It holds what is in the other files, and an estimate of memory, which depends on the number of threads.
                bytes.clear();
            }
            found.insert(path.strip_prefix(folder)?.to_path_buf(), bytes);
        }
    }
    Ok(found)
}

fn without_run(report: &[u8]) -> Result<Vec<u8>, CaseError> {
    let mut report: serde_json::Value = serde_json::from_slice(report)?;
    report.as_object_mut().and_then(|r| r.remove("run")).ok_or("the report has no part `run`")?;
    Ok(report.to_string().into_bytes())
}

/// Paths of the files of two folders that differ or are missing in one of them.
///
/// # Errors
/// If a file cannot be read.
pub fn differing(one: &Path, other: &Path) -> Result<Vec<PathBuf>, CaseError> {
    let (one, other) = (files(one)?, files(other)?);
    let names = one.keys().chain(other.keys().filter(|name| !one.contains_key(*name)));
    Ok(names.filter(|name| one.get(*name) != other.get(*name)).cloned().collect())
}
