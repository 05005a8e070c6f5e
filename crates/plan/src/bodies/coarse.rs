//! Warnings about sides of interfaces with too few faces.

use super::surfaces::FacingSurfaces;
use crate::reading::scene::model::Interface as Spec;
use crate::shared::model::Model;
use asperity_fem::mesh::MeshFace;
use asperity_mechanics::{Measure, PlannedInterface};
use asperity_run::Warning;

/// Ratio of the sizes of slave and master faces at which a warning is given: the middle of a slave face is then two master nodes from the nearest
/// point at which penetration is detected.
const COARSER: f64 = 3.0;

/// Warnings about the faces of an interface between these surfaces.
pub fn doubts<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
    surfaces: &FacingSurfaces<'_, D>,
    spec: &Spec,
) -> impl Iterator<Item = Warning> {
    [single(planned, spec), coarser(model, planned, surfaces, spec)].into_iter().flatten()
}

/// Warning about a slave side with a single face: its tractions cannot vary, whatever the body does.
fn single(planned: &PlannedInterface, spec: &Spec) -> Option<Warning> {
    (planned.slave_faces.len() == 1).then(|| {
        let message = format!(
            "the slave side of interface `{}` is a single face: tractions cannot vary along it, nor slip begin somewhere",
            planned.name
        );
        Warning::at(spec.slave.span(), message, "take smaller cells; results of one cell do not converge to anything")
    })
}

/// Warning about slave nodes so far apart that a master passes between them.
fn coarser<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
    surfaces: &FacingSurfaces<'_, D>,
    spec: &Spec,
) -> Option<Warning> {
    let size = |faces: &[MeshFace]| {
        faces.iter().map(|f| extent(&model.mesh.nodes, &f.nodes)).sum::<f64>() / faces.len() as f64
    };
    let finest = surfaces.masters.iter().map(|m| size(&m.faces(model))).fold(f64::INFINITY, f64::min);
    let ratio = size(&planned.slave_faces) / finest;
    (planned.measure == Measure::NodeToPoint && ratio > COARSER).then(|| {
        let message = format!(
            "faces of the slave side of interface `{}` are {ratio:.1} times as large as those of its master side, whose nodes penetrate between slave \
             nodes unseen",
            planned.name
        );
        Warning::at(spec.slave.span(), message, "let the finer side be the slave, or use `measure = \"mortar\"`")
    })
}

/// Largest distance between two nodes of a face \[m\].
fn extent<const D: usize>(nodes: &[[f64; D]], face: &[usize]) -> f64 {
    let square = |a: usize, b: usize| (0..D).map(|c| (nodes[a][c] - nodes[b][c]).powi(2)).sum::<f64>();
    let pairs = face.iter().flat_map(|&a| face.iter().map(move |&b| (a, b)));
    pairs.map(|(a, b)| square(a, b)).fold(0.0, f64::max).sqrt()
}
