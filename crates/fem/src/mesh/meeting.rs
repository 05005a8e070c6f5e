//! Faces at which bodies meet: those of one that lie in or on cells of another.

use super::boundary::boundary;
use super::locate::holds_position;
use super::{Mesh, Side, face_kind, face_nodes};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use std::ops::Range;

/// Rounding of a coordinate over the size of a face: bodies that share a plane are placed in decimal numbers.
const ROUNDING: f64 = 1e-8;

/// Boxes of cells with their blocks and numbers.
type CellTree<const D: usize> = RTree<GeomWithData<Rectangle<[f64; D]>, (usize, usize)>>;

/// Centre of the corners of a face \[m\].
fn centre<const D: usize>(mesh: &Mesh<D>, side: &Side) -> [f64; D] {
    let corners = face_kind(mesh, side).corners();
    let nodes = face_nodes(mesh, side);
    std::array::from_fn(|c| nodes[..corners].iter().map(|n| mesh.nodes[*n][c]).sum::<f64>() / corners as f64)
}

fn tree<const D: usize>(mesh: &Mesh<D>, blocks: Range<usize>) -> CellTree<D> {
    let bounded = |block: usize| {
        let cells = &mesh.blocks[block];
        (0..cells.len()).map(move |cell| {
            let points = cells.cell(cell).iter().map(|n| &mesh.nodes[*n]);
            let of = AABB::from_points(points);
            GeomWithData::new(Rectangle::from_aabb(of), (block, cell))
        })
    };
    RTree::bulk_load(blocks.flat_map(bounded).collect())
}

/// Centres of the faces on the boundary of the blocks `one` that lie in or on cells of the blocks `other` \[m\].
#[must_use]
pub fn meeting<const D: usize>(mesh: &Mesh<D>, one: Range<usize>, other: Range<usize>) -> Vec<[f64; D]> {
    let tree = tree(mesh, other);
    let lies = |side: Side| {
        let x = centre(mesh, &side);
        let corner = mesh.nodes[face_nodes(mesh, &side)[0]];
        let reach = (0..D).map(|c| (x[c] - corner[c]).abs()).fold(0.0, f64::max);
        let low = x.map(|c| c - ROUNDING * reach);
        let high = x.map(|c| c + ROUNDING * reach);
        let near = tree.locate_in_envelope_intersecting(AABB::from_corners(low, high));
        near.map(|cell| cell.data).any(|cell| holds_position(mesh, cell, &x)).then_some(x)
    };
    boundary(mesh, one).into_iter().filter_map(lies).collect()
}
