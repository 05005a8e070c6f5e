//! Bodies for waves, built without scenes: their initial velocities are functions.

use crate::CaseError;
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::{Mesh, generate::Grid, nodes_of_sides};
use asperity_mechanics::dynamics::{Explicit, Problem, SplitPoint};
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

/// A mesh of rectangles or boxes, one block for each set of lines.
///
/// # Errors
/// If the lines are not ascending.
pub fn mesh<const D: usize>(parts: &[[Vec<f64>; D]], kind: ElementKind) -> Result<Mesh<D>, CaseError> {
    let mut mesh = Mesh::<D>::default();
    for (k, lines) in parts.iter().enumerate() {
        mesh.append(Grid { lines: lines.clone(), kind }.mesh()?, &format!("b{k}"));
    }
    Ok(mesh)
}

/// A problem without faults, at rest, in one stage of this length \[s\].
///
/// # Errors
/// If the material is not admissible.
pub fn problem<const D: usize>(
    mesh: Mesh<D>,
    rock: Rock,
    idealisation: Idealisation,
    end: f64,
) -> Result<Problem<D>, CaseError> {
    let rocks = vec![rock; mesh.blocks.len()];
    problem_of(mesh, &rocks, idealisation, end)
}

/// The same with a rock for each block of the mesh.
///
/// # Errors
/// If a material is not admissible.
pub fn problem_of<const D: usize>(
    mesh: Mesh<D>,
    rocks: &[Rock],
    idealisation: Idealisation,
    end: f64,
) -> Result<Problem<D>, CaseError> {
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
    let stage = Stage::free("waves", end);
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

/// Nodes of a side with their x, ascending \[m\].
pub fn nodes_on(model: &Model<2>, side: &str) -> Vec<(usize, f64)> {
    let nodes = nodes_of_sides(&model.mesh, &model.mesh.side_sets[side]);
    let mut nodes: Vec<(usize, f64)> = nodes.into_iter().map(|n| (n, model.mesh.nodes[n][0])).collect();
    nodes.sort_by(|a, b| a.1.total_cmp(&b.1));
    nodes
}

/// A cut between the top of block 0 and the bottom of block 1.
pub struct Cut {
    /// x of the points, ascending \[m\].
    pub at: Vec<f64>,
    /// The points, which slip along x.
    pub points: Vec<SplitPoint>,
}

/// The cut of a model in antiplane motion or in the plane.
///
/// # Errors
/// If the areas of the points cannot be computed.
pub fn cut(model: &Model<2>) -> Result<Cut, CaseError> {
    let (minus, plus) = (nodes_on(model, "b0.top"), nodes_on(model, "b1.bottom"));
    let areas = model.tributary_areas(&model.mesh.side_sets["b0.top"])?;
    let normal = if model.idealisation == Idealisation::Antiplane { [0.0; 3] } else { [0.0, 1.0, 0.0] };
    let point = |((minus, _), (plus, _)): (&(usize, f64), &(usize, f64))| SplitPoint {
        minus: *minus,
        plus: *plus,
        area: areas[minus],
        normal,
        along: vec![[1.0, 0.0, 0.0]],
        gap: 0.0,
    };
    let points = minus.iter().zip(&plus).map(point).collect();
    Ok(Cut { at: minus.into_iter().map(|m| m.1).collect(), points })
}

/// The smooth bump exp(x²/(x² - R²)) within the radius R, 0 outside.
pub fn bump(x: f64, radius: f64) -> f64 {
    let (x2, r2) = (x * x, radius * radius);
    if x2 < r2 { (x2 / (x2 - r2)).exp() } else { 0.0 }
}

/// Runs the only stage to its end, and shows each step.
///
/// # Errors
/// If a step cannot be taken.
pub fn run<'a, const D: usize>(
    problem: &'a Problem<D>,
    mut watch: impl FnMut(&mut Explicit<'a, D>),
) -> Result<Explicit<'a, D>, CaseError> {
    let mut run = Explicit::new(problem)?;
    run.begin_stage(0)?;
    let steps = (problem.stages[0].end / run.dt()).round() as usize;
    for _ in 0..steps {
        run.step().map_err(|halt| halt.to_string())?;
        watch(&mut run);
    }
    Ok(run)
}
