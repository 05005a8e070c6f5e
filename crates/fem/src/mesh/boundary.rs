//! The boundary of a mesh.

use super::{Mesh, Side, face_kind, face_nodes};
use rayon::prelude::*;
use std::ops::Range;

/// Smallest corners of a face, and its number of nodes: no two faces of a mesh without overlaps have the same.
type Key = ([usize; 3], usize);

fn key<const D: usize>(mesh: &Mesh<D>, side: &Side) -> Key {
    let kind = face_kind(mesh, side);
    let mut corners = face_nodes(mesh, side);
    corners.truncate(kind.corners());
    corners.sort_unstable();
    (std::array::from_fn(|k| corners.get(k).copied().unwrap_or(0)), kind.nodes())
}

/// Faces of cells in some blocks whose nodes no other cell in them has.
pub(super) fn boundary<const D: usize>(mesh: &Mesh<D>, blocks: Range<usize>) -> Vec<Side> {
    let of_cell = |block: usize, cell: usize| {
        let faces = 0..mesh.blocks[block].kind.faces().len();
        faces.map(move |face| Side { block, cell, face }).map(|side| (key(mesh, &side), side))
    };
    let of_block = |block: usize| {
        (0..mesh.blocks[block].len()).into_par_iter().flat_map_iter(move |cell| of_cell(block, cell))
    };
    let mut keyed: Vec<(Key, Side)> = blocks.into_par_iter().flat_map(of_block).collect();
    keyed.par_sort_unstable();
    keyed.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|same| same[0].1).collect()
}
