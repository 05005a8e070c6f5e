//! Runs and their output files, read back as a user would.

use crate::cases::{programs, seas};
use crate::{CaseError, Cost};
use asperity::checkpoint::Pauses;
use asperity::keep::{Keeper, Place};
use asperity::kinds::faults::{Files, Report};
use asperity::{catalogue, kinds};
use asperity_cycles::{Balance, FaultRun, Faults, Moment};
use asperity_ode::{Control, Outcome};
use asperity_output::formats::catalogues::{cmtsolution, quakeml};
use asperity_plan::dynamics::AnyPlan;
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{bodies, dynamics};
use asperity_run::report::Outcome as Ended;
use asperity_run::{ObserveError, Observer};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A folder for the files of a run that is removed when dropped.
pub struct Folder(PathBuf);

/// Number of folders created so far; it keeps names distinct, since cases run in parallel.
static FOLDERS: AtomicUsize = AtomicUsize::new(0);

impl Folder {
    /// Creates a folder among the temporary files.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn new() -> Result<Self, CaseError> {
        let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("asperity-written-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&path)?;
        Ok(Self(path))
    }

    /// Path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Text of a file in the folder.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn text(&self, name: &str) -> Result<String, CaseError> {
        std::fs::read_to_string(self.0.join(name)).map_err(|e| format!("{name}: {e}").into())
    }

    /// Names of the files in a subfolder, sorted.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub fn names(&self, folder: &str) -> Result<Vec<String>, CaseError> {
        let mut names = Vec::new();
        for entry in std::fs::read_dir(self.0.join(folder))? {
            names.push(entry?.file_name().to_string_lossy().into_owned());
        }
        names.sort();
        Ok(names)
    }

    /// Table of a file in the folder.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn table(&self, name: &str) -> Result<Table, CaseError> {
        Table::parse(&self.text(name)?).ok_or_else(|| format!("{name} has no head").into())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that cannot be removed is left among the temporary files.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A table of a CSV or station file, without its comment lines.
pub struct Table {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn parse(text: &str) -> Option<Self> {
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let head = lines.next()?;
        let by = if head.contains(',') { ',' } else { ' ' };
        let cells = |line: &str| line.split(by).map(str::to_owned).collect();
        Some(Self { head: cells(head), rows: lines.map(cells).collect() })
    }

    /// Words of a column whose header is this name, with or without a unit.
    ///
    /// # Errors
    /// If there is no such column, or a row ends before it.
    pub fn words<'a>(&'a self, name: &str) -> Result<Vec<&'a str>, CaseError> {
        let named = |head: &String| head == name || head.split(" [").next() == Some(name);
        let k = self.head.iter().position(named).ok_or_else(|| format!("no column {name}"))?;
        let cell = |row: &'a Vec<String>| Ok(row.get(k).ok_or("a row is short")?.as_str());
        self.rows.iter().map(cell).collect()
    }

    /// Numbers of a column.
    ///
    /// # Errors
    /// As [`Table::words`], or if a cell is not a number.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, CaseError> {
        self.words(name)?.into_iter().map(|word| Ok(word.parse()?)).collect()
    }

    /// Number in the only row of a table.
    ///
    /// # Errors
    /// As [`Table::column`], or if there are more rows or none.
    pub fn only(&self, name: &str) -> Result<f64, CaseError> {
        match self.column(name)?[..] {
            [value] => Ok(value),
            _ => Err(format!("{} rows, and not one", self.rows.len()).into()),
        }
    }

    /// Headers of all columns.
    #[must_use]
    pub fn head(&self) -> &[String] {
        &self.head
    }

    /// Rows as numbers; other text is NaN.
    #[must_use]
    pub fn numbers(&self) -> Vec<Vec<f64>> {
        let row = |row: &Vec<String>| row.iter().map(|w| w.parse().unwrap_or(f64::NAN)).collect();
        self.rows.iter().map(row).collect()
    }
}

/// A run of faults and its files.
pub struct WrittenRun {
    /// Plan of the scene.
    pub plan: Plan,
    /// Report of the run.
    pub report: Report,
    /// Folder of the output files.
    pub files: Folder,
    /// Wall time and counts.
    pub cost: Cost,
}

/// Observer that writes the files of a run and sums its energy budget.
struct Both<'a>(Files<'a>, Balance<'a>);

impl Observer<Faults> for Both<'_> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Control, ObserveError> {
        self.1.step(moment);
        self.0.step(moment)
    }
}

impl WrittenRun {
    /// Runs a scene with faults to its end and writes the files that the command `run` writes.
    ///
    /// # Errors
    /// If the scene is refused, the run fails, or a file cannot be written.
    pub fn from_text(text: &str) -> Result<Self, CaseError> {
        let (plan, files) = (seas::plan(text)?, Folder::new()?);
        let (found, cost) = Cost::measure(|| followed(&plan, files.path()));
        let (run, report) = found?;
        catalogues(files.path(), &plan, &report)?;
        kinds::faults::write_fields(files.path(), &plan, &run)?;
        kinds::faults::write_bodies(files.path(), &plan, &run)?;
        kinds::faults::write_stresses(files.path(), &plan, &run)?;
        kinds::faults::write_finite_faults(files.path(), &plan, &run, &report.events)?;
        let cost = cost.count("steps", run.counts.steps as f64).count("points", plan.points.len() as f64);
        Ok(Self { plan, report, files, cost })
    }
}

/// Runs a plan and writes the files that grow with it.
fn followed(plan: &Plan, out: &Path) -> Result<(FaultRun, Report), CaseError> {
    let problem = &plan.problem;
    let mut both = Both(Files::create(out, plan)?, Balance::new(problem));
    // As the command does, keeps a catalogue of all faults and one for each.
    let start = plan.begin();
    let run = problem.resume(start, &problem.settings, None, &mut both)?;
    if let Outcome::Failed { reason } = &run.outcome {
        return Err(reason.to_string().into());
    }
    let report = Report::new(plan, &run, &mut both.1);
    Ok((run, report))
}

/// Writes the catalogue as a table, and as QuakeML and CMTSOLUTION if the scene has a position on Earth.
fn catalogues(out: &Path, plan: &Plan, report: &Report) -> Result<(), CaseError> {
    std::fs::write(out.join("events.csv"), catalogue::csv(&report.events))?;
    for fault in &report.faults {
        std::fs::write(out.join(format!("events_{}.csv", fault.surface)), catalogue::csv(&fault.events))?;
    }
    if let Some(slow) = &report.slow_events {
        std::fs::write(out.join("slow_events.csv"), catalogue::csv(slow))?;
    }
    std::fs::write(out.join("events.json"), serde_json::to_string(&report.events)?)?;
    if plan.frame.is_some() {
        let events = report.located();
        std::fs::write(out.join("events.quakeml"), quakeml(&plan.title, "run", &events)?)?;
        if let Some(text) = cmtsolution(&plan.title, &events) {
            std::fs::write(out.join("CMTSOLUTION"), text)?;
        }
    }
    Ok(())
}

/// Runs a scene of bodies to its end. Returns the folder of its output files and the cost.
///
/// # Errors
/// If the scene is refused, the run stops, or a file cannot be written.
pub fn bodies(text: &str) -> Result<(Folder, Cost), CaseError> {
    bodies_beside(text, Path::new(""))
}

/// As [`bodies`], of a scene whose files are relative to `folder`.
///
/// # Errors
/// As there.
pub fn bodies_beside(text: &str, folder: &Path) -> Result<(Folder, Cost), CaseError> {
    let scene = scene::read_in(text, folder).map_err(|e| format!("{e}\nin\n{text}"))?;
    let plan = bodies::plan(&scene).map_err(|e| e.to_string())?;
    let folder = Folder::new()?;
    let mut files = asperity_output::bodies::Files::create(folder.path(), plan.outputs())?;
    let (report, cost) = Cost::measure(|| kinds::bodies::run(&plan, &mut files));
    let report = report?;
    std::fs::write(folder.path().join("report.json"), serde_json::to_string(&report)?)?;
    match report.outcome {
        Ended::Completed => Ok((folder, cost)),
        other => Err(format!("the run did not come to its end: {other:?}").into()),
    }
}

/// Runs the program on a scene to its end. Its files are in the folder `out` of the one that is returned.
///
/// # Errors
/// If the run fails.
pub fn by_program(text: &str) -> Result<(Folder, Cost), CaseError> {
    let folder = Folder::new()?;
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, text)?;
    let mut command = programs::asperity(&[])?;
    command.args(["run", "--no-plots"]).arg(&file).arg("--out").arg(folder.path().join("out"));
    let (done, cost) = Cost::measure(|| programs::finished(&mut command, &[0]));
    done?;
    Ok((folder, cost))
}

/// A run of bodies with mass and its files.
pub struct Waves {
    /// Report of the run.
    pub report: kinds::dynamics::Report,
    /// Folder of the output files.
    pub files: Folder,
    /// Wall time and counts.
    pub cost: Cost,
}

impl Waves {
    /// Runs a scene with the stepper "explicit" to its end.
    ///
    /// # Errors
    /// If the scene is refused, the run stops, or a file cannot be written.
    pub fn from_text(text: &str) -> Result<Self, CaseError> {
        Self::limited(text, None)
    }

    /// The same, interrupted after each step and resumed.
    ///
    /// # Errors
    /// As [`Waves::from_text`].
    pub fn in_parts(text: &str) -> Result<Self, CaseError> {
        Self::limited(text, Some(Duration::ZERO))
    }

    fn limited(text: &str, wall: Option<Duration>) -> Result<Self, CaseError> {
        let scene = scene::read(text).map_err(|e| format!("{e}\nin\n{text}"))?;
        let (plan, files) = (dynamics::plan(&scene).map_err(|e| e.to_string())?, Folder::new()?);
        let (report, cost) = Cost::measure(|| match &plan {
            AnyPlan::Two(plan) => shaken(plan, files.path(), wall),
            AnyPlan::Three(plan) => shaken(plan, files.path(), wall),
        });
        let report = report?;
        let cost = cost.count("steps", report.counts.steps as f64);
        Ok(Self { report, files, cost })
    }
}

/// Runs a plan to its end, in parts if wall time is limited.
fn shaken<const D: usize>(
    plan: &dynamics::Plan<D>,
    out: &Path,
    wall: Option<Duration>,
) -> Result<kinds::dynamics::Report, CaseError> {
    loop {
        let report = shaken_part(plan, out, wall)?;
        match &report.outcome {
            Ended::Completed => return Ok(report),
            Ended::Interrupted { .. } => {}
            stopped @ Ended::Stopped { .. } => return Err(format!("the run stopped: {stopped:?}").into()),
        }
    }
}

fn shaken_part<const D: usize>(
    plan: &dynamics::Plan<D>,
    out: &Path,
    wall: Option<Duration>,
) -> Result<kinds::dynamics::Report, CaseError> {
    let stop = Arc::new(AtomicBool::new(false));
    let pauses = Pauses { every: Duration::MAX, wall, stop, begun: Instant::now() };
    let place = Place { out, physics: "", drawn: false, pauses };
    let (mut keeper, from) = match Keeper::<kinds::dynamics::Outputs<D>>::resume(plan, place.clone())? {
        Some((keeper, stand)) => (keeper, Some(stand)),
        None => (Keeper::begin(plan, place)?, None),
    };
    let ended = kinds::dynamics::run(plan, &mut keeper, from)?;
    let report = kinds::dynamics::Report::new(plan, &ended);
    keeper.finish(matches!(report.outcome, Ended::Completed)).complete(out, &ended)?;
    Ok(report)
}
