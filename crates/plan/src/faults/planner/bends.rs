//! Angles of faults between neighbouring cells.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Fault as Spec;
use crate::shared::entry::Entry;
use crate::shared::model::{self, Model};
use asperity_fem::mesh::{MeshFace, Side, face_nodes};
use asperity_mechanics::coordinates;
use std::collections::BTreeMap;

/// Angle between neighbouring cells from which the plan notes it \[degrees\]. Slip of 1 m across a corner of 2 degrees between cells of 1 km changes
/// normal tractions by about a megapascal.
const NOTED: f64 = 2.0;

/// Note on the sharpest bend of a fault.
///
/// # Errors
/// [`Diagnostic`] for a missing set.
pub(super) fn note<const D: usize>(
    model: &Model<D>,
    Entry { name, spec }: Entry<'_, Spec>,
) -> Result<Option<String>, Diagnostic> {
    // In antiplane motion the direction of slip is the same everywhere.
    if model.idealisation.components() == 1 {
        return Ok(None);
    }
    let mut around: BTreeMap<usize, Vec<[f64; 3]>> = BTreeMap::new();
    for side in model::sides(model, &spec.minus)? {
        let (nodes, normal) = (face_nodes(&model.mesh, side), normal(model, side));
        for &node in &nodes {
            around.entry(node).or_default().push(normal);
        }
    }
    let bends = around.iter().flat_map(|(&node, normals)| {
        let pairs = normals.iter().enumerate().flat_map(|(k, a)| normals[..k].iter().map(|b| [*a, *b]));
        pairs.map(move |normals| Bend { normals, at: model.mesh.nodes[node] })
    });
    Ok(sharpest(name, bends))
}

/// Two neighbouring cells.
pub(super) struct Bend<const D: usize> {
    pub normals: [[f64; 3]; 2],
    /// Their common position \[m\].
    pub at: [f64; D],
}

/// Note on the sharpest of some bends.
pub(super) fn sharpest<const D: usize>(name: &str, bends: impl Iterator<Item = Bend<D>>) -> Option<String> {
    let bends = bends.map(|Bend { normals: [a, b], at }| (angle(&a, &b), at));
    let (angle, at) = bends.reduce(|most, bend| if bend.0 > most.0 { bend } else { most })?;
    (angle >= NOTED).then(|| {
        format!(
            "fault `{name}` turns by up to {angle:.1} degrees from one cell to the next, at {}: tractions there grow as cells shrink",
            coordinates::in_words(&at)
        )
    })
}

/// Angle between two vectors \[degrees\].
fn angle(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let cross = cross(a, b);
    let sine = cross.iter().map(|c| c * c).sum::<f64>().sqrt();
    sine.atan2(dot).to_degrees()
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| {
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// Normal of a face between its corners, not normalised.
fn normal<const D: usize>(model: &Model<D>, side: &Side) -> [f64; 3] {
    let MeshFace { kind, nodes } = MeshFace::new(&model.mesh, side);
    let x = |k: usize| -> [f64; 3] {
        std::array::from_fn(|c| model.mesh.nodes[nodes[k]].get(c).copied().unwrap_or(0.0))
    };
    let minus = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|c| a[c] - b[c]) };
    if D == 2 {
        let [dx, dy, _] = minus(x(1), x(0));
        return [dy, -dx, 0.0];
    }
    match kind.corners() {
        3 => cross(&minus(x(1), x(0)), &minus(x(2), x(0))),
        _ => cross(&minus(x(2), x(0)), &minus(x(3), x(1))),
    }
}
