//! Scenes of one slider as texts, run as the program runs them, and their output files.

use crate::CaseError;
use crate::cases::run_files::Folder;
use asperity::kinds::sliders::{Histories, NamedEvent, csv};
use asperity_cycles::slider::{self as cycles, Problem};
use asperity_ode::Outcome;
use asperity_plan::sliders::{Plan, planner};

/// Columns of a history.
pub const TIME: usize = 0;
/// Slip.
pub const SLIP: usize = 2;
/// Slip rate.
pub const RATE: usize = 3;
/// Friction coefficient.
pub const FRICTION: usize = 4;
/// First state variable.
pub const STATE: usize = 8;

/// A scene of one slider under 5 MPa.
pub fn text(load: &str, slider: &str, law: &str, rest: &str) -> String {
    format!(
        "schema = 1\ntitle = \"t\"\nkinematics = \"spring-slider\"\n{load}\n[sliders.block]\nnormal = \"5 MPa\"\n{slider}\nlaw = {law}\n{rest}\n"
    )
}

/// Plan of a scene.
///
/// # Errors
/// If the scene is rejected.
pub fn planned(text: &str) -> Result<Plan, CaseError> {
    planner::read(text).map_err(|e| format!("{e}\nin\n{text}").into())
}

/// Problem of a scene.
///
/// # Errors
/// If the scene is rejected.
pub fn plan(text: &str) -> Result<Problem, CaseError> {
    Ok(planned(text)?.problem)
}

/// Numbers of a CSV file below its header, from column `first` on; other text is NaN.
fn table(text: &str, first: usize) -> Vec<Vec<f64>> {
    let numbers = |l: &str| l.split(',').skip(first).map(|v| v.parse().unwrap_or(f64::NAN)).collect();
    text.lines().skip(1).map(numbers).collect()
}

/// Columns of a catalogue that come before tractions, friction and states: direction, onset, interval and so on.
const EVENTS: [&str; 8] =
    ["direction", "onset", "interval", "duration", "slip", "peak_rate", "least_rate", "stress_drop"];

/// Rows of a catalogue: [`EVENTS`], and the columns that follow them in the file.
fn events(text: &str) -> Result<Vec<Vec<f64>>, CaseError> {
    let head: Vec<&str> = text.lines().next().unwrap_or_default().split(',').collect();
    let place = |name: &&str| head.iter().position(|column| column.split(" [").next() == Some(name));
    let order: Option<Vec<usize>> = EVENTS.iter().map(place).collect();
    let order = order.ok_or_else(|| format!("a column is missing in {head:?}"))?;
    let rest = 1 + place(&"least_rate").unwrap_or(0);
    let row = |row: Vec<f64>| order.iter().map(|&k| row[k]).chain(row[rest..].iter().copied()).collect();
    Ok(table(text, 0).into_iter().map(row).collect())
}

/// Rows of the slider's history and of the catalogue, see [`events`], from a run.
///
/// # Errors
/// If the run fails or a file cannot be written or read.
pub fn files(plan: &Problem) -> Result<[Vec<Vec<f64>>; 2], CaseError> {
    let folder = Folder::new()?;
    let mut histories = Histories::create(folder.path(), plan)?;
    let run = cycles::run(plan, &mut histories)?;
    if let Outcome::Failed { reason } = run.outcome {
        return Err(reason.to_string().into());
    }
    histories.finish()?;
    let history = folder.text("history/block.csv")?;
    Ok([table(&history, 0), events(&csv(&NamedEvent::all(&run, &plan.names)))?])
}
