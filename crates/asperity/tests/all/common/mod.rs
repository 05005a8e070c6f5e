//! Runs of scenes given as text, with their results.

pub mod cycles;
pub mod every_kind;
pub mod sliders;
pub mod written;

use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_cycles::{Fault, Problem};
use asperity_friction::evolution::definitions;
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::BodyFields;
use asperity_plan::bodies::{self, AnyPlan};
use asperity_plan::reading::scene;
use asperity_run::report::Outcome;
use asperity_vary::Change::{self, With};
use asperity_vary::SceneText;
use std::path::Path;
use std::process::Output;

/// The scene of the README.
pub const SANDWICH: &str = include_str!("../../../../../scenes/sandwich.toml");

/// Names of the evolutions that need no parameters of their own.
pub fn plain_evolutions() -> impl Iterator<Item = &'static str> {
    definitions().into_iter().filter(|row| row.is_plain()).map(|row| row.name)
}

/// The text of a scene with these changes, each of which must have an effect.
#[track_caller]
pub fn varied(scene: &str, changes: &[Change<'_>]) -> String {
    SceneText::new(scene).changed(changes).text().unwrap_or_else(|e| panic!("{e}\n{scene}"))
}

/// The scene of the README on coarse cells, so that tests are quick.
pub fn coarse_sandwich() -> String {
    let sizes = ["bodies.A.mesh.block.size", "bodies.B.mesh.block.size"].map(|path| With(path, "5 mm"));
    varied(SANDWICH, &[sizes[0], sizes[1], With("time.tolerance", "20 nm")])
}

/// Standard error of a command without the line breaks of the renderer.
pub fn told(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    text.split(['\n', '│', '×', ' ']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// A plan; mesh files are those of the tests.
pub fn planned(text: &str) -> AnyPlan {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    let scene = scene::read_in(text, &folder).unwrap_or_else(|e| panic!("{e}\n{text}"));
    bodies::plan(&scene).unwrap_or_else(|e| panic!("{e} {:?}\n{text}", e.help))
}

/// Runs a scene to its end.
pub fn simulate(text: &str) -> (RunReport, Recorder) {
    let mut record = Recorder::new().with_bodies();
    let report = kinds::bodies::run(&planned(text), &mut record).unwrap();
    assert_eq!(report.outcome, Outcome::Completed);
    (report, record)
}

/// Fields of the bodies at the end of the run.
pub fn fields(record: &Recorder) -> &BodyFields {
    record.stage_ends().last().unwrap().bodies.as_ref().unwrap()
}

/// Displacements of the nodes at which `at` holds, with their positions.
pub fn displacements(record: &Recorder, at: impl Fn(&[f64; 3]) -> bool) -> Vec<([f64; 3], [f64; 3])> {
    let nodes = &record.setup().mesh.nodes;
    let all = nodes.iter().zip(&fields(record).displacement);
    let found: Vec<_> = all.filter(|(x, _)| at(x)).map(|(x, u)| (*x, *u)).collect();
    assert!(!found.is_empty());
    found
}

/// Asserts that two numbers agree to a relative tolerance.
#[track_caller]
pub fn close(found: f64, exact: f64, tolerance: f64) {
    assert!((found - exact).abs() <= tolerance * exact.abs(), "{found:e} is not {exact:e}");
}

/// Traction that friction and radiation damping hold at a point of a fault, under an effective normal traction.
pub fn resistance(fault: &Fault, point: usize, normal: f64, [m, rate]: [f64; 2]) -> f64 {
    normal * fault.law.scale(point) * m + fault.damping[point] * rate
}

/// Resistance of all points at the start, where normal tractions have a floor.
pub fn first_resistance(problem: &Problem, floor: f64) -> Vec<f64> {
    let (fault, start) = (&problem.fault, &problem.start);
    let rate = fault.slip_rates(start);
    let at = |p: usize| resistance(fault, p, fault.normal[p].max(floor), [start[p], rate.all()[p]]);
    (0..fault.normal.len()).map(at).collect()
}
