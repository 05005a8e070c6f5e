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

/// All faces of cells in some blocks, each beside those that have the same nodes.
fn grouped<const D: usize>(mesh: &Mesh<D>, blocks: Range<usize>) -> Vec<(Key, Side)> {
    let of_cell = |block: usize, cell: usize| {
        let faces = 0..mesh.blocks[block].kind.faces().len();
        faces.map(move |face| Side { block, cell, face }).map(|side| (key(mesh, &side), side))
    };
    let of_block = |block: usize| {
        (0..mesh.blocks[block].len()).into_par_iter().flat_map_iter(move |cell| of_cell(block, cell))
    };
    let mut keyed: Vec<(Key, Side)> = blocks.into_par_iter().flat_map(of_block).collect();
    keyed.par_sort_unstable();
    keyed
}

/// Faces of cells in some blocks whose nodes no other cell in them has.
pub(super) fn boundary<const D: usize>(mesh: &Mesh<D>, blocks: Range<usize>) -> Vec<Side> {
    let keyed = grouped(mesh, blocks);
    keyed.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|same| same[0].1).collect()
}

/// The corner after the smallest one, in the sense in which its cell has the face.
fn next_corner<const D: usize>(mesh: &Mesh<D>, side: &Side) -> usize {
    let corners = face_kind(mesh, side).corners();
    let nodes = &face_nodes(mesh, side)[..corners];
    let least = (0..corners).min_by_key(|k| nodes[*k]).unwrap_or(0);
    // An edge in the plane has two ends: its sense is that of the first.
    if corners == 2 { least } else { nodes[(least + 1) % corners] }
}

/// The boundary of a mesh, or two faces with the same nodes whose cells lie on the same side of it: three cells or more have it, or two that
/// see it in one sense, where cells that lie beside each other see it in opposite ones.
pub(super) fn single<const D: usize>(mesh: &Mesh<D>) -> Result<Vec<Side>, [Side; 2]> {
    let keyed = grouped(mesh, 0..mesh.blocks.len());
    let doubled = |same: &[(Key, Side)]| match same {
        [_] => false,
        [(_, a), (_, b)] => next_corner(mesh, a) == next_corner(mesh, b),
        _ => true,
    };
    match keyed.chunk_by(|a, b| a.0 == b.0).find(|same| doubled(same)) {
        Some(same) => Err([same[0].1, same[1].1]),
        None => Ok(keyed.chunk_by(|a, b| a.0 == b.0).filter(|s| s.len() == 1).map(|s| s[0].1).collect()),
    }
}
