//! Scenes run from a text, with what they leave.

pub mod cycles;
pub mod sliders;
pub mod written;

use asperity_driver::plan::{self, AnyPlan};
use asperity_driver::report::{Outcome, RunReport};
use asperity_driver::{run, scene};
use asperity_output::Recorder;
use asperity_output::view::BodyFields;
use std::path::Path;

/// A plan; mesh files are those of the tests.
pub fn planned(text: &str) -> AnyPlan {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    let scene = scene::read_in(text, &folder).unwrap_or_else(|e| panic!("{e}\n{text}"));
    plan::plan(&scene).unwrap_or_else(|e| panic!("{e} {:?}\n{text}", e.help))
}

/// Runs a scene to its end.
pub fn simulate(text: &str) -> (RunReport, Recorder) {
    let mut record = Recorder::new().with_bodies();
    let report = run::run(&planned(text), &mut record).unwrap();
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

/// Whether two numbers agree to a relative tolerance.
#[track_caller]
pub fn close(found: f64, exact: f64, tolerance: f64) {
    assert!((found - exact).abs() <= tolerance * exact.abs(), "{found:e} is not {exact:e}");
}
