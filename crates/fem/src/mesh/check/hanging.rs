//! Nodes that hang: cells of one part that meet, but not by whole faces with the same nodes, are not joined between their common
//! nodes. Such meshes come from refinement without transition cells, and from elements of two orders side by side.
//!
//! A face whose nodes no other cell has is one of the boundary. A node on it hangs if it lies within an edge of another face of
//! the boundary. Where both have names, as on the sides of a crack that are meshed apart, nothing is amiss.

use super::super::{Mesh, Side, face_kind, face_nodes};
use super::parts::Parts;
use rstar::{AABB, RTree, primitives::GeomWithData};
use std::collections::BTreeSet;

/// Distance of a node from an edge over its length that is rounding of written coordinates \[-\].
const ON_EDGE: f64 = 1e-6;

/// Nodes that hang.
pub(crate) struct Hanging<const D: usize> {
    /// Position of the first \[m\].
    pub at: [f64; D],
    /// Block and cell of the edge that it lies on.
    pub cell: (usize, usize),
    /// Number of such nodes.
    pub count: usize,
}

/// Straight edges of a face, in two pieces where they have a node in their middle.
fn edges<const D: usize>(mesh: &Mesh<D>, side: &Side) -> Vec<[usize; 2]> {
    let (nodes, corners) = (face_nodes(mesh, side), face_kind(mesh, side).corners());
    let count = if D == 2 { 1 } else { corners };
    let of = |k: usize| {
        let (a, b) = (nodes[k], nodes[(k + 1) % corners]);
        let middle = if nodes.len() > corners { Some(nodes[corners + k]) } else { None };
        match middle {
            Some(middle) => vec![[a, middle], [middle, b]],
            None => vec![[a, b]],
        }
    };
    (0..count).flat_map(of).collect()
}

/// True if a position lies within an edge, between its ends.
fn within<const D: usize>(x: &[f64; D], [a, b]: [&[f64; D]; 2]) -> bool {
    let dot = |u: &[f64; D], v: &[f64; D]| u.iter().zip(v).map(|(u, v)| u * v).sum::<f64>();
    let sub = |u: &[f64; D], v: &[f64; D]| -> [f64; D] { std::array::from_fn(|c| u[c] - v[c]) };
    let (edge, from) = (sub(b, a), sub(x, a));
    let square = dot(&edge, &edge);
    let share = dot(&from, &edge) / square;
    let off: [f64; D] = std::array::from_fn(|c| from[c] - share * edge[c]);
    share > ON_EDGE && share < 1.0 - ON_EDGE && dot(&off, &off) <= ON_EDGE * ON_EDGE * square
}

/// Nodes of the boundary in a tree, each with its number.
fn tree<const D: usize>(mesh: &Mesh<D>, sides: &[Side]) -> RTree<GeomWithData<[f64; D], usize>> {
    let nodes: BTreeSet<usize> = sides.iter().flat_map(|side| face_nodes(mesh, side)).collect();
    RTree::bulk_load(nodes.into_iter().map(|n| GeomWithData::new(mesh.nodes[n], n)).collect())
}

/// The box around an edge, wider by what is rounding.
fn around<const D: usize>([a, b]: [&[f64; D]; 2]) -> AABB<[f64; D]> {
    let length = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let margin = ON_EDGE * length;
    let low = std::array::from_fn(|c| a[c].min(b[c]) - margin);
    AABB::from_corners(low, std::array::from_fn(|c| a[c].max(b[c]) + margin))
}

/// Nodes that hang on edges of cells of their own part, given the boundary of the mesh; `None` if there are none.
pub(crate) fn hanging<const D: usize>(
    mesh: &Mesh<D>,
    Parts { root, .. }: &Parts,
    boundary: &[Side],
) -> Option<Hanging<D>> {
    let named: BTreeSet<Side> = mesh.side_sets.values().flatten().copied().collect();
    let (bordering, open): (Vec<Side>, Vec<Side>) = boundary.iter().partition(|side| named.contains(side));
    if open.is_empty() {
        return None;
    }
    let on_named: BTreeSet<usize> = bordering.iter().flat_map(|side| face_nodes(mesh, side)).collect();
    let named_edges: BTreeSet<[usize; 2]> =
        bordering.iter().flat_map(|side| edges(mesh, side)).map(sorted).collect();
    let tree = tree(mesh, boundary);
    let mut found: BTreeSet<usize> = BTreeSet::new();
    let mut first = None;
    for side in &open {
        for edge in edges(mesh, side) {
            let ends = edge.map(|n| &mesh.nodes[n]);
            let has_name = named_edges.contains(&sorted(edge));
            let hangs = |n: &usize| {
                !edge.contains(n)
                    && root[*n] == root[edge[0]]
                    && !(has_name && on_named.contains(n))
                    && within(&mesh.nodes[*n], ends)
            };
            for n in tree.locate_in_envelope(around(ends)).map(|node| node.data).filter(hangs) {
                found.insert(n);
                first = first.or(Some((n, (side.block, side.cell))));
            }
        }
    }
    let (node, cell) = first?;
    Some(Hanging { at: mesh.nodes[node], cell, count: found.len() })
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
