//! Hertz contacts of the cases: scenes with single changes, tractions of a run, closed-form solutions.

use crate::{CaseError, Cost, Ledger, Plot, Series};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene as reader;
use asperity_plan::reading::scene::model::{
    BlockMesh, LawSpec, Measure, MeshSource, Motion, Scene, Sliding, SpacingSpec, here,
};
use asperity_plan::reading::scene::units::{Length, Penalty};
use asperity_run::report::Outcome;
use std::f64::consts::PI;

/// Reads a scene of the product or of a case.
pub fn read(text: &str) -> Result<Scene, CaseError> {
    reader::read(text).map_err(|e| e.to_string().into())
}

/// `scenes/hertz.toml` with its stage "press" alone, without friction.
pub fn line() -> Result<Scene, CaseError> {
    let mut scene = sheared()?;
    scene.stages.truncate(1);
    scene.stages[0].frictionless.clear();
    for interface in scene.interfaces.values_mut() {
        interface.law = None;
        interface.enforcement.tangential = None;
    }
    Ok(scene)
}

/// `scenes/hertz.toml`.
pub fn sheared() -> Result<Scene, CaseError> {
    read(include_str!("../../scenes/hertz.toml"))
}

fn blocks(scene: &mut Scene) -> impl Iterator<Item = &mut BlockMesh> {
    scene.bodies.values_mut().filter_map(|body| match &mut body.mesh {
        MeshSource::Block(mesh) => Some(mesh),
        _ => None,
    })
}

/// Cells `times` smaller in the contact zones of all bodies, with the penalty scaled accordingly.
pub fn refined(mut scene: Scene, times: f64) -> Scene {
    for mesh in blocks(&mut scene) {
        for axis in mesh.spacing.iter_mut().flat_map(|s| s.get_mut()) {
            if let SpacingSpec::Zone(zone) = axis.get_mut() {
                zone.size = Length(zone.size.0 / times);
            }
        }
    }
    stiffened(scene, times)
}

/// Another cell size in the contact zone of one body \[m\].
pub fn sized(mut scene: Scene, body: &str, size: f64) -> Result<Scene, CaseError> {
    let body = scene.bodies.get_mut(body).ok_or_else(|| format!("no body {body}"))?;
    if let MeshSource::Block(mesh) = &mut body.mesh {
        for axis in mesh.spacing.iter_mut().flat_map(|s| s.get_mut()) {
            if let SpacingSpec::Zone(zone) = axis.get_mut() {
                zone.size = Length(size);
            }
        }
    }
    Ok(scene)
}

/// Penalties times `factor`.
pub fn stiffened(mut scene: Scene, factor: f64) -> Scene {
    let times = |p: &Penalty| match p {
        Penalty::Value(v) => Penalty::Value(v * factor),
        Penalty::YoungPerSize(v) => Penalty::YoungPerSize(v * factor),
    };
    for interface in scene.interfaces.values_mut() {
        let e = &mut interface.enforcement;
        e.normal = here(times(e.normal.get_ref()));
        e.tangential = e.tangential.take().map(|t| here(times(t.get_ref())));
    }
    scene
}

/// Another element in all bodies.
pub fn with_element(mut scene: Scene, element: &str) -> Scene {
    blocks(&mut scene).for_each(|mesh| mesh.element = here(element.to_string()));
    scene
}

/// Another measure and kind of sliding.
pub fn measured(mut scene: Scene, measure: Measure, sliding: Sliding) -> Scene {
    for interface in scene.interfaces.values_mut() {
        interface.measure = here(measure);
        interface.sliding = here(sliding);
    }
    scene
}

/// Another friction coefficient.
pub fn with_friction(mut scene: Scene, mu: f64) -> Scene {
    for interface in scene.interfaces.values_mut() {
        interface.law = Some(here(LawSpec {
            kind: Some(here("coulomb".into())),
            mu: Some(here(mu)),
            ..LawSpec::default()
        }));
    }
    scene
}

/// Another displacement of a set along y at the end of stage "press" \[m\].
pub fn pressed_by(mut scene: Scene, set: &str, depth: f64) -> Scene {
    for condition in &mut scene.stages[0].conditions {
        let condition = condition.get_mut();
        if condition.set.as_ref().is_some_and(|s| s.get_ref() == set) {
            condition.y = Some(here(Motion::To(-depth)));
        }
    }
    scene
}

/// A completed run.
pub struct HertzRun {
    /// Report.
    pub report: RunReport,
    /// Recorded fields.
    pub record: Recorder,
    /// Cost.
    pub cost: Cost,
}

/// Runs a scene to completion.
pub fn simulate(scene: &Scene) -> Result<HertzRun, CaseError> {
    let mut record = Recorder::new();
    let (report, cost) = Cost::measure(|| -> Result<RunReport, CaseError> {
        let plan = bodies::plan(scene).map_err(|e| e.to_string())?;
        Ok(kinds::bodies::run(&plan, &mut record)?)
    });
    let report = report?;
    if let Outcome::Stopped { reason, .. } = &report.outcome {
        return Err(format!("stopped: {reason}").into());
    }
    let cost = cost.counts(&report.counts);
    Ok(HertzRun { report, record, cost })
}

/// Tractions along the slave side at the end of a stage in SI units, sorted by a coordinate, usually x.
pub struct Tractions {
    /// Forces on the first force set of the scene: along x, and the magnitude of that along y.
    pub load: [f64; 2],
    /// Coordinates.
    pub x: Vec<f64>,
    /// Tributary areas.
    pub area: Vec<f64>,
    /// Averaged pressure.
    pub p: Vec<f64>,
    /// Pressure at the points; on a mortar interface, its coefficients.
    pub coefficient: Vec<f64>,
    /// Averaged shear traction.
    pub q: Vec<f64>,
    /// 0 open, 1 stick, 2 slip.
    pub status: Vec<u8>,
}

impl HertzRun {
    /// Tractions at the end of a stage.
    pub fn tractions(&self, stage: &str) -> Result<Tractions, CaseError> {
        self.tractions_by(stage, |x| x[0])
    }

    /// Tractions at the end of a stage against a coordinate of the points.
    pub fn tractions_by(
        &self,
        stage: &str,
        coordinate: impl Fn([f64; 3]) -> f64,
    ) -> Result<Tractions, CaseError> {
        let end = self.record.stage_end(stage).ok_or_else(|| format!("stage {stage} was not reached"))?;
        let at = self.record.times().iter().position(|t| *t == end.time).ok_or("no step ends the stage")?;
        let force = self.record.samples()[at].forces.first().ok_or("the scene has no forces")?;
        let (mesh, f) = (&self.record.setup().interfaces[0], &end.interfaces[0]);
        let x: Vec<f64> = mesh.positions.iter().map(|&x| coordinate(x)).collect();
        let mut order: Vec<usize> = (0..x.len()).collect();
        order.sort_by(|&a, &b| x[a].total_cmp(&x[b]));
        let pick = |v: &[f64]| -> Vec<f64> { order.iter().map(|&k| v[k]).collect() };
        Ok(Tractions {
            load: [force[0], force[1].abs()],
            x: pick(&x),
            area: pick(&mesh.areas),
            p: pick(&f.mean_normal_traction),
            coefficient: pick(&f.normal_traction),
            q: pick(&f.mean_shear_traction),
            status: order.iter().map(|&k| f.status[k]).collect(),
        })
    }
}

/// Half-width (or radius) a and peak pressure p0 of a contact.
#[derive(Clone, Copy, Debug)]
pub struct Hertz {
    /// \[m\]
    pub a: f64,
    /// \[Pa\]
    pub p0: f64,
}

/// 1/E* of two materials.
pub fn compliance(bodies: [(f64, f64); 2]) -> f64 {
    bodies.iter().map(|(young, poisson)| (1.0 - poisson * poisson) / young).sum()
}

impl Hertz {
    /// Line contact under the load P per length: a² = 4 P R/(π E*), p0 = 2 P/(π a).
    pub fn line(load: f64, radius: f64, compliance: f64) -> Self {
        let a = (4.0 * load * radius * compliance / PI).sqrt();
        Self { a, p0: 2.0 * load / (PI * a) }
    }

    /// Ball under the load P: a³ = 3 P R/(4 E*), p0 = 3 P/(2 π a²).
    pub fn ball(load: f64, radius: f64, compliance: f64) -> Self {
        let a = (0.75 * load * radius * compliance).cbrt();
        Self { a, p0: 1.5 * load / (PI * a * a) }
    }

    /// Pressure at the distance x.
    pub fn pressure(&self, x: f64) -> f64 {
        self.p0 * (1.0 - (x / self.a).powi(2)).max(0.0).sqrt()
    }

    /// Shear traction of Cattaneo and Mindlin in a line contact with a stick zone of half-width c.
    pub fn shear(&self, x: f64, mu: f64, c: f64) -> f64 {
        let inner = (1.0 - (x / c).powi(2)).max(0.0).sqrt();
        mu * (self.pressure(x) - self.p0 * c / self.a * inner)
    }
}

impl Tractions {
    /// Error in L2 over the nodes with |x| ≤ 1.2 a, relative to the exact field's norm there.
    pub fn l2(&self, values: &[f64], a: f64, exact: impl Fn(f64) -> f64) -> f64 {
        let (mut error, mut norm) = (0.0, 0.0);
        for ((x, area), v) in self.x.iter().zip(&self.area).zip(values) {
            if x.abs() <= 1.2 * a {
                error += area * (v - exact(*x)).powi(2);
                norm += area * exact(*x).powi(2);
            }
        }
        (error / norm).sqrt()
    }

    /// Largest averaged pressure.
    pub fn peak(&self) -> f64 {
        self.p.iter().copied().fold(0.0, f64::max)
    }

    /// a and p0 of the ellipse p² = p0² (1 - x²/a²) fitted to the pressures of the nodes within 0.9 `a`, weighted by their areas.
    pub fn ellipse(&self, a: f64) -> Hertz {
        let (mut n, mut s, mut ss, mut t, mut st) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for ((x, w), p) in self.x.iter().zip(&self.area).zip(&self.p) {
            if x.abs() < 0.9 * a {
                let (u, v) = ((x / a).powi(2), p * p);
                n += w;
                s += w * u;
                ss += w * u * u;
                t += w * v;
                st += w * u * v;
            }
        }
        let slope = (n * st - s * t) / (n * ss - s * s);
        let top = (t - slope * s) / n;
        Hertz { a: a * (-top / slope).sqrt(), p0: top.sqrt() }
    }
}

/// Plots averaged pressures of runs with the Hertz ellipse at their own loads.
pub fn ellipse(ledger: &mut Ledger, runs: &[(&str, &Tractions, &Hertz)]) {
    const SHOWN: f64 = 1.4;
    let mut plot = Plot::xy("Pressure over the ellipse of Hertz", "x/a [-]", "p/p0 [-]");
    for (name, at, exact) in runs {
        let points = at.x.iter().zip(&at.p).map(|(x, p)| (x / exact.a, p / exact.p0));
        let points: Vec<(f64, f64)> = points.filter(|(x, _)| x.abs() <= SHOWN).collect();
        plot = plot.series(Series::points(*name, &points));
    }
    let first = runs.iter().flat_map(|(_, at, exact)| at.x.iter().map(|x| x / exact.a));
    let start = if first.fold(0.0, f64::min) < -0.5 { -1.0 } else { 0.0 };
    let curve: Vec<(f64, f64)> = (0..=400)
        .map(|k| start + (1.0 - start) * f64::from(k) / 400.0)
        .map(|x| (x, (1.0 - x * x).max(0.0).sqrt()))
        .collect();
    ledger.plot(plot.series(Series::line("Hertz", &curve)).caption("At the load of each run."));
}
