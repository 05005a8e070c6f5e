//! Output directory of a run. It belongs to one run at a time, holds a report from the start, and nothing of any other run.

use super::begin::{Begin, LOCK, PLOTS, REPORT, RESERVE, SCENE};
use super::contents::{self, Contents};
use super::end::End;
use super::lock::Lock;
use super::page::{self, Texts};
use super::{full, json, readme};
use crate::checkpoint;
use crate::report::{Results, commit};
use asperity_output::atomic;
use asperity_output::fields::Field;
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_plan::shared::model::forecast;
use asperity_plan::shared::setup;
use asperity_plan::shared::sha256::sha256;
use asperity_run::report::{Kind, Phases, Provenance, Report, SCHEMA, SetupPart, Sketch, Status};
use miette::{IntoDiagnostic, WrapErr, miette};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::fs;
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

/// Room that a run takes at its start and frees at its end \[bytes\], beside that for the page with its texts: the report of an end for want of room
/// needs some.
const RESERVED: usize = 65_536;
/// Room for each byte of the texts on the page: marks of HTML in them take several bytes.
const PER_BYTE: usize = 2;

/// Directory of a run in progress.
#[derive(Debug)]
pub(super) struct Directory {
    path: PathBuf,
    begin: Begin,
    /// The plan as printed; empty before the scene was planned.
    plan: String,
    /// SHA-256 of the files of the scene, by the names of their copies.
    meshes: BTreeMap<String, String>,
    /// Parts of the set-up that were read or kept.
    setup: Vec<SetupPart>,
    /// Tables of the run, by their paths, with their columns.
    tables: Vec<FileParts<Column>>,
    fields: Vec<FileParts<Field>>,
    room: Room,
    /// Lock held for the duration of the run.
    _lock: Option<Lock>,
}

impl Directory {
    /// Makes `path` the directory of a run. A result of the same scene is moved to `<path>.previous`; anything else that may still be wanted is an
    /// error.
    ///
    /// # Errors
    /// Names the obstacle and a way to proceed.
    pub fn claim(path: &Path, begin: Begin) -> miette::Result<Self> {
        // A link stays in place: the directory of the run is its target.
        let path = &target(path).into_diagnostic()?;
        Contents::read(path)?.refuse(path, &begin)?;
        let made = topmost_missing(path);
        atomic::create_dir(path).into_diagnostic()?;
        let lock = Lock::acquire(path)?;
        // Repeat the check, now that no other run can change the directory.
        let contents = Contents::read(path)?;
        contents.refuse(path, &begin)?;
        let room = match (contents, made) {
            (_, Some(made)) => Room::Made(made),
            (contents, None) if begin.resume && contents.has_checkpoint() => {
                Room::Kept(fs::read(path.join(REPORT)).ok())
            }
            (contents, None) if contents.holds_nothing() => Room::Found,
            (contents, None) if contents.lacked_room() => {
                clear(path).into_diagnostic()?;
                Room::Found
            }
            _ => move_away(path)?,
        };
        let path = path.to_path_buf();
        let (plan, meshes, setup) = Default::default();
        let (tables, fields) = (Vec::new(), Vec::new());
        let mut directory = Self { path, begin, plan, meshes, setup, tables, fields, room, _lock: lock };
        if let Err(error) = directory.open() {
            // A failure to clean up adds nothing to the error that is reported.
            let _ = directory.undo(&directory.room);
            return Err(error);
        }
        Ok(directory)
    }

    /// Makes an empty directory in place of one that was moved, and writes the report of a run in progress.
    fn open(&mut self) -> miette::Result<()> {
        if let Room::Moved(previous, _) = &self.room {
            atomic::create_dir(&self.path).into_diagnostic()?;
            self._lock = Lock::acquire(&self.path)?;
            // It is read again if it fits the scene as it is now.
            move_setup(previous, &self.path).into_diagnostic()?;
        }
        self.sketch(Status::Running, None).map(|_| ())
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
        atomic::write(&self.path.join(SCENE), self.begin.inputs.text.as_bytes()).into_diagnostic()?;
        self.begin.inputs.copy(&self.path, &self.meshes)?;
        let reserved = RESERVED + PER_BYTE * (self.plan.len() + self.begin.inputs.text.len());
        atomic::write(&self.path.join(RESERVE), &vec![0; reserved]).into_diagnostic()?;
        self.hide()?;
        self.describe();
        match std::mem::replace(&mut self.room, Room::Used) {
            Room::Moved(_, Some(older)) => fs::remove_dir_all(&older)
                .into_diagnostic()
                .wrap_err_with(|| format!("cannot remove {}", older.display())),
            _ => Ok(()),
        }
    }

    /// Takes the parts of the set-up that were read or kept, for the report.
    pub fn keeps(&mut self, setup: Vec<SetupPart>) {
        self.setup = setup;
    }

    /// Takes the tables of the run with their columns, and its fields, for the text about its files.
    pub fn describes(&mut self, tables: Vec<FileParts<Column>>, fields: Vec<FileParts<Field>>) {
        (self.tables, self.fields) = (tables, fields);
    }

    /// Takes the plan as printed, for the page of the run, and the hashes of the files from which it was made.
    pub fn planned(&mut self, plan: String, meshes: BTreeMap<String, String>) {
        (self.plan, self.meshes) = (plan, meshes);
    }

    /// Writes the final report. A completed run then needs its checkpoint no longer, except one of faults, which can be extended.
    pub fn write<P: Results>(&self, results: &P) -> miette::Result<()> {
        self.release();
        let status = results.outcome().status();
        let text = self.report(status, Some(results.seconds()), Some(&self.meshes), results)?;
        if status == Status::Completed && self.begin.kind != Kind::Faults {
            checkpoint::remove(&self.path).into_diagnostic()?;
        }
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
        let _ = readme::write(&self.path, &self.begin.title, &self.tables, &self.fields);
    }

    /// Removes what the end of the part before has written about the run as it was then: its page, figures and catalogues. All of it is written again
    /// at the end.
    fn hide(&self) -> miette::Result<()> {
        let ends = contents::end_files(&self.path).into_diagnostic()?;
        ends.iter().try_for_each(|path| {
            let removed = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
            removed.into_diagnostic().wrap_err_with(|| format!("cannot remove {}", path.display()))
        })
    }

    /// Writes the page of the run. It holds nothing that is not in other files: a run continues where it cannot be written.
    fn show(&self, report: &str) {
        let texts = Texts { plan: &self.plan, scene: &self.begin.inputs.text };
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
            .into_diagnostic()
            .wrap_err("cannot write the report")?;
        Ok(text)
    }

    /// Cleans up after an error: undoes all changes if nothing was computed; otherwise the report records the error. A run that found no room to write
    /// has an end of its own.
    ///
    /// # Errors
    /// The error, except for want of room.
    pub fn fails(self, error: miette::Report) -> miette::Result<End> {
        if !matches!(self.room, Room::Used) {
            // A failure to clean up adds nothing to the error that is reported.
            let _ = self.undo(&self.room);
            return Err(error);
        }
        self.release();
        let resumable = self.path.join(checkpoint::FILE).exists();
        let (ended, status, reason) = if full::is_full(&error) {
            // Figures are drawn again; without them there is room for the page.
            let _ = fs::remove_dir_all(self.path.join(PLOTS));
            let (end, status, reason) = full::end(&error, resumable);
            (Ok(end), status, reason)
        } else {
            let status = if resumable { Status::Interrupted } else { Status::Stopped };
            let reason = error.to_string();
            (Err(error), status, reason)
        };
        if let Ok(text) = self.sketch(status, Some(reason)) {
            self.show(&text);
            self.describe();
        }
        ended
    }

    fn undo(&self, room: &Room) -> std::io::Result<()> {
        match room {
            // Where there is no room for it, the report that is there stays.
            Room::Kept(Some(report)) => {
                return atomic::write(&self.path.join(REPORT), report).map_err(std::io::Error::other);
            }
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
        if self.path.exists() {
            fs::remove_dir_all(&self.path)?;
        }
        match room {
            Room::Made(topmost) => remove_empty(&self.path, topmost),
            Room::Moved(previous, older) => {
                fs::rename(previous, &self.path)?;
                older.as_ref().map_or(Ok(()), |older| fs::rename(older, previous))
            }
            _ => fs::create_dir(&self.path),
        }
    }

    fn sketch(&self, status: Status, reason: Option<String>) -> miette::Result<String> {
        self.report(status, None, None, Sketch { reason })
    }
}

/// End of the name of the directory of the result before.
const PREVIOUS: &str = ".previous";
/// End of the name of the one before that, while it may still be needed.
const OLDER: &str = ".older";
/// Longest name of a file \[bytes\] of the file systems in use.
const LONGEST_NAME: usize = 255;
/// Links followed from one to the next before they count as a circle, as on Linux.
const MOST_LINKS: usize = 40;
/// Digits of a hash by which shortened names differ.
const DIGITS: usize = 8;

/// The directory that a path represents: where it is a symbolic link, also one to nothing yet, that to which it leads.
fn target(path: &Path) -> std::io::Result<PathBuf> {
    // The end of `link/` would hide the link.
    let mut path: PathBuf = path.components().collect();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(to) => path = path.parent().unwrap_or(Path::new("")).join(to).components().collect(),
            // It is none, or it does not exist.
            Err(_) => return Ok(path),
        }
    }
    Err(std::io::Error::other(format!("{} is a link to itself", path.display())))
}

/// A name that has room for an end of some bytes: a long one is cut, and a hash of the whole name tells it from others.
fn room_for(name: &OsStr, end: usize) -> OsString {
    if name.len() + end <= LONGEST_NAME {
        return name.to_os_string();
    }
    let whole = name.to_string_lossy();
    let hash = sha256([name.as_encoded_bytes()]);
    let most = LONGEST_NAME - end - DIGITS - 1;
    format!("{}-{}", &whole[..whole.floor_char_boundary(most)], &hash[..DIGITS]).into()
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

/// Removes all that a run has left in a directory, except its set-up.
fn clear(path: &Path) -> std::io::Result<()> {
    for entry in fs::read_dir(path)? {
        let entry = entry?.path();
        match entry.file_name().and_then(OsStr::to_str) {
            Some(setup::FOLDER | LOCK) => {}
            _ if entry.is_dir() => fs::remove_dir_all(entry)?,
            _ => fs::remove_file(entry)?,
        }
    }
    Ok(())
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

/// Moves a directory to `<name>.previous`. A directory of that name is kept as `<name>.previous.older` as long as the move may be undone.
fn move_away(path: &Path) -> miette::Result<Room> {
    // The name of `.` is that of the directory it represents.
    let path = fs::canonicalize(path).into_diagnostic()?;
    let Some(name) = path.file_name() else {
        return Err(miette!("{} cannot be moved: choose another directory with --out", path.display()));
    };
    let name = room_for(name, PREVIOUS.len() + OLDER.len());
    let beside = |ends: &[&str]| {
        let mut name = name.clone();
        ends.iter().for_each(|end| name.push(end));
        path.with_file_name(name)
    };
    let (previous, older) = (beside(&[PREVIOUS]), beside(&[PREVIOUS, OLDER]));
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
