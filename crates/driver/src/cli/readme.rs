//! `README.md` of an output directory: what each file there is.

use super::begin::{LOCK, PAGE, README, REPORT, RESERVE, SCENE};
use super::inputs;
use crate::checkpoint;
use crate::setup;
use asperity_output::plots::Sheet;
use asperity_output::{OutputError, atomic, progress};
use std::fs;
use std::path::Path;

/// Files and folders of runs, with what they are.
const MEANINGS: [(&str, &str); 50] = [
    (PAGE, "plan, checks, pictures, costs and warnings in one page for browsers, without other files"),
    (REPORT, "status, results, counts, times, provenance: begin here"),
    (SCENE, "the scene as it was run, with the values of `--set`; it can be run from here"),
    (inputs::FOLDER, "copies of the files that the scene names: meshes, tables, traces"),
    (progress::FILE, "progress of the run; removed when it is complete"),
    (checkpoint::FILE, "state from which `--resume` continues the run, or extends a run of faults"),
    (LOCK, "held while a run writes to this directory"),
    ("fields.pvd", "list of the files in `fields/` over time, for ParaView"),
    ("bodies.pvd", "list of the displacements of bodies over time, for ParaView"),
    ("events.pvd", "list of the displacements of bodies over each event, for ParaView"),
    ("events.csv", "catalogue of events"),
    ("events_*.csv", "catalogue of the events of one fault or interface"),
    ("slow_events.csv", "catalogue of slow events"),
    (
        "events",
        "single events: moment rate, rupture times, displacements, Coulomb stress (CSV), stresses of bodies (VTU), grids for GMT (netCDF), finite-fault models (FSP)",
    ),
    ("receivers", "motion of positions in rock or bodies over time (CSV)"),
    ("events.json", "catalogue of events, with more of each"),
    ("events.quakeml", "catalogue of events for seismological programs"),
    ("CMTSOLUTION", "centroid moment tensors of the events"),
    ("largest_rate.csv", "largest slip rate over time; its logarithm is -20 at rest"),
    ("largest_rates.csv", "largest slip rate of each interface with events, at every step"),
    ("slip_profiles.csv", "slip along a fault at intervals"),
    ("rate_profiles.csv", "slip rate along a fault at intervals; logarithms are -20 at rest"),
    (
        "state_profiles.csv",
        "state of friction along a fault at intervals: log10 of its time in seconds, where the law has one",
    ),
    (
        "coupling_profiles.csv",
        "coupling along a fault to the plates that load it, at intervals between events",
    ),
    (
        "locking.csv",
        "mean coupling of faults to the plates that load them, and moment deficit rate, over time",
    ),
    ("opening_profiles.csv", "opening along a fault at intervals"),
    ("temperature_profiles.csv", "temperature along a fault at intervals"),
    ("pressure_profiles.csv", "pore pressure along a fault at intervals"),
    ("surface_profiles_*.csv", "displacement of the free surface along a line at intervals"),
    ("snapshots.csv", "state of a fault at chosen times"),
    ("energy.csv", "energy budget over time"),
    ("moment_rate.csv", "moment rate over time"),
    ("fault_forces.csv", "shear and normal force of each fault over time"),
    ("rupture_times.csv", "rupture time and largest slip rate of each point"),
    ("fields", "bodies and surfaces at output times (VTU)"),
    ("profiles", "whole surfaces at output times (CSV)"),
    ("probes", "positions on surfaces, at every step (CSV)"),
    ("points", "positions in bodies, at every step (CSV)"),
    ("forces", "forces on sets, at every step (CSV)"),
    ("springs", "springs, at every step (CSV)"),
    ("history", "sliders over time (CSV)"),
    ("plots", "figures (SVG, PNG, PDF)"),
    (Sheet::FILE, "what `asperity plot` needs beside the tables to draw the figures again"),
    (
        setup::FOLDER,
        "set-up of faults that took long, which the next run of the same scene here reads; may be removed",
    ),
    ("stations", "stations on faults over time, in the format of the SEAS community"),
    ("platform", "results in the files of the platform of a community benchmark"),
    ("seismograms", "velocity and displacement at positions (CSV, miniSEED, SAC)"),
    (README, "this text"),
    (".writable", "trial of writing, left by a run that was killed"),
    (RESERVE, "room kept for the report of a run whose disc is full, left by a run that was killed"),
];

/// Writes the text about the files that exist.
pub(super) fn write(folder: &Path, title: &str) -> Result<(), OutputError> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.file_name().to_str()?.to_string()))
        .chain([README.to_string(), REPORT.to_string()])
        .collect();
    names.sort();
    names.dedup();
    let row = |name: &String| {
        let meaning = meaning(name)?;
        let slash = if folder.join(name).is_dir() { "/" } else { "" };
        Some(format!("- `{name}{slash}`: {meaning}\n"))
    };
    let rows: String = names.iter().filter(|name| !name.starts_with('.')).filter_map(row).collect();
    let text = format!(
        "# {title}\n\nResults of a run of asperity {}. The chapter \"Files and columns\" of its book has all columns.\n\n{rows}",
        env!("CARGO_PKG_VERSION")
    );
    atomic::write(&folder.join(README), text.as_bytes())
}

/// Meaning of the file or folder of this name.
pub fn meaning(name: &str) -> Option<&'static str> {
    let fits = |pattern: &str| match pattern.split_once('*') {
        Some((begin, end)) => name.starts_with(begin) && name.ends_with(end),
        None => name == pattern,
    };
    MEANINGS.iter().find(|(pattern, _)| fits(pattern)).map(|(_, meaning)| *meaning)
}
