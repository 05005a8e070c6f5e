//! The sandwich benchmark as the cases use it: the product's scene file, with one setting changed at a time.

use crate::CaseError;
use asperity::kinds;
use asperity::kinds::bodies::{RunReport, mean};
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::InterfaceFields;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
pub use asperity_plan::reading::scene::model::Scene;
use asperity_plan::reading::scene::model::{MeshSource, Stepper, here};
use asperity_plan::reading::scene::units::{Length, Penalty, Pressure, Velocity};
use asperity_run::report::Outcome;

/// Young's modulus of the benchmark \[Pa\].
pub const YOUNG: f64 = 44.8e9;
/// Poisson's ratio of the benchmark.
pub const POISSON: f64 = 0.12;
/// Displacement of the pressed face \[m\].
pub const U_X: f64 = 0.00966e-3;
/// Loading rate \[m/s\].
pub const V_LOAD: f64 = 1e-6;
/// End of stage 1 \[s\].
pub const PRESSED: f64 = 9.66;

/// A finished run.
pub struct Run {
    /// Report.
    pub report: RunReport,
    /// Histories at all slave nodes.
    pub record: Recorder,
}

impl Run {
    /// Fields of the fault at the end of a stage.
    pub fn end(&self, stage: &str) -> Result<&InterfaceFields, CaseError> {
        Ok(&self.record.stage_end(stage).ok_or_else(|| format!("stage {stage} was not reached"))?.interfaces
            [0])
    }

    /// Area-weighted mean of the normal traction at the end of a stage \[MPa\].
    pub fn mean_normal(&self, stage: &str) -> Result<f64, CaseError> {
        Ok(mean(&self.end(stage)?.normal_traction, self.record.areas(0)) * 1e-6)
    }

    /// Heights y of the slave nodes \[m\].
    pub fn heights(&self) -> Vec<f64> {
        self.record.setup().interfaces[0].positions.iter().map(|p| p[1]).collect()
    }

    /// Slave node at height `y` \[m\].
    pub fn node_at(&self, y: f64) -> Result<usize, CaseError> {
        let heights = self.heights();
        heights
            .iter()
            .position(|h| (h - y).abs() < 1e-9)
            .ok_or_else(|| format!("no slave node at y = {y}").into())
    }

    /// |slip| at heights `y` at the end of the run \[um\].
    pub fn final_slip(&self, y: &[f64]) -> Result<Vec<f64>, CaseError> {
        let slip = &self.end("shear")?.slip;
        y.iter().map(|&y| Ok(slip[self.node_at(y)?].abs() * 1e6)).collect()
    }

    /// |slip| at a node, interpolated linearly at times \[s\], in \[um\].
    pub fn slip_at(&self, node: usize, times: &[f64]) -> Vec<f64> {
        let t = self.record.times();
        let slip = &self.record.histories()[0].points[node].slip;
        times
            .iter()
            .map(|&time| {
                let k = t.partition_point(|&x| x < time * (1.0 - 1e-12)).min(t.len() - 1);
                if k == 0 || (t[k] - time).abs() <= 1e-9 * time {
                    return slip[k].abs() * 1e6;
                }
                let s = (time - t[k - 1]) / (t[k] - t[k - 1]);
                (slip[k - 1] + s * (slip[k] - slip[k - 1])).abs() * 1e6
            })
            .collect()
    }
}

/// The product's scene file, read by the public reader.
pub fn base() -> Result<Scene, CaseError> {
    scene::read(include_str!("../../scenes/sandwich.toml"))
        .map_err(|e| format!("scenes/sandwich.toml: {e}").into())
}

/// Mesh generator of a body, for changes.
fn mesh_of<'a>(scene: &'a mut Scene, body: &str) -> &'a mut scene::model::BlockMesh {
    let body = scene.bodies.get_mut(body).expect("the sandwich has bodies A and B");
    let MeshSource::Block(mesh) = &mut body.mesh else { unreachable!("both are rectangular blocks") };
    mesh
}

/// Sets the element size h \[mm\] in both bodies.
pub fn size(mut scene: Scene, h: f64) -> Scene {
    for body in ["A", "B"] {
        mesh_of(&mut scene, body).size = Some(here(Length(h * 1e-3)));
    }
    scene
}

/// The scene without overhang: B as high as A.
pub fn no_overhang(mut scene: Scene) -> Scene {
    let mesh = mesh_of(&mut scene, "B");
    mesh.min = here(vec![Length(25e-3), Length(0.0)]);
    mesh.max = here(vec![Length(50e-3), Length(50e-3)]);
    scene
}

/// The scene with block A 50 mm wide.
pub fn wide(mut scene: Scene) -> Scene {
    mesh_of(&mut scene, "A").min = here(vec![Length(-25e-3), Length(0.0)]);
    scene
}

/// Sets the penalties to `factor` times 100 E/h.
pub fn penalty(mut scene: Scene, factor: f64) -> Scene {
    for interface in scene.interfaces.values_mut() {
        interface.enforcement.normal = here(Penalty::YoungPerSize(100.0 * factor));
        interface.enforcement.tangential = Some(here(Penalty::YoungPerSize(100.0 * factor)));
    }
    scene
}

/// Sets Young's modulus to `factor` times [`YOUNG`].
pub fn young(mut scene: Scene, factor: f64) -> Scene {
    for material in scene.materials.values_mut() {
        material.young = here(Pressure(YOUNG * factor));
    }
    scene
}

/// Sets Poisson's ratio.
pub fn poisson(mut scene: Scene, nu: f64) -> Scene {
    for material in scene.materials.values_mut() {
        material.poisson = here(nu);
    }
    scene
}

/// Sets the reference slip rate, given over the loading rate.
pub fn reference_rate(mut scene: Scene, over_load: f64) -> Scene {
    for interface in scene.interfaces.values_mut() {
        if let Some(law) = &mut interface.law {
            law.get_mut().v_ref = Some(here(Velocity(V_LOAD * over_load)));
        }
    }
    scene
}

/// The scene with friction in stage 1 as well.
pub fn frictional(mut scene: Scene) -> Scene {
    scene.stages[0].frictionless.clear();
    scene
}

/// Stage 1 only, in one step (it is linear without friction).
pub fn press_only(mut scene: Scene) -> Scene {
    scene.stages.truncate(1);
    scene.stages[0].steps = Some(here(1));
    scene
}

/// `n` equal steps in stage 2, one in stage 1.
pub fn equal_steps(mut scene: Scene, n: usize) -> Scene {
    scene.stages[0].steps = Some(here(1));
    scene.stages[1].steps = Some(here(n));
    scene
}

/// The static-explicit stepper, without correction.
pub fn static_explicit(mut scene: Scene) -> Scene {
    scene.time.stepper = here(Stepper::StaticExplicit);
    scene.time.tolerance = None;
    scene.time.drift = Some(here(1.0));
    scene
}

/// Sets the tolerance of the implicit stepper: local error of slip per step \[m\].
pub fn tolerance(mut scene: Scene, metres: f64) -> Scene {
    scene.time.tolerance = Some(here(Length(metres)));
    scene
}

/// Runs a scene to its end, keeping histories at all slave nodes.
pub fn simulate(scene: &Scene) -> Result<Run, CaseError> {
    let plan = bodies::plan(scene).map_err(|e| e.to_string())?;
    let mut record = Recorder::new().at_all_nodes();
    let report = kinds::bodies::run(&plan, &mut record)?;
    match &report.outcome {
        Outcome::Completed => finite(&record).map(|()| Run { report, record }),
        Outcome::Stopped { reason, time, .. } => Err(format!("stopped at {time} s: {reason}").into()),
        Outcome::Interrupted { .. } => Err("interrupted".into()),
    }
}

/// Rejects a run that contains NaN, which a later maximum could hide.
fn finite(record: &Recorder) -> Result<(), CaseError> {
    for point in record.histories().iter().flat_map(|h| &h.points) {
        for field in [
            &point.slip,
            &point.slip_rate,
            &point.friction,
            &point.normal_traction,
            &point.shear_traction,
            &point.relative_displacement,
        ] {
            if let Some(step) = field.iter().position(|v| !v.is_finite()) {
                return Err(format!("node {}: a value of step {} is not finite", point.node, step + 1).into());
            }
        }
    }
    match record.records().iter().find(|r| !(r.drift.is_finite() && r.residual_ratio.is_finite())) {
        None => Ok(()),
        Some(r) => Err(format!("drift or residual of step {} is not finite", r.step).into()),
    }
}

/// Limit of a sequence on meshes of halved size, and its observed order, from the last three values (Richardson).
pub fn limit(values: &[f64]) -> (f64, f64) {
    let n = values.len();
    let (a, b, c) = (values[n - 3], values[n - 2], values[n - 1]);
    let ratio = (b - a) / (c - b);
    (c + (c - b) / (ratio - 1.0), ratio.log2())
}

/// Sets the element of both bodies.
pub fn element(mut scene: Scene, name: &str) -> Scene {
    for body in ["A", "B"] {
        mesh_of(&mut scene, body).element = here(name.to_string());
    }
    scene
}

/// The scene as a three-dimensional layer of `thickness` \[mm\] in z, held in z on both faces: plane strain.
pub fn layer(mut scene: Scene, thickness: f64, name: &str) -> Scene {
    use asperity_plan::reading::scene::model::{Condition, Kinematics, Motion};
    scene.kinematics = here(Kinematics::ThreeD);
    for body in ["A", "B"] {
        let mesh = mesh_of(&mut scene, body);
        mesh.min.get_mut().push(Length(0.0));
        mesh.max.get_mut().push(Length(thickness * 1e-3));
        mesh.element = here(name.to_string());
        for face in ["back", "front"] {
            scene.stages[0].conditions.push(here(Condition {
                set: Some(here(format!("{body}.{face}"))),
                z: Some(here(Motion::Fixed(0.0))),
                ..Condition::default()
            }));
        }
    }
    scene
}

/// Imposes the step ends of another run.
pub fn imposed(mut scene: Scene, ends: &[f64]) -> Scene {
    for stage in &mut scene.stages {
        stage.steps = None;
    }
    scene.time.imposed = Some(ends.to_vec());
    scene
}
