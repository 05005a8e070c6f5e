//! Contents of an output directory, and the check that a run may begin there.

use super::begin::{Begin, LOCK, REPORT, SCENE};
use super::{entries, full, inputs};
use crate::checkpoint;
use asperity_plan::shared::setup;
use asperity_run::report::Status;
use miette::{IntoDiagnostic, WrapErr, miette};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Files and folders in a directory that the end of a run has written about its state then.
pub(super) fn end_files(path: &Path) -> std::io::Result<Vec<PathBuf>> {
    let of_an_end = |name: &OsStr| entries::named(name).is_some_and(|entry| entry.of_an_end);
    let entries = fs::read_dir(path)?.map(|entry| Ok(entry?.path()));
    let entries = entries.filter(|entry: &std::io::Result<PathBuf>| {
        entry.as_ref().map_or(true, |path| path.file_name().is_some_and(of_an_end))
    });
    entries.collect()
}

/// First entry of a directory that no run writes; `None` if there is none or the directory does not exist.
pub(super) fn foreign(path: &Path) -> std::io::Result<Option<PathBuf>> {
    let scene = || fs::read_to_string(path.join(SCENE)).unwrap_or_default();
    foreign_in(path, |name, entry| {
        if name == inputs::FOLDER && entry.is_dir() {
            let named = scene();
            return foreign_in(entry, |name, file| {
                let ours = file.is_file() && inputs::names(&named, name);
                Ok((!ours && !temporary(name)).then(|| file.to_path_buf()))
            });
        }
        let known = entries::named(name).filter(|known| known.endings.is_some() == entry.is_dir());
        let Some(known) = known else {
            return Ok((entry.is_dir() || !temporary(name)).then(|| entry.to_path_buf()));
        };
        if !entry.is_dir() {
            return Ok(None);
        }
        foreign_in(entry, |name, file| {
            let ours = file.is_file() && known.holds(name);
            Ok((!ours && !temporary(name)).then(|| file.to_path_buf()))
        })
    })
}

/// True for a temporary file, left by a run that was killed while writing.
fn temporary(name: &OsStr) -> bool {
    name.to_str().is_some_and(|name| name.starts_with('.') && name.ends_with(".tmp"))
}

/// First entry of a folder, by name, that `judge` finds foreign.
fn foreign_in(
    folder: &Path,
    judge: impl Fn(&OsStr, &Path) -> std::io::Result<Option<PathBuf>>,
) -> std::io::Result<Option<PathBuf>> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(e),
    };
    let mut paths = entries.map(|e| Ok(e?.path())).collect::<std::io::Result<Vec<_>>>()?;
    paths.sort();
    for path in paths {
        if path.is_symlink() {
            return Ok(Some(path));
        }
        if let Some(found) = judge(path.file_name().unwrap_or_default(), &path)? {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Part of a report that identifies its run.
#[derive(Debug, Deserialize)]
struct Report {
    title: String,
    scene_sha256: String,
    #[serde(default)]
    meshes_sha256: BTreeMap<String, String>,
    /// Absent in reports of earlier versions, which were written only at the end.
    #[serde(default = "completed")]
    status: Status,
    /// Reason of an end by an error.
    reason: Option<String>,
    run: Run,
}

#[derive(Debug, Deserialize)]
struct Run {
    /// Absent in reports of earlier versions.
    scene: Option<String>,
}

fn completed() -> Status {
    Status::Completed
}

/// Contents of an output directory.
#[derive(Debug)]
pub(super) struct Contents {
    foreign: Option<PathBuf>,
    /// The report, if there is one.
    report: Option<Report>,
    /// True if there is a checkpoint to resume from.
    checkpoint: bool,
    /// True if there is nothing but a report, a lock file and a set-up.
    nothing: bool,
}

impl Contents {
    /// Contents of `path`.
    pub fn read(path: &Path) -> miette::Result<Self> {
        if path.exists() && !path.is_dir() {
            return Err(miette!("{} is a file, not an output directory", path.display()));
        }
        let told = || format!("cannot read the output directory {}", path.display());
        let mut foreign = foreign(path).into_diagnostic().wrap_err_with(told)?;
        let bytes = fs::read(path.join(REPORT)).ok();
        let report = bytes.as_ref().and_then(|bytes| serde_json::from_slice::<Report>(bytes).ok());
        if bytes.is_some() && report.is_none() {
            foreign = foreign.or_else(|| Some(path.join(REPORT)));
        }
        // A set-up is no result.
        let plain = |name: &OsStr| name == REPORT || name == LOCK || name == setup::FOLDER;
        let other = foreign_in(path, |name, entry| Ok((!plain(name)).then(|| entry.to_path_buf())));
        let nothing = other.into_diagnostic().wrap_err_with(told)?.is_none()
            && report.as_ref().is_none_or(|r| r.status != Status::Completed);
        Ok(Self { foreign, report, checkpoint: path.join(checkpoint::FILE).exists(), nothing })
    }

    /// True if there is a checkpoint to resume from.
    pub fn has_checkpoint(&self) -> bool {
        self.checkpoint
    }

    /// True if the directory holds no computed results.
    pub fn holds_nothing(&self) -> bool {
        self.nothing
    }

    /// True if the directory holds a run that found no room to write before its first checkpoint: it is no result, and cannot be resumed.
    pub fn lacked_room(&self) -> bool {
        let lacked = |reason: &String| reason.starts_with(full::REASON);
        let stopped = |r: &Report| r.status == Status::Stopped && r.reason.as_ref().is_some_and(lacked);
        !self.checkpoint && self.report.as_ref().is_some_and(stopped)
    }

    /// True if the directory holds a completed run of the scene and mesh files with these hashes.
    pub fn is_complete(&self, scene: &str, meshes: &BTreeMap<String, String>) -> bool {
        let same = |r: &Report| r.scene_sha256 == scene && r.meshes_sha256 == *meshes;
        !self.checkpoint && self.report.as_ref().is_some_and(|r| r.status == Status::Completed && same(r))
    }

    /// Refuses a run that would destroy results that may still be wanted.
    pub fn refuse(&self, path: &Path, begin: &Begin) -> miette::Result<()> {
        let (folder, path) = (path, path.display());
        if let Some(foreign) = &self.foreign {
            return Err(miette!(
                "{} is not of a run: a run is alone in its output directory; move it away, or choose another directory with --out",
                foreign.display()
            ));
        }
        let resumes = begin.resume && self.checkpoint;
        if !resumes && fs::canonicalize(folder).is_ok_and(|folder| begin.scene().starts_with(folder)) {
            return Err(miette!(
                "the scene lies in the output directory {path}, which a new run moves away: choose another directory with --out"
            ));
        }
        if self.nothing || begin.force || resumes {
            return Ok(());
        }
        let Some(report) = &self.report else {
            return Err(miette!(
                "{path} holds files of a run without its report: choose another directory with --out, or move them to {path}.previous with --force"
            ));
        };
        let file = report.run.scene.as_ref();
        let same = report.scene_sha256 == begin.hash
            || report.title == begin.title && file.is_none_or(|file| *file == begin.origin.scene);
        if !same {
            return Err(miette!(
                "{path} holds the result of another scene, \"{}\"{}: choose another directory with --out, or move it to {path}.previous with --force",
                report.title,
                file.map_or(String::new(), |file| format!(" of {file}"))
            ));
        }
        if self.checkpoint && matches!(report.status, Status::Running | Status::Interrupted) {
            return Err(miette!(
                "{path} holds an unfinished run with a checkpoint: resume it with --resume, or move it to {path}.previous with --force and begin again"
            ));
        }
        Ok(())
    }
}
