//! Runs of spring-sliders given as text, with their files.

use asperity::kinds::sliders::Histories;
use asperity_cycles::slider::{Problem, SliderRun, run};
use asperity_ode::Outcome;
use asperity_plan::sliders::{Plan, planner};
use std::path::Path;

/// The scene of the book: a slider through ten events.
pub const CYCLE: &str = include_str!("../../../../../scenes/spring-slider.toml");

pub fn planned(text: &str) -> Plan {
    planner::read(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

pub fn plan(text: &str) -> Problem {
    planned(text).problem
}

pub fn relative(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// Runs a plan and writes its histories into a folder.
pub fn written(plan: &Problem) -> (tempfile::TempDir, SliderRun) {
    let folder = tempfile::tempdir().unwrap();
    let mut files = Histories::create(folder.path(), plan).unwrap();
    let run = run(plan, &mut files).unwrap();
    assert!(!matches!(run.outcome, Outcome::Failed { .. }), "{:?}", run.outcome);
    files.finish().unwrap();
    (folder, run)
}

/// The columns of `history/NAME.csv`, as numbers.
pub fn history(folder: &Path, name: &str) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(folder.join("history").join(name)).unwrap();
    text.lines().skip(1).map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect()
}
