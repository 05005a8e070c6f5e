//! Imbalance of initial stress, weight and loads at the start.

use crate::reading::scene::model::Scene;
use crate::shared::initial_stress;
use asperity_mechanics::coordinates::in_words;
use asperity_mechanics::{CellBlock, Model, Stage};
use asperity_run::Warning;
use std::ops::Range;

/// Ratio of the unbalanced forces to the largest initial stress on a face the size of the body, above which the body settles by more than mesh
/// errors. Where the meshes of two bodies do not match, a varying stress leaves about h/10H with H/h cells.
const SETTLES: f64 = 1e-2;

/// Hint at what may be missing.
pub const BALANCES: &str = "weight needs a stress that grows with depth (`kind = \"lithostatic\"`), free sides the tractions that the stress exerts there; leave it \
                        so where the stress is meant as a load";

/// Ratio below which a force is rounding.
const ROUNDING: f64 = 1e-9;

/// Unbalanced force of the bodies.
pub struct UnbalancedForce {
    /// Sum of the unbalanced forces over the largest stress times a face of the size of the body \[-\].
    share: f64,
    /// Largest unbalanced force \[N; N/m\], with its node and axis.
    largest: (f64, usize, usize),
}

impl UnbalancedForce {
    /// Unbalanced force at free degrees of freedom, for the body where it is largest.
    pub fn largest<const D: usize>(model: &Model<D>, stage: &Stage, r: &[f64], stress: f64) -> Self {
        let components = model.idealisation.components();
        let mut left = Self { share: 0.0, largest: (0.0, 0, 0) };
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
                left = Self { share, largest };
            }
        }
        left
    }

    /// True if it is rounding.
    pub fn is_rounding(&self) -> bool {
        self.share <= ROUNDING
    }

    /// True if bodies move by more than errors of meshes do.
    pub fn settles(&self) -> bool {
        self.share > SETTLES
    }

    /// Its largest part as text.
    pub fn size<const D: usize>(&self, model: &Model<D>) -> String {
        format!("{:.3e} {}", self.largest.0, unit(model))
    }

    /// Description.
    pub fn in_words<const D: usize>(&self, model: &Model<D>) -> String {
        let (_, node, axis) = self.largest;
        format!(
            "initial stress, weight, loads at the start and interfaces are out of balance by {:.1e} of the stress, most at {} along {}",
            self.share,
            in_words(&model.mesh.nodes[node]),
            ["x", "y", "z"][axis]
        )
    }
}

/// Start of bodies with an initial stress.
pub struct StressedStart {
    /// Position of the first stress in the scene.
    pub given: Range<usize>,
    /// Largest component of the stress at any node \[Pa\].
    pub stress: f64,
    /// Internal minus external forces of the bodies \[N; N/m\].
    pub forces: Vec<f64>,
}

impl StressedStart {
    /// Start of a stage; `None` without an initial stress.
    pub fn find<const D: usize>(scene: &Scene, model: &Model<D>, stage: &Stage) -> Option<Self> {
        let given = scene.bodies.values().find_map(|b| b.initial_stress.as_ref())?.span();
        let stress = largest_stress(scene, model);
        (stress != 0.0).then(|| Self { given, stress, forces: unbalanced_forces(model, stage) })
    }
}

/// Warning about bodies with mass that move because their initial stress is out of balance.
pub fn waves<const D: usize>(scene: &Scene, model: &Model<D>, stage: &Stage) -> Option<Warning> {
    let StressedStart { given, stress, forces } = StressedStart::find(scene, model, stage)?;
    let left = UnbalancedForce::largest(model, stage, &forces, stress);
    left.settles().then(|| {
        let message =
            format!("{}, by {}: waves run from there at once", left.in_words(model), left.size(model));
        Warning::at(given, message, BALANCES)
    })
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

/// Largest component of the initial stress at any node \[Pa\].
fn largest_stress<const D: usize>(scene: &Scene, model: &Model<D>) -> f64 {
    let fields = model.bodies.iter().filter_map(|b| Some((b, initial_stress::body_field(scene, &b.name)?)));
    fields
        .flat_map(|(b, field)| model.mesh.nodes[b.nodes.clone()].iter().map(move |x| field.at(x)))
        .flat_map(|s| s.into_iter().map(f64::abs))
        .fold(0.0, f64::max)
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
