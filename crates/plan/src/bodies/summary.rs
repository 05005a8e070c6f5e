//! Text of the plan.

use super::Summary;
use super::assembly::Assembly;
use super::path::{finite, full_because};
use crate::reading::scene::model::{Formulation, Kinematics, Scene};
use crate::shared::amounts;
use crate::shared::memory::ModelMemory;
use asperity_contact::TimeRule;
use asperity_fem::nonlinear::Material;
use asperity_mechanics::solver::{Solver, retained as retained_by};
use asperity_mechanics::{
    CellBlock, Measure, Model, Path, PlannedEnforcement, PlannedInterface, Stage, Stepping, interface_nodes,
};

/// Summary of a plan, except for the findings about its initial state.
pub fn summarise<const D: usize>(
    assembly: &Assembly<'_, D>,
    path: Path,
    solver: &Solver,
    remarks: Vec<String>,
) -> Summary {
    let Assembly { scene, model, stages, stepping, interfaces, .. } = assembly;
    let mut physics = bodies_in_words(scene, model);
    let mut state_bytes = 0;
    let (mut retained, mut unknowns) = (0, 0);
    for i in interfaces {
        let friction = i.law.as_ref().filter(|l| !l.bonded()).map_or("no friction".to_string(), |l| {
            state_bytes += 2 * l.states() * i.slave.len() * size_of::<f64>();
            let damping = i.damping.map_or_else(String::new, |eta| format!(", damped by {eta:.4e} Pa s/m"));
            format!("{} friction with {} state variables a point{damping}", l.name(), l.states())
        });
        physics.push(format!(
            "interface `{}`: {} {}, {} slave nodes against {} master faces, {friction}",
            i.name,
            match i.measure {
                Measure::NodeToPoint => "node-to-point",
                Measure::Mortar => "mortar",
            },
            enforced(i),
            i.slave.len(),
            i.master_faces.len()
        ));
        retained += interface_nodes(i).len() * D;
        unknowns += i.unknowns;
    }
    let kept = |stages: &[Stage]| retained_by(model, interfaces, stages).iter().map(Vec::len).sum::<usize>();
    // Sets on springs are kept beside the interfaces.
    retained += kept(stages) - kept(&[]);
    physics.extend(springs_in_words(stages));
    let (path_text, system_dofs) = match (path, scene.time.path) {
        (Path::Condensed, _) => {
            let small = if finite(interfaces) { "" } else { " and sliding is small" };
            (
                format!(
                    "condensed: bodies are linear{small}, so each is factored once and only the interface is solved"
                ),
                retained,
            )
        }
        (Path::Full, _) => (full_because(scene, model, interfaces), model.dofs()),
    };
    Summary {
        physics,
        path: path_text,
        solver: format!(
            "{}; about {} of the {} allowed",
            solver.why,
            amounts::size(solver.bytes),
            amounts::size(solver.memory)
        ),
        stepper: describe(stepping, !model.is_linear(), !interfaces.is_empty()),
        remarks,
        warnings: scene.warnings.clone(),
        start_gaps: Vec::new(),
        dofs: model.dofs(),
        system_dofs: system_dofs + unknowns,
        state_bytes: (!interfaces.is_empty()).then_some(state_bytes),
        memory_bytes: ModelMemory::new(model).with_systems(solver.bytes, path == Path::Condensed),
    }
}

/// Descriptions of the springs, one line for each set that a spring pulls.
fn springs_in_words(stages: &[Stage]) -> Vec<String> {
    let mut lines = Vec::new();
    for spring in stages.iter().flat_map(|s| &s.springs) {
        let axis = ["x", "y", "z"][spring.axis];
        let line = format!("spring of {:e} N/m pulls `{}` along {axis} as one", spring.stiffness, spring.set);
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}

/// Descriptions of the materials of the bodies, one line per kind.
fn bodies_in_words<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<String> {
    let mut lines: Vec<(String, Vec<&str>, usize)> = Vec::new();
    for body in &model.bodies {
        let spec = &scene.bodies[&body.name];
        for block in body.blocks.clone() {
            let material = match &model.blocks[block] {
                CellBlock::Linear(_) => "linear elasticity, small strain",
                CellBlock::Nonlinear(b) => match (&b.model().material, spec.is_finite()) {
                    (Material::Elastic(_), _) => {
                        "hypoelasticity, large deformation (updated Lagrangian, Jaumann rate)"
                    }
                    (Material::J2(_), true) => {
                        "plasticity, large deformation (updated Lagrangian, Jaumann rate)"
                    }
                    (Material::J2(_), false) => "plasticity, small strain",
                    (Material::Maxwell(_), true) => {
                        "viscoelasticity, large deformation (updated Lagrangian, Jaumann rate)"
                    }
                    (Material::Maxwell(_), false) => "viscoelasticity, small strain",
                },
            };
            let b_bar = spec.formulation.as_ref().is_some_and(|f| *f.get_ref() == Formulation::BBar);
            let text = format!("{material}{}", if b_bar { ", B-bar" } else { "" });
            let cells = model.mesh.blocks[block].len();
            match lines.iter_mut().find(|l| l.0 == text) {
                Some((_, bodies, n)) => {
                    *n += cells;
                    if bodies.last() != Some(&body.name.as_str()) {
                        bodies.push(&body.name);
                    }
                }
                None => lines.push((text, vec![&body.name], cells)),
            }
        }
    }
    let space = match scene.kinematics.get_ref() {
        Kinematics::ThreeD => "three-dimensional",
        Kinematics::Axisymmetric => "axisymmetric",
        other => other.words(),
    };
    let several = lines.len() > 1;
    let line = |(text, bodies, cells): (String, Vec<&str>, usize)| {
        let names = if several { format!(": {}", bodies.join(", ")) } else { String::new() };
        format!("{text}, {space} ({}, {cells} cells{names})", counted(bodies.len(), "body", "bodies"))
    };
    lines.into_iter().map(line).collect()
}

/// A count with its noun in the singular or plural.
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

fn describe(stepping: &Stepping, limits: bool, slips: bool) -> String {
    match (stepping.drift, stepping.rule) {
        (None, _) if !slips => "implicit: Newton with line search".into(),
        (None, TimeRule::BackwardEuler) => {
            "implicit: Newton with line search, backward Euler in slip, steps adapted to the error of slip"
                .into()
        }
        (None, TimeRule::Bdf2) => {
            "implicit: Newton with line search, second-order backward differences in slip, steps adapted to errors of slip and friction"
                .into()
        }
        (Some(drift), _) => format!(
            "static-explicit: R-minimum rule{}; a residual above {drift:e} of the largest force is corrected at once, a smaller one taken \
             up by the next step",
            if limits { ", bodies limited by yield (r1), strain (r2) and rotation (r3)" } else { "" }
        ),
    }
}

/// Description of the enforcement of an interface.
fn enforced(interface: &PlannedInterface) -> String {
    let kind = if interface.law.as_ref().is_some_and(|l| l.bonded()) { "tied" } else { "contact" };
    match interface.enforced {
        PlannedEnforcement::Penalty => format!("penalty {kind}"),
        PlannedEnforcement::Uzawa { tolerance, most } => format!(
            "{kind} by Uzawa's method to a penetration of {tolerance:.2e} m in at most {most} augmentations a step"
        ),
        PlannedEnforcement::AugmentedLagrangian { .. } => {
            format!("{kind} by {} multipliers as unknowns (augmented Lagrangian)", interface.unknowns)
        }
    }
}
