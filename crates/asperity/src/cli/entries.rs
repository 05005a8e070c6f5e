//! Files and folders that runs write to their directory: what each is, and which the end of a run writes anew.

use super::begin::{LOCK, PAGE, PLOTS, README, REPORT, RESERVE, SCENE};
use super::inputs;
use crate::checkpoint;
use asperity_output::figures::Sheet;
use asperity_output::terminal::progress;
use asperity_plan::shared::setup;
use std::ffi::OsStr;
use std::path::Path;

/// A file or a folder of a run.
pub struct Entry {
    /// Name, with `*` for any text.
    pub name: &'static str,
    /// Extensions of the files in a folder; `None` for a file.
    pub endings: Option<&'static [&'static str]>,
    /// Meaning, in words.
    pub meaning: &'static str,
    /// True if each end of a run writes it again as a whole.
    pub of_an_end: bool,
}

const fn file(name: &'static str, meaning: &'static str) -> Entry {
    Entry { name, endings: None, meaning, of_an_end: false }
}

const fn folder(name: &'static str, endings: &'static [&'static str], meaning: &'static str) -> Entry {
    Entry { name, endings: Some(endings), meaning, of_an_end: false }
}

/// All files and folders. Files in the folder of inputs are those that the scene names.
pub const ENTRIES: [Entry; 52] = [
    file(PAGE, "plan, checks, pictures, costs and warnings in one page for browsers, without other files")
        .of_an_end(),
    file(REPORT, "status, results, counts, times, provenance: begin here"),
    file(SCENE, "the scene as it was run, with the values of `--set`; it can be run from here"),
    folder(inputs::FOLDER, &[], "copies of the files that the scene names: meshes, tables, traces"),
    file(progress::FILE, "progress of the run; removed when it is complete"),
    file(checkpoint::FILE, "state from which `--resume` continues the run, or extends a run of faults"),
    file(LOCK, "held while a run writes to this directory"),
    file("fields.pvd", "list of the files in `fields/` over time, for ParaView"),
    file("bodies.pvd", "list of the displacements of bodies over each event and at the end, for ParaView"),
    file("events.pvd", "list of the fields on faults over each event, for ParaView"),
    file("events.csv", "catalogue of events").of_an_end(),
    file("events_*.csv", "catalogue of the events of one fault or interface").of_an_end(),
    file("slow_events.csv", "catalogue of slow events").of_an_end(),
    folder(
        "events",
        &["csv", "grd", "fsp", "vtu"],
        "single events: moment rate, rupture times, displacements, Coulomb stress (CSV), stresses of bodies (VTU), grids for GMT (netCDF), finite-fault models (FSP)",
    ),
    folder("receivers", &["csv"], "motion of positions in rock or bodies over time (CSV)"),
    file("events.json", "catalogue of events, with more of each").of_an_end(),
    file("events.quakeml", "catalogue of events for seismological programs").of_an_end(),
    file("CMTSOLUTION", "centroid moment tensors of the events").of_an_end(),
    file("largest_rate.csv", "largest slip rate over time; its logarithm is -20 at rest"),
    file("largest_rates.csv", "largest slip rate of each interface with events, at every step"),
    file("slip_profiles.csv", "slip along a fault at intervals"),
    file("rate_profiles.csv", "slip rate along a fault at intervals; logarithms are -20 at rest"),
    file(
        "state_profiles.csv",
        "state of friction along a fault at intervals: log10 of its time in seconds, where the law has one",
    ),
    file(
        "coupling_profiles.csv",
        "coupling along a fault to the plates that load it, at intervals between events",
    ),
    file(
        "locking.csv",
        "mean coupling of faults to the plates that load them, and moment deficit rate, over time",
    ),
    file("opening_profiles.csv", "opening along a fault at intervals"),
    file("temperature_profiles.csv", "temperature along a fault at intervals"),
    file("pressure_profiles.csv", "pore pressure along a fault at intervals"),
    file("surface_profiles_*.csv", "displacement of the free surface along a line at intervals"),
    file("snapshots.csv", "state of a fault at chosen times"),
    file("energy.csv", "energy budget over time"),
    file("moment_rate.csv", "moment rate over time"),
    file("fault_forces.csv", "shear and normal force of each fault over time"),
    file("rupture_times.csv", "rupture time and largest slip rate of each point"),
    folder("fields", &["vtu"], "bodies and surfaces at output times (VTU)"),
    folder("profiles", &["csv"], "whole surfaces at output times (CSV)"),
    folder("probes", &["csv"], "positions on surfaces, at every step (CSV)"),
    folder("points", &["csv"], "positions in bodies, at every step (CSV)"),
    folder("forces", &["csv"], "forces on sets, at every step (CSV)"),
    folder("springs", &["csv"], "springs, at every step (CSV)"),
    folder("history", &["csv"], "sliders over time (CSV)"),
    folder(PLOTS, &["svg", "png", "pdf"], "figures (SVG, PNG, PDF)").of_an_end(),
    file(Sheet::FILE, "what `asperity plot` needs beside the tables to draw the figures again").of_an_end(),
    folder(
        setup::FOLDER,
        &["bin"],
        "set-up of faults that took long, which the next run of the same scene here reads; may be removed",
    ),
    folder("stations", &[""], "stations on faults over time, in the format of the SEAS community"),
    folder("platform", &["txt", "dat"], "results in the files of the platform of a community benchmark"),
    folder(
        "seismograms",
        &["csv", "mseed", "sac"],
        "velocity and displacement at positions (CSV, miniSEED, SAC)",
    ),
    file(README, "this text"),
    file(".writable", "trial of writing, left by a run that was killed"),
    file(RESERVE, "room kept for the report of a run whose disc is full, left by a run that was killed"),
    file(".DS_Store", "left by a file manager"),
    file("Thumbs.db", "left by a file manager"),
];

impl Entry {
    const fn of_an_end(self) -> Self {
        Self { of_an_end: true, ..self }
    }

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
        self.endings.is_some_and(|endings| endings.iter().any(|e| ending == *e))
    }
}

/// The file or folder of this name.
#[must_use]
pub fn named(name: &OsStr) -> Option<&'static Entry> {
    let name = name.to_str()?;
    ENTRIES.iter().find(|entry| entry.fits(name))
}
