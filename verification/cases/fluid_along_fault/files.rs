//! Runs of the program `asperity`, and the files that they write.

use crate::cases::programs;
use crate::cases::run_files::{self, Folder};
use crate::{CaseError, Cost};
use asperity_vary::SceneText;
use std::path::Path;
use std::process::Output;

/// Exit codes of a run that has come to its end, and of one that was interrupted.
const CODES: [i32; 2] = [0, 3];
/// Number of restarts that a run has at most.
const MOST: u64 = 1000;

/// A run and its table of pressures.
pub struct FluidRun {
    /// Positions of the points along the fault \[m\].
    pub positions: Vec<f64>,
    /// Times \[s\] and pressures \[Pa\].
    pub rows: Vec<(f64, Vec<f64>)>,
    folder: Folder,
    /// Wall time, and number of points.
    pub cost: Cost,
}

/// Runs the program on the file of a scene.
fn asperity(file: &Path, out: &Path, more: &[&str], codes: &[i32]) -> Result<Output, CaseError> {
    let mut command = programs::asperity(&[])?;
    command.args(["run", "--no-plots"]).args(more).arg(file).arg("--out").arg(out);
    programs::finished(&mut command, codes)
}

impl FluidRun {
    /// Runs a scene to its end; one with `injection` has no table of pressures.
    ///
    /// # Errors
    /// If the run fails, or a table cannot be read.
    pub fn from_scene(scene: &SceneText) -> Result<Self, CaseError> {
        let (folder, cost) = run_files::by_program(&scene.clone().text()?)?;
        let (mut positions, mut rows) = (Vec::new(), Vec::new());
        if folder.path().join("out/pressure_profiles.csv").exists() {
            let table = folder.table("out/pressure_profiles.csv")?;
            let heads = table.head()[1..].iter().map(|head| head.parse());
            positions = heads.collect::<Result<Vec<f64>, _>>()?;
            rows = table.numbers().into_iter().map(|row| (row[0], row[1..].to_vec())).collect();
        }
        let cost = cost.count("points", positions.len() as f64);
        Ok(Self { positions, rows, folder, cost })
    }

    /// Time and pressures of the last row.
    pub fn last(&self) -> (f64, &[f64]) {
        self.rows.last().map_or((f64::NAN, &[]), |row| (row.0, &row.1))
    }

    /// Imbalance of the energy budget in the report.
    ///
    /// # Errors
    /// If the report cannot be read.
    pub fn imbalance(&self) -> Result<f64, CaseError> {
        let report: serde_json::Value = serde_json::from_str(&self.folder.text("out/report.json")?)?;
        Ok(report["energy"]["imbalance"].as_f64().ok_or("no energy")?)
    }

    /// Values of a column of all stations at a time \[s\], linear between rows.
    ///
    /// # Errors
    /// If a file cannot be read, or does not reach the time.
    pub fn at_stations(&self, column: &str, time: f64) -> Result<Vec<f64>, CaseError> {
        let at = |name: String| {
            let table = self.folder.table(&format!("out/stations/{name}"))?;
            let (times, values) = (table.column("t")?, table.column(column)?);
            let after = times.partition_point(|t| *t < time);
            let [before, after] = [after.checked_sub(1).ok_or("no row before")?, after];
            let end = times.get(after).ok_or("no row after")?;
            let share = (time - times[before]) / (end - times[before]);
            Ok(values[before] + share * (values[after] - values[before]))
        };
        self.folder.names("out/stations")?.into_iter().map(at).collect()
    }
}

/// Runs a scene as a whole and from restart to restart. Returns the number of interruptions, and of files that differ.
///
/// # Errors
/// If a run fails.
pub fn in_parts(scene: &SceneText) -> Result<(u64, u64), CaseError> {
    let folder = Folder::new()?;
    let [file, whole, parts] = ["scene.toml", "whole", "parts"].map(|name| folder.path().join(name));
    std::fs::write(&file, scene.clone().text()?)?;
    asperity(&file, &whole, &[], &CODES[..1])?;
    let mut interruptions = 0;
    while asperity(&file, &parts, &["--resume", "--wall-time", "0 s"], &CODES)?.status.code()
        == Some(CODES[1])
    {
        interruptions += 1;
        if interruptions > MOST {
            return Err("an interrupted run makes no progress".into());
        }
    }
    Ok((interruptions, programs::differing(&whole, &parts)?.len() as u64))
}
