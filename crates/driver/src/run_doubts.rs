//! Warnings about results outside the assumptions of the model: strain, rotation and slip that are not small, and contacts that never closed.

use crate::lengths::brief;
use crate::plan::Plan;
use crate::report::InterfaceResult;
use crate::warning::Warning;
use asperity_contact::Sliding;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::Cells;
use asperity_fem::mesh::MeshFace;
use asperity_fem::nonlinear::Kinematics;
use asperity_mechanics::{CellBlock, Model, PlannedInterface};
use asperity_output::view::InterfaceFields;
use nalgebra::{DMatrix, SymmetricEigen};

/// Largest principal strain admitted in small-strain theory \[-\]. The error is of the order of the strain itself, so that stress and area have
/// errors of about five per cent here.
const SMALL_STRAIN: f64 = 0.05;

/// Largest rotation admitted in small-strain theory \[rad\]. It takes a rotation θ for a strain θ²/2, here 1.25e-3, which in rock is tens of MPa.
const SMALL_ROTATION: f64 = 0.05;

/// Slip over the size of the master faces from which a fixed pairing is wrong, because the node is then on another face.
const SMALL_SLIDING: f64 = 1.0;

/// Largest principal strain and rotation of the cells of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Largest {
    /// Largest principal strain \[-\].
    pub strain: f64,
    /// Largest rotation \[rad\].
    pub rotation: f64,
}

/// Warnings at the end of a stage, given the displacement of all degrees of freedom.
#[must_use]
pub fn after_stage<const D: usize>(
    plan: &Plan<D>,
    stage: &str,
    u: &[f64],
    fields: &[InterfaceFields],
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for body in &plan.problem.model.bodies {
        let largest = body.blocks.clone().map(|b| of_block(&plan.problem.model, b, u));
        let largest = largest.fold(Largest::default(), |a, b| Largest {
            strain: a.strain.max(b.strain),
            rotation: a.rotation.max(b.rotation),
        });
        warnings.extend(of_body(&body.name, stage, largest, body.elastic[0].young()));
    }
    warnings.extend(
        plan.problem
            .interfaces
            .iter()
            .zip(fields)
            .filter_map(|(i, f)| dragged(&plan.problem.model, i, stage, f)),
    );
    warnings
}

fn of_body(body: &str, stage: &str, largest: Largest, young: f64) -> Option<Warning> {
    let help = format!("add `strain = \"finite\"` to body `{body}`, or check the loads and the units");
    if largest.strain > SMALL_STRAIN {
        let message = format!(
            "body `{body}` is strained by {:.3} in stage `{stage}`, and its strain is taken as small (up to {SMALL_STRAIN})",
            largest.strain
        );
        return Some(Warning::at(0..0, message, help));
    }
    (largest.rotation > SMALL_ROTATION).then(|| {
        let theta = largest.rotation;
        let message = format!(
            "body `{body}` turns by {theta:.3} rad in stage `{stage}`, which a theory of small strain takes for a strain of {:.1e}, a stress of \
             about {:.3e} Pa",
            0.5 * theta * theta,
            0.5 * theta * theta * young
        );
        Warning::at(0..0, message, help)
    })
}

/// Largest strain and rotation at the centres of the cells of a block; zero if the block accounts for large
/// deformation.
pub fn of_block<const D: usize>(model: &Model<D>, block: usize, u: &[f64]) -> Largest {
    let followed = matches!(&model.blocks.get(block), Some(CellBlock::Nonlinear(b)) if b.model().kinematics == Kinematics::UpdatedLagrangian);
    // Antiplane motion has one component, and its equation is linear for slopes of any size.
    if followed || model.idealisation == Idealisation::Antiplane {
        return Largest::default();
    }
    let cells = &model.mesh.blocks[block];
    (0..cells.len()).fold(Largest::default(), |largest, cell| {
        let gradient = gradient(model, cells, cell, u);
        let strain = 0.5 * (&gradient + gradient.transpose());
        let spin = 0.5 * (&gradient - gradient.transpose());
        let principal = SymmetricEigen::new(strain).eigenvalues.amax().max(hoop(model, cells, cell, u));
        // In 3D each component of the rotation vector appears twice in the spin.
        Largest {
            strain: largest.strain.max(principal),
            rotation: largest.rotation.max(spin.norm() / std::f64::consts::SQRT_2),
        }
    })
}

/// Magnitude of the hoop strain in axisymmetry.
fn hoop<const D: usize>(model: &Model<D>, cells: &Cells, cell: usize, u: &[f64]) -> f64 {
    if model.idealisation != Idealisation::Axisymmetric {
        return 0.0;
    }
    let nodes = cells.cell(cell);
    let radius: f64 = nodes.iter().map(|&n| model.mesh.nodes[n][0]).sum();
    let moved: f64 = nodes.iter().map(|&n| u[n * D]).sum();
    (moved / radius).abs()
}

/// Displacement gradient at the centre of a cell.
fn gradient<const D: usize>(model: &Model<D>, cells: &Cells, cell: usize, u: &[f64]) -> DMatrix<f64> {
    let kind = cells.kind;
    let corners = &kind.node_coordinates()[..kind.corners()];
    let middle: [f64; 3] =
        std::array::from_fn(|c| corners.iter().map(|x| x[c]).sum::<f64>() / corners.len() as f64);
    let shape = kind.shape(middle);
    let (mut jacobian, mut natural) = (DMatrix::<f64>::zeros(D, D), DMatrix::<f64>::zeros(D, D));
    for (a, &node) in cells.cell(cell).iter().enumerate() {
        for i in 0..D {
            for m in 0..D {
                jacobian[(i, m)] += model.mesh.nodes[node][i] * shape.dn[a][m];
                natural[(i, m)] += u[node * D + i] * shape.dn[a][m];
            }
        }
    }
    // A cell whose Jacobian cannot be inverted is refused when the bodies are built.
    jacobian.try_inverse().map_or_else(|| DMatrix::zeros(D, D), |inverse| natural * inverse)
}

/// Warning about a side that is dragged off the faces it was paired with.
fn dragged<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
    stage: &str,
    fields: &InterfaceFields,
) -> Option<Warning> {
    if planned.sliding == Sliding::Finite || planned.law.as_ref().is_some_and(|l| l.bonded()) {
        return None;
    }
    let slid = fields.relative_displacement.iter().map(|r| r.abs()).fold(0.0, f64::max);
    let size = face_size(model, &planned.master_faces);
    (slid > SMALL_SLIDING * size).then(|| {
        Warning::at(
            0..0,
            format!(
                "interface `{}` slides by {} in stage `{stage}`, {:.1} times the size {} of the faces of its master, and its pairing does not \
                 follow: beyond some {} nodes bear on faces that they have left, with full friction even off the end of the master",
                planned.name,
                brief(slid),
                slid / size,
                brief(size),
                brief(SMALL_SLIDING * size)
            ),
            "use `sliding = \"finite\"`; with \"small\" every node keeps the partner that it has at the start",
        )
    })
}

/// Mean distance between the first two corners of faces \[m\].
fn face_size<const D: usize>(model: &Model<D>, faces: &[MeshFace]) -> f64 {
    let edge = |face: &MeshFace| {
        let (a, b) = (model.mesh.nodes[face.nodes[0]], model.mesh.nodes[face.nodes[1]]);
        (0..D).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt()
    };
    faces.iter().map(edge).sum::<f64>() / faces.len().max(1) as f64
}

/// Warnings about interfaces that were open at the end of every stage.
#[must_use]
pub fn never_closed(results: &[InterfaceResult]) -> Vec<Warning> {
    let mut names: Vec<&str> = results.iter().map(|r| r.interface.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let open = |name: &&str| {
        let mut own = results.iter().filter(|r| r.interface == *name);
        own.all(|r| r.status[1] + r.status[2] == 0)
    };
    let told = |name: &str| {
        Warning::at(
            0..0,
            format!("interface `{name}` was open at the end of every stage and transmitted nothing"),
            "is the gap at the start right, and do the bodies move towards each other?",
        )
    };
    names.into_iter().filter(open).map(told).collect()
}
