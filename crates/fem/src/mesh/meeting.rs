//! Faces at which bodies meet: those of one that lie in or on cells of another, and the sides of cuts.

use super::boundary::boundary;
use super::locate::holds_position;
use super::{Mesh, Side, face_kind, face_nodes};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use std::collections::BTreeSet;
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

fn tree<const D: usize>(mesh: &Mesh<D>, cells: impl Iterator<Item = (usize, usize)>) -> CellTree<D> {
    let bounded = |(block, cell): (usize, usize)| {
        let points = mesh.blocks[block].cell(cell).iter().map(|n| &mesh.nodes[*n]);
        GeomWithData::new(Rectangle::from_aabb(AABB::from_points(points)), (block, cell))
    };
    RTree::bulk_load(cells.map(bounded).collect())
}

/// Centre of a face if it lies in or on a cell of the tree other than its own \[m\].
fn centre_within<const D: usize>(mesh: &Mesh<D>, side: &Side, tree: &CellTree<D>) -> Option<[f64; D]> {
    let x = centre(mesh, side);
    let corner = mesh.nodes[face_nodes(mesh, side)[0]];
    let reach = (0..D).map(|c| (x[c] - corner[c]).abs()).fold(0.0, f64::max);
    let low = x.map(|c| c - ROUNDING * reach);
    let high = x.map(|c| c + ROUNDING * reach);
    let near = tree.locate_in_envelope_intersecting(AABB::from_corners(low, high));
    let mut others = near.map(|cell| cell.data).filter(|cell| *cell != (side.block, side.cell));
    others.any(|cell| holds_position(mesh, cell, &x)).then_some(x)
}

/// Centres of the faces on the boundary of the blocks `one` that lie in or on cells of the blocks `other` \[m\].
#[must_use]
pub fn meeting<const D: usize>(mesh: &Mesh<D>, one: Range<usize>, other: Range<usize>) -> Vec<[f64; D]> {
    let tree =
        tree(mesh, other.flat_map(|block| (0..mesh.blocks[block].len()).map(move |cell| (block, cell))));
    boundary(mesh, one).iter().filter_map(|side| centre_within(mesh, side, &tree)).collect()
}

/// Cells of a mesh up to which all are searched for what lies over them; of more, those at the boundary.
const ALL_CELLS: usize = 200_000;

/// Centres of the faces on the boundary of these blocks, less those of `known`, that lie in or on another cell \[m\]: the sides of a
/// cut, and parts that lie over each other.
#[must_use]
pub fn cut<const D: usize>(mesh: &Mesh<D>, blocks: Range<usize>, known: &BTreeSet<Side>) -> Vec<[f64; D]> {
    let sides: Vec<Side> =
        boundary(mesh, blocks.clone()).into_iter().filter(|side| !known.contains(side)).collect();
    if sides.is_empty() {
        return Vec::new();
    }
    let all =
        || blocks.clone().flat_map(|block| (0..mesh.blocks[block].len()).map(move |cell| (block, cell)));
    let bordering = || sides.iter().map(|side| (side.block, side.cell)).collect::<BTreeSet<_>>();
    let tree =
        if all().count() <= ALL_CELLS { tree(mesh, all()) } else { tree(mesh, bordering().into_iter()) };
    sides.iter().filter_map(|side| centre_within(mesh, side, &tree)).collect()
}
