//! Imbalance of initial stress, weight, loads and interfaces at the start.

use super::PlannedInterface;
use super::assembly::Assembly;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::initial_stress;
use asperity_contact::{Enforcement, Interface, PointFields};
use asperity_friction::law::{Law, Regime, Responses, Trials};
use asperity_mechanics::coordinates::in_words;
use asperity_mechanics::{CellBlock, Model, Stage, contact_spec};
use asperity_run::Warning;

/// Ratio of the unbalanced forces to the largest initial stress on a face the size of the body, above which the body settles by more than mesh
/// errors. Where the meshes of two bodies do not match, a varying stress leaves about h/10H with H/h cells.
const SETTLES: f64 = 1e-2;

/// Hints at what may be missing.
const BEARS: &str = "interfaces bear the stress from the start with `initial_stress = true`";
const BALANCES: &str = "weight needs a stress that grows with depth (`kind = \"lithostatic\"`), free sides the tractions that the stress exerts there; leave it \
                        so where the stress is meant as a load";

/// Ratio below which a force is rounding.
const ROUNDING: f64 = 1e-9;

/// Fraction of a shear traction that friction may remove before a point counts as slipping: rounding.
const HELD: f64 = 1e-9;

/// Unbalanced force of the bodies.
struct UnbalancedForce<const D: usize> {
    /// Sum of the unbalanced forces over the largest stress times a face of the size of the body \[-\].
    share: f64,
    /// Largest unbalanced force \[N; N/m\], with its node and axis.
    largest: (f64, usize, usize),
}

impl<const D: usize> UnbalancedForce<D> {
    fn in_words(&self, model: &Model<D>) -> String {
        let (_, node, axis) = self.largest;
        format!(
            "initial stress, weight, loads at the start and interfaces are out of balance by {:.1e} of the stress, most at {} along {}",
            self.share,
            in_words(&model.mesh.nodes[node]),
            ["x", "y", "z"][axis]
        )
    }
}

/// Initial state of an interface.
struct Start {
    /// Description for the plan.
    remark: String,
    /// True if friction does not hold all points.
    slips: bool,
}

/// Remarks on the start of bodies with an initial stress, and a warning if it is not in balance.
///
/// # Errors
/// [`Diagnostic`] for an interface that cannot be built.
pub fn remarks_and_warning<const D: usize>(
    assembly: &Assembly<'_, D>,
) -> Result<(Vec<String>, Option<Warning>), Diagnostic> {
    let Assembly { scene, model, stages, .. } = assembly;
    let given = scene.bodies.values().find_map(|b| b.initial_stress.as_ref());
    let (Some(given), Some(stage)) = (given, stages.first()) else { return Ok((Vec::new(), None)) };
    let stress = largest_stress(scene, model);
    if stress == 0.0 {
        return Ok((Vec::new(), None));
    }
    let mut remarks = Vec::new();
    let mut r = unbalanced_forces(model, stage);
    let mut slips = false;
    for planned in &assembly.interfaces {
        if let Some(start) = pressed(assembly, planned, stage, &mut r)? {
            slips |= start.slips;
            remarks.push(start.remark);
        }
    }
    let left = largest_unbalance(model, stage, &r, stress);
    if left.share <= ROUNDING {
        let until = if slips { " until friction gives way" } else { "" };
        remarks.push(format!(
            "initial stress, weight, loads at the start and interfaces are in balance to rounding{until}"
        ));
        return Ok((remarks, None));
    }
    let told = left.in_words(model);
    if left.share <= SETTLES {
        remarks.push(told);
        return Ok((remarks, None));
    }
    let message = format!(
        "{told}, by {:.3e} {}: bodies move in the first step until they are",
        left.largest.0,
        unit(model)
    );
    let bare = scene.interfaces.values().any(|i| i.initial_stress.is_none());
    let help = if bare { format!("{BEARS}; {BALANCES}") } else { BALANCES.into() };
    Ok((remarks, Some(Warning::at(given.span(), message, help))))
}

fn unit<const D: usize>(model: &Model<D>) -> &'static str {
    if D == 2 && model.idealisation.weight(&[0.0; D]) == 1.0 { "N/m" } else { "N" }
}

/// Internal minus external forces of the bodies at zero displacement and time zero.
fn unbalanced_forces<const D: usize>(model: &Model<D>, stage: &Stage) -> Vec<f64> {
    let (mut r, u) = (vec![0.0; model.dofs()], vec![0.0; model.dofs()]);
    for channel in &stage.constraints(&u).channels {
        let amplitude = channel.amplitude.value(stage.start);
        channel.forces.iter().for_each(|(dof, f)| r[*dof] -= amplitude * f);
    }
    let components = model.idealisation.components();
    for (index, block) in model.blocks.iter().enumerate() {
        if let CellBlock::Linear(_) = block {
            continue;
        }
        let cells = &model.mesh.blocks[index];
        for cell in 0..cells.len() {
            let forces = block.forces_of_cell(cell, &u);
            for (node, forces) in cells.cell(cell).iter().zip(forces.chunks_exact(components)) {
                forces.iter().enumerate().for_each(|(c, f)| r[node * components + c] += f);
            }
        }
    }
    r
}

/// Adds the forces of an interface that the initial stress presses, and describes its tractions.
fn pressed<const D: usize>(
    assembly: &Assembly<'_, D>,
    planned: &PlannedInterface,
    stage: &Stage,
    r: &mut [f64],
) -> Result<Option<Start>, Diagnostic> {
    let Assembly { scene, model, stepping, .. } = assembly;
    let Some(pressed) = &planned.pressed else { return Ok(None) };
    let number: Vec<usize> = (0..model.dofs()).collect();
    let mut declared = contact_spec::spec(model, stepping, planned, &number, 0.0, 0);
    declared.enforcement = Enforcement::Penalty;
    if stage.frictionless.contains(&planned.name) {
        declared.law = None;
    }
    let law = declared.law.clone();
    let mut built = Interface::new(declared).map_err(|e| {
        let slave = &scene.interfaces[&planned.name].slave;
        Diagnostic::at(slave.span(), e.to_string(), "see `slave` and `master`")
    })?;
    built.press(&pressed.starts(), pressed.reach);
    built.exert(r);
    Ok(Some(Start::from_points(planned, law.as_deref(), built.points())))
}

impl Start {
    /// State of an interface from the tractions at its points, under a law if there is friction.
    fn from_points<const D: usize>(
        planned: &PlannedInterface,
        law: Option<&dyn Law>,
        points: &PointFields<D>,
    ) -> Self {
        let name = &planned.name;
        let bears: Vec<usize> = (0..points.gap.len()).filter(|&p| points.normal_traction[p] > 0.0).collect();
        let shear = |p: usize| points.shear[p].iter().map(|t| t * t).sum::<f64>().sqrt();
        let borne: Vec<(f64, f64)> = bears.iter().map(|&p| (points.normal_traction[p], shear(p))).collect();
        if borne.is_empty() {
            let remark = format!("interface `{name}`: the initial stress does not press it");
            return Self { remark, slips: false };
        }
        let (least, most) =
            borne.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), (f, _)| (a.min(*f), b.max(*f)));
        let ratio = borne.iter().map(|(f, t)| t / f).fold(0.0, f64::max);
        let mut remark = format!(
            "interface `{name}`: the initial stress presses {} of {} points with {least:.4e} to {most:.4e} Pa, and shears them by up to {ratio:.4} of that",
            borne.len(),
            points.gap.len()
        );
        let slips = law.map_or(0, |law| {
            let states = initial(law, &bears, points.gap.len());
            slipping(law, (&bears, &borne, &states), planned.tangential_penalty)
        });
        if slips > 0 {
            remark += &format!("; friction does not hold {slips} of them, which slip at once");
        }
        Self { remark, slips: slips > 0 }
    }
}

/// Initial states of some of the points of an interface.
fn initial(law: &dyn Law, points: &[usize], count: usize) -> Vec<f64> {
    let k = law.states();
    let mut all = vec![0.0; count * k];
    law.initial(&mut all);
    points.iter().flat_map(|p| all[p * k..(p + 1) * k].iter().copied()).collect()
}

/// Number of points whose shear traction exceeds the yield surface of the law.
fn slipping(law: &dyn Law, (points, borne, old): (&[usize], &[(f64, f64)], &[f64]), stiffness: f64) -> usize {
    if !law.has_elastic_domain() || law.bonded() {
        return 0;
    }
    let n = borne.len();
    let (normal, trial): (Vec<f64>, Vec<f64>) = borne.iter().copied().unzip();
    let mut states = old.to_vec();
    let mut out = vec![vec![0.0; n]; 5];
    let [traction, slip, rate, d_trial, d_normal] = out.as_mut_slice() else { return 0 };
    let mut regime = vec![Regime::Stick; n];
    let answers =
        Responses { traction, slip, rate, regime: &mut regime, d_trial, d_normal, states: &mut states };
    let (normal, trial) = (&normal[..], &trial[..]);
    let trials = Trials { points, normal, trial, stiffness, dt: 1.0, damping: 0.0, lag: None, near: None };
    if law.respond(trials, old, answers).is_err() {
        return 0;
    }
    out[0].iter().zip(trial).filter(|(t, e)| **t < **e * (1.0 - HELD)).count()
}

/// Largest component of the initial stress at any node \[Pa\].
fn largest_stress<const D: usize>(scene: &Scene, model: &Model<D>) -> f64 {
    let fields = model.bodies.iter().filter_map(|b| Some((b, initial_stress::body_field(scene, &b.name)?)));
    fields
        .flat_map(|(b, field)| model.mesh.nodes[b.nodes.clone()].iter().map(move |x| field.at(x)))
        .flat_map(|s| s.into_iter().map(f64::abs))
        .fold(0.0, f64::max)
}

/// Unbalanced force at free degrees of freedom, for the body where it is largest.
fn largest_unbalance<const D: usize>(
    model: &Model<D>,
    stage: &Stage,
    r: &[f64],
    stress: f64,
) -> UnbalancedForce<D> {
    let components = model.idealisation.components();
    let mut left = UnbalancedForce { share: 0.0, largest: (0.0, 0, 0) };
    for body in &model.bodies {
        let free = body.dofs.clone().filter(|d| stage.fixed.binary_search(d).is_err());
        let (mut sum, mut largest) = (0.0, (0.0, body.nodes.start, 0));
        for dof in free {
            sum += r[dof].abs();
            if r[dof].abs() > largest.0 {
                largest = (r[dof].abs(), dof / components, model.idealisation.axis(dof % components));
            }
        }
        let share = sum / (stress * face(model, body.nodes.clone()));
        if share > left.share {
            left = UnbalancedForce { share, largest };
        }
    }
    left
}

/// Area of the largest face of the bounding box of a body; in axisymmetry, of the full circle \[m²; m\].
fn face<const D: usize>(model: &Model<D>, nodes: std::ops::Range<usize>) -> f64 {
    let (min, max) = asperity_mechanics::bounds(&model.mesh.nodes[nodes]);
    let edge = |c: usize| max[c] - min[c];
    let longest = (0..D).map(edge).fold(0.0, f64::max);
    match D {
        2 => longest * model.idealisation.weight(&max),
        _ => (0..3).map(|c| edge(c) * edge((c + 1) % 3)).fold(0.0, f64::max),
    }
}
