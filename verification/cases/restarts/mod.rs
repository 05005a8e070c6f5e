//! Runs interrupted as often as possible and resumed: they write the same files as uninterrupted runs.

mod scenes;
mod sliders;

use super::programs;
use super::run_files::Folder;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use rayon::prelude::*;
use scenes::InterruptedScene;
use std::path::{Path, PathBuf};
use std::process::Output;

/// See the README.
pub const CASE: Case = Case {
    name: "restarts",
    readme: include_str!("README.md"),
    covers: &[Capability::Restarts],
    quick: true,
    run,
};

/// Exit code of a run that completed.
const COMPLETED: i32 = 0;
/// Exit code of a run that was interrupted.
const INTERRUPTED: i32 = 3;
/// Number of interruptions after which a run is taken to make no progress.
const MOST: usize = 1000;

/// Comparison of an interrupted run with the uninterrupted one.
pub struct Parts {
    /// Name on the report page.
    name: &'static str,
    /// Number of interruptions.
    interruptions: usize,
    /// Files that differ.
    differing: Vec<PathBuf>,
    /// Number of files.
    files: usize,
    /// Cost of the uninterrupted run.
    cost: Cost,
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let folder = Folder::new()?;
    let runs: Vec<Result<Parts, CaseError>> = scenes::all()?
        .into_par_iter()
        .enumerate()
        .map(|(i, scene)| in_parts(&scene, &folder.path().join(i.to_string())))
        .collect();
    let mut runs = runs.into_iter().collect::<Result<Vec<Parts>, CaseError>>()?;
    runs.extend(sliders::run()?);
    for run in &runs {
        claims(ledger, run);
    }
    let row = |run: &Parts| [run.name.to_owned(), run.interruptions.to_string(), run.files.to_string()];
    ledger.table("Runs in parts", &["run", "interruptions", "files"], runs.iter().map(row));
    Ok(())
}

/// Runs a scene without interruption, and then one step at a time.
fn in_parts(scene: &InterruptedScene, folder: &Path) -> Result<Parts, CaseError> {
    std::fs::create_dir_all(folder)?;
    let (file, whole, parts) = (folder.join("scene.toml"), folder.join("whole"), folder.join("parts"));
    std::fs::write(&file, &scene.text)?;
    let part = |out: &Path, more: &[&str], codes: &[i32]| -> Result<Output, CaseError> {
        let mut command = programs::asperity(&[])?;
        command.args(["run", "--no-plots"]).args(more).arg(&file).arg("--out").arg(out);
        programs::finished(&mut command, codes).map_err(|e| format!("{}: {e}", scene.name).into())
    };
    let (done, cost) = Cost::measure(|| part(&whole, &[], &[COMPLETED]));
    done?;
    let mut interruptions = 0;
    let next = ["--resume", "--wall-time", "0 s"];
    while part(&parts, &next, &[COMPLETED, INTERRUPTED])?.status.code() == Some(INTERRUPTED) {
        interruptions += 1;
        if interruptions > MOST {
            let differing = vec![PathBuf::from("no progress")];
            return Ok(Parts { name: scene.name, interruptions, differing, files: 0, cost });
        }
    }
    let differing = programs::differing(&whole, &parts)?;
    Ok(Parts { name: scene.name, interruptions, differing, files: programs::files(&whole)?.len(), cost })
}

fn claims(ledger: &mut Ledger, run: &Parts) {
    let names: Vec<String> = run.differing.iter().map(|path| path.display().to_string()).collect();
    let list = if names.is_empty() { String::new() } else { format!(": {}", names.join(", ")) };
    ledger
        .claim(format!("{}: files of the interrupted run that differ{list}", run.name))
        .norm("byte by byte, without the part `run` of the report")
        .count(run.differing.len() as u64, 0)
        .evidence(Evidence::Exact, "a run and the same run in parts are one")
        .because("a checkpoint holds everything on which the next step depends")
        .cost(&run.cost)
        .record();
    ledger
        .claim(format!("{}: interruptions", run.name))
        .value(run.interruptions as f64)
        .at_least(3.0)
        .evidence(Evidence::Exact, "a limit of wall time of zero interrupts each run at each restart")
        .because("with fewer, little would be restored")
        .why_not_tighter("it tells a run in parts from a whole one")
        .cost(&run.cost)
        .record();
}
