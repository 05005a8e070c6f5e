//! Two bodies with one interface, as scenes a user could write.

use crate::{CaseError, Cost};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::InterfaceFields;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use asperity_run::report::Outcome;

/// A scene of two bodies; the strings are parts of its file.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Kinematics of the scene.
    pub kinematics: &'static str,
    /// Meshes of the lower and the upper body.
    pub meshes: [String; 2],
    /// Young's modulus \[Pa\] and Poisson's ratio.
    pub elastic: (f64, f64),
    /// Acceleration on the upper body.
    pub gravity: String,
    /// Slave and master sets.
    pub sets: [&'static str; 2],
    /// Contact measure.
    pub measure: &'static str,
    /// Small or finite sliding.
    pub sliding: &'static str,
    /// Normal and tangential penalty.
    pub penalty: String,
    /// Coefficient of friction; frictionless if none.
    pub mu: Option<f64>,
    /// Boundary conditions of the stages, each of one second.
    pub stages: Vec<String>,
    /// Steps per stage; adaptive if none.
    pub steps: Option<usize>,
}

/// A block of quad4 or hex8.
pub fn block(min: &[f64], max: &[f64], divisions: &[usize]) -> String {
    let element = if min.len() == 2 { "quad4" } else { "hex8" };
    format!(
        "mesh.block = {{ min = {min:?}, max = {max:?}, divisions = {divisions:?}, element = \"{element}\" }}"
    )
}

impl Pair {
    /// Two blocks of E = 1 GPa with node-to-point contact and finite sliding, frictionless, one step a stage.
    pub fn new(lower: String, upper: String, stages: &[&str]) -> Self {
        Self {
            kinematics: "plane-strain",
            meshes: [lower, upper],
            elastic: (1e9, 0.3),
            gravity: String::new(),
            sets: ["upper.bottom", "lower.top"],
            measure: "node-to-point",
            sliding: "finite",
            penalty: "\"100 E/h\"".into(),
            mu: None,
            stages: stages.iter().map(ToString::to_string).collect(),
            steps: Some(1),
        }
    }

    /// Text of the scene file.
    pub fn text(&self) -> String {
        let (young, poisson) = self.elastic;
        let [lower, upper] = &self.meshes;
        let gravity = match self.gravity.as_str() {
            "" => String::new(),
            g => format!("gravity = {g}\n"),
        };
        let (tangential, law) = match self.mu {
            Some(mu) => (
                format!(", tangential = {}", self.penalty),
                format!("law = {{ kind = \"coulomb\", mu = {mu:?} }}\n"),
            ),
            None => (String::new(), String::new()),
        };
        let [slave, master] = self.sets;
        let mut text = format!(
            "schema = 1\ntitle = \"hard contact\"\nkinematics = \"{}\"\n[materials.m]\nyoung = {young:?}\npoisson = {poisson:?}\n\
             density = 2000.0\n[bodies.lower]\n{lower}\nmaterial = \"m\"\n[bodies.upper]\n{upper}\nmaterial = \"m\"\n{gravity}\
             [interfaces.contact]\nslave = \"{slave}\"\nmaster = \"{master}\"\nmeasure = \"{}\"\nsliding = \"{}\"\n\
             enforcement = {{ kind = \"penalty\", normal = {}{tangential} }}\n{law}",
            self.kinematics, self.measure, self.sliding, self.penalty
        );
        for (k, conditions) in self.stages.iter().enumerate() {
            let steps = self.steps.map_or(String::new(), |n| format!("steps = {n}\n"));
            text += &format!(
                "[[stages]]\nname = \"{}\"\nduration = 1\n{steps}conditions = [{conditions}]\n",
                k + 1
            );
        }
        text + "[time]\nstepper = \"implicit\"\n"
    }

    /// Runs the scene.
    pub fn run(&self) -> Result<HardContactRun, CaseError> {
        HardContactRun::from_text(&self.text())
    }
}

/// A run, completed or stopped.
#[derive(Debug)]
pub struct HardContactRun {
    /// Text of the scene.
    pub scene: String,
    /// Report.
    pub report: RunReport,
    /// Record.
    pub record: Recorder,
    /// Cost.
    pub cost: Cost,
}

impl HardContactRun {
    /// Runs the scene in `text`.
    pub fn from_text(text: &str) -> Result<Self, CaseError> {
        let scene = scene::read(text).map_err(|e| format!("{e}\n{text}"))?;
        let plan = bodies::plan(&scene).map_err(|e| e.to_string())?;
        let mut record = Recorder::new().with_bodies().at_all_nodes();
        let (report, cost) = Cost::measure(|| kinds::bodies::run(&plan, &mut record));
        let report = report?;
        let cost = cost.counts(&report.counts);
        Ok(Self { scene: text.to_owned(), report, record, cost })
    }

    /// Fields at the end of the last stage.
    pub fn end(&self) -> Result<&InterfaceFields, CaseError> {
        if let Outcome::Stopped { reason, .. } = &self.report.outcome {
            return Err(format!("stopped: {reason}").into());
        }
        Ok(&self.record.stage_ends().last().ok_or("no stage was completed")?.interfaces[0])
    }

    /// Time of the last good state and the reason why the run stopped there.
    pub fn stopped(&self) -> Result<(f64, &str), CaseError> {
        match &self.report.outcome {
            Outcome::Completed | Outcome::Interrupted { .. } => Err("the run did not stop by itself".into()),
            Outcome::Stopped { time, reason, .. } => Ok((*time, reason)),
        }
    }

    /// Sum of a field times the nodal areas \[N/m\].
    pub fn total(&self, field: &[f64]) -> f64 {
        field.iter().zip(self.record.areas(0)).map(|(f, a)| f * a).sum()
    }

    /// Largest number of iterations of a step, without those of failed trials.
    pub fn most_iterations(&self) -> f64 {
        self.record.records().iter().map(|s| s.iterations).max().unwrap_or(0) as f64
    }
}
