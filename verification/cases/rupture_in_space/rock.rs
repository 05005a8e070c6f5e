//! Rock around the fault, whole or a quarter of it. x is along the slip, y normal to the fault, z across the slip.
//!
//! The problem is symmetric about z = 0. About x = 0 it is antisymmetric: the mirror image of the shear traction has the other sign. So on
//! z = 0 u_z vanishes, and on x = 0 u_y and u_z do. Slip there is along x alone.

use super::super::waves::{Rock, line, mesh, problem};
use super::reference::Parameters;
use crate::CaseError;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::nodes_of_sides;
use asperity_friction::inertial::InertialPoints;
use asperity_friction::points::Components;
use asperity_friction::slip_weakening::SlipWeakening;
use asperity_mechanics::Model;
use asperity_mechanics::dynamics::{Fault, Problem, SplitPoint, Tie, dashpots};

/// Cells and extent of the rock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    pub kind: ElementKind,
    /// Spacing of nodes \[m\].
    pub spacing: f64,
    /// Half lengths along x, y and z \[m\]; waves are absorbed there.
    pub extent: [f64; 3],
    /// End of the run \[s\].
    pub end: f64,
    /// Time of viscosity over the step; it damps waves that the cells do not carry.
    pub viscosity: f64,
    /// True for all of the rock, false for the quarter x > 0, z > 0.
    pub whole: bool,
}

/// The problem, and the places (x, z) of the points of its fault \[m\], along x first.
pub(crate) fn build(p: &Parameters, span: &Span) -> Result<(Problem<3>, Vec<[f64; 2]>), CaseError> {
    let order = if span.kind == ElementKind::Hex27 { 2.0 } else { 1.0 };
    let size = order * span.spacing;
    let [x, y, z] = span.extent.map(|l| (l / size).round() * size);
    let along = |l: f64| {
        let from = if span.whole { -l } else { 0.0 };
        line(from, l, ((l - from) / size).round() as usize)
    };
    let across = |from: f64, to: f64| line(from, to, (y / size).round() as usize);
    let parts = [[along(x), across(-y, 0.0), along(z)], [along(x), across(0.0, y), along(z)]];
    let rock = Rock { density: p.density, pressure: p.cp, shear: p.cs };
    let mut problem = problem(mesh(&parts, span.kind)?, rock, Idealisation::ThreeD, span.end)?;
    let mut outer = vec!["b0.bottom", "b1.top"];
    outer.extend(["b0.right", "b1.right", "b0.front", "b1.front"]);
    if span.whole {
        outer.extend(["b0.left", "b1.left", "b0.back", "b1.back"]);
    } else {
        problem.stages[0].fixed = mirrors(&problem.model);
    }
    let sides = outer.iter().map(|s| problem.model.mesh.side_sets[*s].clone()).collect::<Vec<_>>().concat();
    problem.absorbing = dashpots(&problem.model, &problem.density, &sides);
    problem.courant = 0.8;
    problem.viscosity = span.viscosity;
    let (fault, at) = fault(&problem.model, p, span)?;
    problem.fault = Some(fault);
    Ok((problem, at))
}

/// Degrees of freedom that vanish by symmetry.
fn mirrors(model: &Model<3>) -> Vec<usize> {
    let mut fixed = Vec::new();
    for (side, components) in [("left", &[1, 2][..]), ("back", &[2])] {
        for block in ["b0", "b1"] {
            let nodes = nodes_of_sides(&model.mesh, &model.mesh.side_sets[&format!("{block}.{side}")]);
            fixed.extend(nodes.into_iter().flat_map(|n| components.iter().map(move |c| 3 * n + c)));
        }
    }
    fixed.sort_unstable();
    fixed.dedup();
    fixed
}

/// Nodes of a side, along x first.
fn nodes_on(model: &Model<3>, side: &str) -> Vec<usize> {
    let mut nodes = nodes_of_sides(&model.mesh, &model.mesh.side_sets[side]);
    let at = |n: usize| model.mesh.nodes[n];
    nodes.sort_by(|&a, &b| at(a)[2].total_cmp(&at(b)[2]).then(at(a)[0].total_cmp(&at(b)[0])));
    nodes
}

/// The fault within its borders, and the rock around it, which holds together.
fn fault(model: &Model<3>, p: &Parameters, span: &Span) -> Result<(Fault, Vec<[f64; 2]>), CaseError> {
    let areas = model.tributary_areas(&model.mesh.side_sets["b0.top"])?;
    let (mut points, mut at, mut ties) = (Vec::new(), Vec::new(), Vec::new());
    for (minus, plus) in nodes_on(model, "b0.top").into_iter().zip(nodes_on(model, "b1.bottom")) {
        let [x, _, z] = model.mesh.nodes[minus];
        // A place on the border does not slip; a hundredth of the spacing is more than rounding.
        let beyond = |v: f64, half: f64| v.abs() > half - 0.01 * span.spacing;
        if beyond(x, p.half[0]) || beyond(z, p.half[1]) {
            ties.push(Tie { minus, plus });
            continue;
        }
        let mirror = !span.whole && (x == 0.0 || z == 0.0);
        let along = if mirror { vec![[1.0, 0.0, 0.0]] } else { vec![[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]] };
        points.push(SplitPoint {
            minus,
            plus,
            area: areas[&minus],
            normal: [0.0, 1.0, 0.0],
            along,
            gap: 0.0,
        });
        at.push([x, z]);
    }
    let n = points.len();
    let law = SlipWeakening::new(p.mu_s, p.mu_d, p.length, None)?;
    let mut shear = vec![0.0; 2 * n];
    shear.iter_mut().zip(&at).for_each(|(shear, at)| *shear = traction(p, *at, span.spacing));
    let fault = Fault {
        points,
        law: Box::new(InertialPoints(vec![law; n])),
        normal: vec![p.normal; n],
        shear: Components::new(shear, n),
        rate: Components::new(vec![0.0; 2 * n], n),
        opens: false,
        regularisation: None,
        pulses: Vec::new(),
        forced: Vec::new(),
        onset: None,
        ties,
    };
    Ok((fault, at))
}

/// Initial traction. A node on the border of the square represents cells on both sides, and has their mean.
fn traction(p: &Parameters, at: [f64; 2], spacing: f64) -> f64 {
    let [half, high] = p.square;
    let share: f64 = at.iter().map(|v| (0.5 + (half - v.abs()) / spacing).clamp(0.0, 1.0)).product();
    p.shear + share * (high - p.shear)
}
