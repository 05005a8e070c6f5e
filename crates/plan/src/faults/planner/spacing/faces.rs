//! Cells of faults between bodies: faces of their minus sides.

use super::cell::Cell;
use super::distance::Position;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::model::{self, Model};
use asperity_fem::mesh::MeshFace;

/// Faces of all faults.
///
/// # Errors
/// [`Diagnostic`] for a missing set.
pub(in super::super) fn cells<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
) -> Result<Vec<Cell>, Diagnostic> {
    let mut all = Vec::new();
    for (fault, spec) in scene.faults.values().enumerate() {
        for side in model::sides(model, &spec.minus)? {
            let MeshFace { kind, nodes } = MeshFace::new(&model.mesh, side);
            let count = if D == 2 { 2 } else { kind.corners() };
            let vertices: Vec<usize> = nodes.into_iter().take(count).collect();
            let at =
                |n: &usize| Position::from_fn(|c, _| model.mesh.nodes[*n].get(c).copied().unwrap_or(0.0));
            let corners: Vec<Position> = vertices.iter().map(at).collect();
            let width = corners.iter().zip(corners.iter().skip(1)).map(|(a, b)| (a - b).norm());
            let width = width.fold(f64::INFINITY, f64::min);
            all.push(Cell { fault, rim: vec![false; corners.len()], corners, vertices, width, along: None });
        }
    }
    Ok(all)
}
