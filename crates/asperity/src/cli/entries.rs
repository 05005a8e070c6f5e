//! Files and folders that runs write to their directory: what each is, and which the end of a run writes anew.

use super::begin::{LOCK, PAGE, PLOTS, README, REPORT, RESERVE, SCENE};
use super::inputs;
use crate::{catalogue, checkpoint, kinds};
use asperity_output::OutputFile;
use asperity_output::figures::Sheet;
use asperity_output::terminal::progress;
use asperity_output::{bodies, fields};
use asperity_plan::shared::setup;
use std::ffi::OsStr;
use std::path::Path;
use std::sync::LazyLock;

/// A file or a folder of a run.
#[derive(Clone)]
pub struct Entry {
    /// Name, with `*` for any text.
    pub name: &'static str,
    /// Extensions of the files in a folder; `None` for a file.
    pub endings: Option<Vec<&'static str>>,
    /// Meaning, as text.
    pub meaning: &'static str,
    /// True if each end of a run writes it again as a whole.
    pub of_an_end: bool,
}

/// Tables and fields of all kinds of run.
fn kind_files() -> impl Iterator<Item = OutputFile> {
    let faults = kinds::faults::FILES.into_iter().chain(kinds::faults::PROFILES);
    let others = bodies::FILES.into_iter().chain(kinds::dynamics::FILES).chain([kinds::sliders::HISTORIES]);
    let fields = [fields::FILES, fields::COLLECTION];
    fields.into_iter().chain(catalogue::FILES).chain(faults).chain(others)
}

/// All files and folders: those of no table or field, and those that follow from tables and fields.
pub fn all() -> &'static [Entry] {
    static ALL: LazyLock<Vec<Entry>> = LazyLock::new(|| {
        let mut all: Vec<Entry> = OTHERS.into_iter().map(Entry::from).collect();
        all.extend(FOLDERS.map(|(name, endings, meaning)| {
            let of_an_end = name == PLOTS;
            Entry { name, endings: Some(endings.to_vec()), meaning, of_an_end }
        }));
        for file in kind_files() {
            let mut entry = Entry::from(file);
            match all.iter_mut().find(|known| known.name == entry.name) {
                Some(known) => known
                    .endings
                    .iter_mut()
                    .for_each(|own| own.extend(entry.endings.take().into_iter().flatten())),
                None => all.push(entry),
            }
        }
        all
    });
    &ALL
}

/// Folders of files of several kinds, with their extensions beside those of tables and fields. Files in the folder of inputs are
/// those that the scene names.
const FOLDERS: [(&str, &[&str], &str); 7] = [
    (inputs::FOLDER, &[], "copies of the files that the scene names: meshes, tables, traces"),
    (
        "events",
        &["grd", "fsp"],
        "single events: moment rate, rupture times, displacements, Coulomb stress (CSV), stresses of bodies (VTU), grids for GMT (netCDF), finite-fault models (FSP)",
    ),
    (PLOTS, &["svg", "png", "pdf"], "figures (SVG, PNG, PDF)"),
    (
        setup::FOLDER,
        &["bin"],
        "set-up of faults that took long, which the next run of the same scene here reads; may be removed",
    ),
    ("stations", &[""], "stations on faults over time, in the format of the SEAS community"),
    ("platform", &["txt", "dat"], "results in the files of the platform of a community benchmark"),
    ("seismograms", &["mseed", "sac"], "velocity and displacement at positions (CSV, miniSEED, SAC)"),
];

/// Files that are neither tables nor fields.
const OTHERS: [OutputFile; 15] = [
    OutputFile::new(
        PAGE,
        "plan, checks, pictures, costs and warnings in one page for browsers, without other files",
    )
    .with_each_end(),
    OutputFile::new(REPORT, "status, results, counts, times, provenance: begin here"),
    OutputFile::new(SCENE, "the scene as it was run, with the values of `--set`; it can be run from here"),
    OutputFile::new(progress::FILE, "progress of the run; removed when it is complete"),
    OutputFile::new(
        checkpoint::FILE,
        "state from which `--resume` continues the run, or extends a run of faults",
    ),
    OutputFile::new(LOCK, "held while a run writes to this directory"),
    OutputFile::new("events.json", "catalogue of events, with more of each").with_each_end(),
    OutputFile::new("events.quakeml", "catalogue of events for seismological programs").with_each_end(),
    OutputFile::new("CMTSOLUTION", "centroid moment tensors of the events").with_each_end(),
    OutputFile::new(Sheet::FILE, "what `asperity plot` needs beside the tables to draw the figures again")
        .with_each_end(),
    OutputFile::new(README, "this text"),
    OutputFile::new(".writable", "trial of writing, left by a run that was killed"),
    OutputFile::new(
        RESERVE,
        "room kept for the report of a run whose disc is full, left by a run that was killed",
    ),
    OutputFile::new(".DS_Store", "left by a file manager"),
    OutputFile::new("Thumbs.db", "left by a file manager"),
];

impl From<OutputFile> for Entry {
    fn from(file: OutputFile) -> Self {
        let OutputFile { path, meaning, of_an_end } = file;
        let (name, endings) = match path.split_once('/') {
            Some((folder, name)) => {
                (folder, Some(vec![name.rsplit_once('.').map_or("", |(_, ending)| ending)]))
            }
            None => (path, None),
        };
        Self { name, endings, meaning, of_an_end }
    }
}

impl Entry {
    /// True if it has this name.
    fn fits(&self, name: &str) -> bool {
        match self.name.split_once('*') {
            Some((begin, end)) => name.starts_with(begin) && name.ends_with(end),
            None => name == self.name,
        }
    }

    /// True if a file of this name may stand in this folder.
    pub(super) fn holds(&self, name: &OsStr) -> bool {
        let ending = Path::new(name).extension().unwrap_or_default();
        self.endings.as_ref().is_some_and(|endings| endings.iter().any(|e| ending == *e))
    }
}

/// The file or folder of this name.
#[must_use]
pub fn named(name: &OsStr) -> Option<&'static Entry> {
    let name = name.to_str()?;
    all().iter().find(|entry| entry.fits(name))
}
