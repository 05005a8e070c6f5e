//! Scenes of cases as texts that a user could run, read by the public reader.

use crate::{CaseError, Cost};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::InterfaceFields;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use asperity_run::report::Outcome;
use std::path::Path;

/// A run that may have ended early.
pub struct BodyRun {
    /// Scene.
    pub scene: String,
    /// Report.
    pub report: RunReport,
    /// Histories at all slave nodes, fields of the bodies at the ends of stages.
    pub record: Recorder,
    /// Wall time and counts.
    pub cost: Cost,
}

/// Runs a scene as far as it gets.
///
/// # Errors
/// If the scene is rejected or cannot be set up.
pub fn attempt(text: &str) -> Result<BodyRun, CaseError> {
    attempt_in(text, "")
}

/// Runs a scene with mesh files in this folder of `cases` as far as it gets.
///
/// # Errors
/// If the scene is rejected or cannot be set up.
pub fn attempt_in(text: &str, folder: &str) -> Result<BodyRun, CaseError> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(folder);
    let scene = scene::read_in(text, &folder).map_err(|e| format!("{e}\nin\n{text}"))?;
    let plan = bodies::plan(&scene).map_err(|e| e.to_string())?;
    let mut record = Recorder::new().at_all_nodes().with_bodies();
    let (report, cost) = Cost::measure(|| kinds::bodies::run(&plan, &mut record));
    let report = report?;
    let cost = cost.counts(&report.counts);
    Ok(BodyRun { scene: text.to_owned(), report, record, cost })
}

/// Runs a scene to its end.
///
/// # Errors
/// If the scene is rejected or the run stops.
pub fn simulate(text: &str) -> Result<BodyRun, CaseError> {
    simulate_in(text, "")
}

/// Runs a scene with mesh files in this folder of `cases` to its end.
///
/// # Errors
/// If the scene is rejected or the run stops.
pub fn simulate_in(text: &str, folder: &str) -> Result<BodyRun, CaseError> {
    let done = attempt_in(text, folder)?;
    match &done.report.outcome {
        Outcome::Completed => Ok(done),
        Outcome::Stopped { stage, time, reason, .. } => {
            let stage = stage.as_deref().unwrap_or_default();
            Err(format!("stopped in stage `{stage}` at {time} s: {reason}").into())
        }
        Outcome::Interrupted { .. } => Err("interrupted".into()),
    }
}

impl BodyRun {
    /// Force on a set of the scene after each step \[N, N/m in the plane\].
    pub fn force(&self, name: &str) -> Result<Vec<[f64; 3]>, CaseError> {
        let marks = &self.record.setup().forces;
        let k = marks.iter().position(|m| m.name == name).ok_or_else(|| format!("no force `{name}`"))?;
        Ok(self.record.samples().iter().map(|s| s.forces[k]).collect())
    }

    /// Displacement of a point of the scene at the end of the run \[m\].
    pub fn displacement(&self, name: &str) -> Result<[f64; 3], CaseError> {
        let marks = &self.record.setup().points;
        let k = marks.iter().position(|m| m.name == name).ok_or_else(|| format!("no point `{name}`"))?;
        let last = self.record.samples().last().ok_or("no step was taken")?;
        Ok(last.points[k].displacement)
    }

    /// Friction force on the slave side after each step of a plane scene, along the tangent of the interface \[N/m\].
    pub fn friction(&self) -> Vec<f64> {
        let points = &self.record.histories()[0].points;
        let at = |k: usize| points.iter().map(|p| p.area[k] * p.shear_traction[k]).sum();
        (0..self.record.times().len()).map(at).collect()
    }

    /// Number of steps up to the end of stage `name`: the index of its last step plus one.
    pub fn steps_until(&self, name: &str) -> Result<usize, CaseError> {
        let end = self.record.stage_end(name).ok_or_else(|| format!("stage {name} was not reached"))?.time;
        Ok(self.record.times().iter().take_while(|&&t| t <= end).count())
    }

    /// Fields of the first interface at the end of a stage.
    pub fn contact(&self, stage: &str) -> Result<&InterfaceFields, CaseError> {
        let end = self.record.stage_end(stage).ok_or_else(|| format!("stage {stage} was not reached"))?;
        Ok(&end.interfaces[0])
    }

    /// Energy dissipated in each step on the first interface of a plane scene: mean of the friction forces at both ends
    /// times the slip increment \[J/m\]. In three dimensions only magnitudes of slip and traction are recorded, from
    /// which it cannot be computed.
    pub fn dissipated(&self) -> Vec<f64> {
        let points = &self.record.histories()[0].points;
        let steps = self.record.times().len();
        let mut work = vec![0.0; steps];
        for point in points {
            let (mut force, mut slip) = (0.0, 0.0);
            for (k, w) in work.iter_mut().enumerate() {
                let (f, s) = (point.area[k] * point.shear_traction[k], point.slip[k]);
                *w += 0.5 * (force + f) * (s - slip);
                (force, slip) = (f, s);
            }
        }
        work
    }
}

/// Work of a force over a displacement in each step but the first, by the trapezoidal rule.
pub fn work(force: &[f64], displacement: &[f64]) -> Vec<f64> {
    force.windows(2).zip(displacement.windows(2)).map(|(f, u)| 0.5 * (f[0] + f[1]) * (u[1] - u[0])).collect()
}
