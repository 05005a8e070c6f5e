//! Output directory of a run. It belongs to one run at a time, holds a report from the start, and nothing of any other run.

use super::begin::{Begin, LOCK, PAGE, REPORT, RESERVE, SCENE};
use super::contents::{self, Contents};
use super::json;
use super::page::{self, Texts};
use super::readme;
use crate::checkpoint;
use crate::forecast;
use crate::report::common::{Phases, Provenance, Report, Results, SCHEMA, Sketch, Status, commit};
use crate::setup::{self, Kept};
use asperity_output::atomic;
use asperity_output::plots::Sheet;
use miette::{IntoDiagnostic, WrapErr, miette};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Changes made to free the directory. They can be undone until the run begins to compute.
#[derive(Debug)]
enum Room {
    /// The directory is new; holds the topmost folder that was created for it.
    Made(PathBuf),
    /// The directory existed and was empty, or held a run that computed nothing.
    Found,
    /// Its contents were moved to the first path, and a directory already there to the second.
    Moved(PathBuf, Option<PathBuf>),
    /// It belongs to the run to be resumed; holds the report of that run.
    Kept(Option<Vec<u8>>),
    /// The run has begun to compute.
    Used,
}

/// Room that a run takes at its start and frees at its end \[bytes\]: the report of an end for want of room needs some.
const RESERVED: usize = 16_384;

/// Directory of a run in progress.
#[derive(Debug)]
pub(super) struct Directory {
    path: PathBuf,
    begin: Begin,
    /// The plan as printed; empty before the scene was planned.
    plan: String,
    /// Parts of the set-up that were read or kept.
    setup: Vec<Kept>,
    room: Room,
    /// Lock held for the duration of the run.
    _lock: Option<File>,
}

impl Directory {
    /// Makes `path` the directory of a run. A result of the same scene is moved to `<path>.previous`; anything else that may still be wanted is an
    /// error.
    ///
    /// # Errors
    /// Names the obstacle and a way to proceed.
    pub fn claim(path: &Path, begin: Begin) -> miette::Result<Self> {
        Contents::of(path)?.refuse(path, &begin)?;
        let made = topmost_missing(path);
        atomic::create_dir(path).into_diagnostic()?;
        let lock = lock(path)?;
        // Repeat the check, now that no other run can change the directory.
        let contents = Contents::of(path)?;
        contents.refuse(path, &begin)?;
        let room = match (contents, made) {
            (_, Some(made)) => Room::Made(made),
            (contents, None) if begin.resume && contents.has_checkpoint() => {
                Room::Kept(fs::read(path.join(REPORT)).ok())
            }
            (contents, None) if contents.holds_nothing() => Room::Found,
            _ => move_away(path)?,
        };
        let lock = if let Room::Moved(previous, _) = &room {
            atomic::create_dir(path).into_diagnostic()?;
            let lock = self::lock(path)?;
            // It is read again if it fits the scene as it is now.
            move_setup(previous, path).into_diagnostic()?;
            lock
        } else {
            lock
        };
        let (path, plan, setup) = (path.to_path_buf(), String::new(), Vec::new());
        let directory = Self { path, begin, plan, setup, room, _lock: lock };
        directory.sketch(Status::Running, None)?;
        Ok(directory)
    }

    /// The directory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Input of the run.
    pub fn begin(&self) -> &Begin {
        &self.begin
    }

    /// Marks the start of the computation: the scene and results exist from now on, and the directory set aside by moving the
    /// last result is removed.
    pub fn computes(&mut self) -> miette::Result<()> {
        atomic::write(&self.path.join(SCENE), self.begin.text.as_bytes()).into_diagnostic()?;
        atomic::write(&self.path.join(RESERVE), &[0; RESERVED]).into_diagnostic()?;
        self.hide();
        self.describe();
        match std::mem::replace(&mut self.room, Room::Used) {
            Room::Moved(_, Some(older)) => fs::remove_dir_all(&older)
                .into_diagnostic()
                .wrap_err_with(|| format!("cannot remove {}", older.display())),
            _ => Ok(()),
        }
    }

    /// Takes the parts of the set-up that were read or kept, for the report.
    pub fn keeps(&mut self, setup: Vec<Kept>) {
        self.setup = setup;
    }

    /// Takes the plan as printed, for the page of the run.
    pub fn planned(&mut self, plan: String) {
        self.plan = plan;
    }

    /// Writes the final report, with the hashes of the mesh files.
    pub fn write<P: Results>(&self, results: &P, meshes: &BTreeMap<String, String>) -> miette::Result<()> {
        self.release();
        let status = results.outcome().status();
        let text = self.report(status, Some(results.seconds()), Some(meshes), results)?;
        self.show(&text);
        self.describe();
        Ok(())
    }

    /// Frees the room kept for the report of the end.
    fn release(&self) {
        // There is none before the run computes.
        let _ = fs::remove_file(self.path.join(RESERVE));
    }

    /// Writes what each file is. It is no result: a run continues where it cannot be written.
    fn describe(&self) {
        let _ = readme::write(&self.path, &self.begin.title);
    }

    /// Removes the page of the part before and what its figures need, which would show the run as it was then.
    fn hide(&self) {
        // Usually there is none.
        for file in [PAGE, Sheet::FILE] {
            let _ = fs::remove_file(self.path.join(file));
        }
    }

    /// Writes the page of the run. It holds nothing that is not in other files: a run continues where it cannot be written.
    fn show(&self, report: &str) {
        let texts = Texts { plan: &self.plan, scene: &self.begin.text };
        if let Ok(report) = serde_json::from_str(report) {
            let _ = page::write(&self.path, &report, &texts);
        }
    }

    /// Writes a report, and returns its text.
    fn report(
        &self,
        status: Status,
        seconds: Option<Phases>,
        meshes_sha256: Option<&BTreeMap<String, String>>,
        results: impl Serialize,
    ) -> miette::Result<String> {
        let Begin { title, hash: scene_sha256, origin, kind, .. } = &self.begin;
        let (threads, peak_bytes) = (rayon::current_num_threads(), forecast::most_so_far());
        let report = Report {
            schema: SCHEMA,
            kind: *kind,
            status,
            title,
            version: env!("CARGO_PKG_VERSION"),
            scene_sha256,
            meshes_sha256,
            run: Provenance { seconds, threads, commit: commit(), peak_bytes, setup: &self.setup, origin },
            results,
        };
        let text = json::pretty(&report).into_diagnostic()?;
        atomic::write(&self.path.join(REPORT), text.as_bytes())
            .map_err(|e| miette!("cannot write the report: {e}"))?;
        Ok(text)
    }

    /// Cleans up after an error: undoes all changes if nothing was computed; otherwise the report records the error.
    pub fn fails(self, error: &miette::Report) {
        // A failure to clean up adds nothing to the error that is reported.
        let _ = match &self.room {
            Room::Used => {
                self.release();
                let resumable = self.path.join(checkpoint::FILE).exists();
                let status = if resumable { Status::Interrupted } else { Status::Stopped };
                self.sketch(status, Some(error.to_string()))
            }
            room => self.undo(room).into_diagnostic(),
        };
    }

    fn undo(&self, room: &Room) -> std::io::Result<()> {
        match room {
            Room::Kept(Some(report)) => return fs::write(self.path.join(REPORT), report),
            Room::Kept(None) => return fs::remove_file(self.path.join(REPORT)),
            Room::Used => return Ok(()),
            Room::Made(_) | Room::Found | Room::Moved(..) => {}
        }
        if contents::foreign(&self.path)?.is_some() {
            return Ok(());
        }
        if let Room::Moved(previous, _) = room {
            move_setup(&self.path, previous)?;
        } else if self.path.join(setup::FOLDER).exists() {
            // Computing it took long.
            return remove_files(&self.path);
        }
        fs::remove_dir_all(&self.path)?;
        match room {
            Room::Made(topmost) => remove_empty(&self.path, topmost),
            Room::Moved(previous, older) => {
                fs::rename(previous, &self.path)?;
                older.as_ref().map_or(Ok(()), |older| fs::rename(older, previous))
            }
            _ => fs::create_dir(&self.path),
        }
    }

    fn sketch(&self, status: Status, reason: Option<String>) -> miette::Result<()> {
        self.report(status, None, None, Sketch { reason }).map(|_| ())
    }
}

/// Topmost folder that must be created for this one; `None` if it exists.
fn topmost_missing(path: &Path) -> Option<PathBuf> {
    let missing = path.ancestors().filter(|p| !p.as_os_str().is_empty()).take_while(|p| !p.exists());
    missing.last().map(Path::to_path_buf)
}

/// Removes the empty parent folders of `path`, which no longer exists, up to `topmost`.
fn remove_empty(path: &Path, topmost: &Path) -> std::io::Result<()> {
    let mut made = path.ancestors().skip(1).take_while(|p| p.starts_with(topmost));
    made.try_for_each(fs::remove_dir)
}

/// Moves the set-up in a directory, if there is one, to another directory that has none.
fn move_setup(from: &Path, to: &Path) -> std::io::Result<()> {
    let [from, to] = [from, to].map(|folder| folder.join(setup::FOLDER));
    if from.exists() && !to.exists() { fs::rename(from, to) } else { Ok(()) }
}

/// Removes the files in a directory, but not its folders.
fn remove_files(path: &Path) -> std::io::Result<()> {
    for entry in fs::read_dir(path)? {
        let file = entry?.path();
        if !file.is_dir() {
            fs::remove_file(file)?;
        }
    }
    Ok(())
}

/// Locks a directory for this process; `None` if the system has no locks.
fn lock(path: &Path) -> miette::Result<Option<File>> {
    let name = path.join(LOCK);
    let file = File::options().create(true).append(true).open(&name);
    let file = file.into_diagnostic().wrap_err_with(|| format!("cannot write {}", name.display()))?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Err(miette!(
            "another run writes into {}: wait for its end, or choose another directory with --out",
            path.display()
        )),
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(None),
        Err(TryLockError::Error(error)) => {
            Err(error).into_diagnostic().wrap_err_with(|| format!("cannot lock {}", name.display()))
        }
    }
}

/// Moves a directory to `<name>.previous`. A directory of that name is kept as `<name>.previous.older` as long as the move may be undone.
fn move_away(path: &Path) -> miette::Result<Room> {
    // A link stays in place; its target is moved.
    let path = fs::canonicalize(path).into_diagnostic()?;
    let Some(name) = path.file_name() else {
        return Err(miette!("{} cannot be moved: choose another directory with --out", path.display()));
    };
    let beside = |end: &str| {
        let mut name = name.to_os_string();
        name.push(end);
        path.with_file_name(name)
    };
    let (previous, older) = (beside(".previous"), beside(".previous.older"));
    for kept in [&previous, &older] {
        if let Some(foreign) = contents::foreign(kept).into_diagnostic()? {
            return Err(miette!(
                "{} is not of a run, and the result before the last one would be replaced there: move it away",
                foreign.display()
            ));
        }
    }
    let rename = |from: &Path, to: &Path| {
        let told = || format!("cannot move {} to {}", from.display(), to.display());
        fs::rename(from, to).into_diagnostic().wrap_err_with(told)
    };
    if older.exists() {
        // Left by a run that was killed before it computed anything.
        fs::remove_dir_all(&older).into_diagnostic()?;
    }
    let older = previous.exists().then_some(older);
    if let Some(older) = &older {
        rename(&previous, older)?;
    }
    rename(&path, &previous)?;
    Ok(Room::Moved(previous, older))
}
