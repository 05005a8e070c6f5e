//! Bodies for waves, built without scenes: their initial velocities are functions.

use crate::CaseError;
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::{Mesh, generate::Grid};
use asperity_mechanics::dynamics::{Explicit, Problem};
use asperity_mechanics::{Body, CellBlock, Model, Stage};

/// An elastic material by its density \[kg/m³\] and wave speeds \[m/s\].
#[derive(Clone, Copy, Debug)]
pub struct Rock {
    /// ρ.
    pub density: f64,
    /// c_p.
    pub pressure: f64,
    /// c_s.
    pub shear: f64,
}

impl Rock {
    fn elastic(self) -> Result<Elastic, CaseError> {
        let (p, s) = (self.pressure * self.pressure, self.shear * self.shear);
        let poisson = (p - 2.0 * s) / (2.0 * (p - s));
        Ok(Elastic::new(2.0 * self.density * s * (1.0 + poisson), poisson)?)
    }
}

/// Lines from `from` to `to` in `n` equal parts.
pub fn line(from: f64, to: f64, n: usize) -> Vec<f64> {
    (0..=n).map(|k| from + (to - from) * k as f64 / n as f64).collect()
}

/// A mesh of rectangles, one block for each pair of lines.
///
/// # Errors
/// If the lines are not ascending.
pub fn mesh(parts: &[[Vec<f64>; 2]], kind: ElementKind) -> Result<Mesh<2>, CaseError> {
    let mut mesh = Mesh::<2>::default();
    for (k, lines) in parts.iter().enumerate() {
        mesh.append(Grid { lines: lines.clone(), kind }.mesh()?, &format!("b{k}"));
    }
    Ok(mesh)
}

/// A problem without faults, at rest, in one stage of this length \[s\].
///
/// # Errors
/// If the material is not admissible.
pub fn problem(
    mesh: Mesh<2>,
    rock: Rock,
    idealisation: Idealisation,
    end: f64,
) -> Result<Problem<2>, CaseError> {
    let rocks = vec![rock; mesh.blocks.len()];
    problem_of(mesh, &rocks, idealisation, end)
}

/// The same with a rock for each block of the mesh.
///
/// # Errors
/// If a material is not admissible.
pub fn problem_of(
    mesh: Mesh<2>,
    rocks: &[Rock],
    idealisation: Idealisation,
    end: f64,
) -> Result<Problem<2>, CaseError> {
    let elastic = rocks.iter().map(|r| r.elastic()).collect::<Result<Vec<_>, _>>()?;
    let block = |k: usize| LinearBlock::new(&mesh, k, &elastic[k], idealisation, Formulation::Standard);
    let blocks = (0..mesh.blocks.len())
        .map(|k| Ok(CellBlock::Linear(Box::new(block(k)?))))
        .collect::<Result<Vec<_>, CaseError>>()?;
    let body = |k: usize| Body {
        name: format!("b{k}"),
        nodes: 0..mesh.nodes.len(),
        blocks: k..k + 1,
        elastic: vec![elastic[k]],
        size: None,
        parts: Vec::new(),
        nonlinear: None,
        dofs: 0..mesh.nodes.len() * idealisation.components(),
    };
    let bodies = (0..mesh.blocks.len()).map(body).collect();
    let density = rocks.iter().map(|r| r.density).collect();
    let stage = Stage {
        name: "waves".into(),
        start: 0.0,
        end,
        steps: None,
        frictionless: Vec::new(),
        motions: Vec::new(),
        turning: Vec::new(),
        loads: Vec::new(),
        fixed: Vec::new(),
        springs: Vec::new(),
        weight: Vec::new(),
    };
    Ok(Problem {
        model: Model { scale: 1.0, mesh, blocks, bodies, idealisation },
        density,
        courant: 0.9,
        viscosity: 0.0,
        fault: None,
        absorbing: Vec::new(),
        stages: vec![stage],
        velocity: Vec::new(),
    })
}

/// Runs the only stage to its end, and shows each step.
///
/// # Errors
/// If a step cannot be taken.
pub fn run<'a>(
    problem: &'a Problem<2>,
    mut watch: impl FnMut(&mut Explicit<'a, 2>),
) -> Result<Explicit<'a, 2>, CaseError> {
    let mut run = Explicit::new(problem)?;
    run.begin_stage(0)?;
    let steps = (problem.stages[0].end / run.dt()).round() as usize;
    for _ in 0..steps {
        run.step().map_err(|halt| halt.to_string())?;
        watch(&mut run);
    }
    Ok(run)
}
