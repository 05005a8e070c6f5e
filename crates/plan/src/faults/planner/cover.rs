//! Check that the two sides of a fault have the same nodes wherever they overlap.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Fault as Spec;
use crate::shared::entry::Entry;
use crate::shared::model::Model;
use asperity_fem::mesh::{MeshFace, Side, face_nodes};
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use std::collections::BTreeSet;

/// Largest distance of two nodes at one position, relative to the size of the model: rounding of generated and of
/// written coordinates.
pub(super) const TOGETHER: f64 = 1e-9;

/// Distance from the plane through the corners of a face within which a point lies on it, relative to its size: the rise of an arc of 45 degrees.
const RISE: f64 = 0.1;

/// The two sides of a fault between bodies.
#[derive(Clone, Copy)]
pub(super) struct FaultSides<'a, const D: usize> {
    pub model: &'a Model<D>,
    pub fault: Entry<'a, Spec>,
    pub minus: &'a [Side],
    pub plus: &'a [Side],
}

/// Refuses nodes of the plus side that lie on faces of the minus side but not at a node, because nothing would tie them to the other side. Where the
/// plus side extends beyond the minus side it is free, as given in the scene.
///
/// # Errors
/// [`Diagnostic`] at the plus side, with the first position and the number of such nodes.
pub(super) fn partners<const D: usize>(sides: &FaultSides<'_, D>, alone: &[usize]) -> Result<(), Diagnostic> {
    let FaultSides { model, fault: Entry { name, spec }, minus, .. } = *sides;
    if alone.is_empty() {
        return Ok(());
    }
    let faces: Vec<Face<D>> = minus.iter().flat_map(|side| Face::from_side(model, side)).collect();
    let close = TOGETHER * model.scale;
    let x = |n: &usize| &model.mesh.nodes[*n];
    let covered: Vec<&usize> = alone.iter().filter(|n| faces.iter().any(|f| f.holds(x(n), close))).collect();
    let Some(first) = covered.first() else { return Ok(()) };
    Err(Diagnostic::at(
        spec.plus.span(),
        format!(
            "the sides of fault `{name}` do not lie on each other: nodes of the plus side lie between nodes of the minus \
             side, {} of them, the first at {}",
            covered.len(),
            coordinates::in_words(x(first)),
        ),
        "both sides need the same nodes: equal sizes of cells on both, or one mesh that is split along the fault",
    ))
}

/// Warning if the nodes of the two sides agree but their faces do not: between the nodes the sides then gap and overlap.
pub(super) fn same_faces<const D: usize>(
    sides: &FaultSides<'_, D>,
    partner: impl Fn(usize) -> Option<usize>,
) -> Option<Warning> {
    let FaultSides { model, fault: Entry { name, spec }, minus, plus } = *sides;
    let sorted = |mut nodes: Vec<usize>| {
        nodes.sort_unstable();
        nodes
    };
    let faces: BTreeSet<Vec<usize>> = plus.iter().map(|s| sorted(face_nodes(&model.mesh, s))).collect();
    let other = |side: &&Side| {
        let across: Option<Vec<usize>> = face_nodes(&model.mesh, side).into_iter().map(&partner).collect();
        across.is_none_or(|nodes| !faces.contains(&sorted(nodes)))
    };
    let first = minus.iter().find(other)?;
    let node = face_nodes(&model.mesh, first)[0];
    Some(Warning::at(
        spec.plus.span(),
        format!(
            "the sides of fault `{name}` have the same nodes and different faces, first at {}: between the nodes they gap and overlap",
            coordinates::in_words(&model.mesh.nodes[node])
        ),
        "use the same element with the same edges on both sides",
    ))
}

/// Part of a face: a line between two corners, or a triangle.
pub struct Face<const D: usize> {
    corners: Vec<[f64; D]>,
    min: [f64; D],
    max: [f64; D],
    size: f64,
}

fn minus<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|c| a[c] - b[c])
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl<const D: usize> Face<D> {
    /// Parts of a side.
    fn from_side(model: &Model<D>, side: &Side) -> Vec<Self> {
        let MeshFace { kind, nodes } = MeshFace::new(&model.mesh, side);
        let parts: &[&[usize]] = match kind.corners() {
            2 => &[&[0, 1]],
            3 => &[&[0, 1, 2]],
            _ => &[&[0, 1, 2], &[0, 2, 3]],
        };
        parts.iter().map(|p| Self::new(p.iter().map(|&k| model.mesh.nodes[nodes[k]]).collect())).collect()
    }

    /// Face with these corners, shape `[number]`.
    pub fn new(corners: Vec<[f64; D]>) -> Self {
        let extreme = |pick: fn(f64, f64) -> f64| -> [f64; D] {
            std::array::from_fn(|c| corners[1..].iter().map(|x| x[c]).fold(corners[0][c], pick))
        };
        let (min, max) = (extreme(f64::min), extreme(f64::max));
        let diagonal = minus(&max, &min);
        Self { size: dot(&diagonal, &diagonal).sqrt(), corners, min, max }
    }

    /// True if a point lies on this part, to within `close` \[m\] along it and a fraction of its size across it.
    pub fn holds(&self, x: &[f64; D], close: f64) -> bool {
        let reach = RISE * self.size;
        if (0..D).any(|c| x[c] < self.min[c] - reach || x[c] > self.max[c] + reach) {
            return false;
        }
        let edge = |k: usize| minus(&self.corners[k], &self.corners[0]);
        let d = minus(x, &self.corners[0]);
        let slack = close / self.size;
        let inside = |share: f64| share >= -slack;
        let shares: Vec<f64> = if self.corners.len() == 2 {
            let a = edge(1);
            vec![dot(&d, &a) / dot(&a, &a)]
        } else {
            // Least-squares solution of d = s a + t b.
            let (a, b) = (edge(1), edge(2));
            let (aa, ab, bb, da, db) = (dot(&a, &a), dot(&a, &b), dot(&b, &b), dot(&d, &a), dot(&d, &b));
            let det = aa * bb - ab * ab;
            vec![(bb * da - ab * db) / det, (aa * db - ab * da) / det]
        };
        let rest = 1.0 - shares.iter().sum::<f64>();
        let foot: [f64; D] =
            std::array::from_fn(|c| shares.iter().enumerate().map(|(k, s)| s * edge(k + 1)[c]).sum());
        let off = minus(&d, &foot);
        shares.iter().all(|&s| inside(s)) && inside(rest) && dot(&off, &off).sqrt() <= reach
    }
}
