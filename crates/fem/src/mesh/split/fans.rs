//! Fans of cells around the nodes of surfaces: each fan that touches a surface gets its own copy of the node.

use super::surface::{InnerFace, Key, key};
use crate::mesh::{Mesh, Side, face_nodes};
use std::collections::{BTreeMap, BTreeSet};

/// New numbers: (node, block, cell) -> node of the cell after splitting, if different.
#[derive(Debug, Default)]
pub(super) struct Copies {
    renamed: BTreeMap<(usize, usize, usize), usize>,
    /// Original of each new node; the first new node has the number of nodes before splitting as its number.
    originals: Vec<usize>,
}

impl Copies {
    fn copy(&self, node: usize, side: &Side) -> usize {
        self.renamed.get(&(node, side.block, side.cell)).copied().unwrap_or(node)
    }
}

/// True if some node of the face has different copies on its two sides.
pub(super) fn opens(copies: &Copies, face: &InnerFace) -> bool {
    face.nodes[0].iter().any(|&n| copies.copy(n, &face.sides[0]) != copies.copy(n, &face.sides[1]))
}

/// Cells at one node, as (block, cell).
type NodeCells = Vec<(usize, usize)>;

/// Finds the fans around every node of the surfaces and numbers their copies: by ascending node, then by fan. The order of fans
/// does not depend on the order of cells: first those that touch no plus side, then by the nodes of their cells.
pub(super) fn classify<const D: usize>(mesh: &Mesh<D>, surfaces: &[Vec<InnerFace>]) -> Copies {
    let cut: BTreeSet<Key> = surfaces.iter().flatten().map(|f| key(D, &f.nodes[0])).collect();
    let plus: BTreeSet<(usize, usize, usize)> = touched(surfaces, 1);
    let minus: BTreeSet<(usize, usize, usize)> = touched(surfaces, 0);
    let mut copies = Copies::default();
    for (node, around) in around(mesh, surfaces) {
        let mut fans: Vec<(bool, Vec<usize>, NodeCells)> = Vec::new();
        for fan in fans_at(mesh, &cut, node, &around) {
            let on =
                |set: &BTreeSet<(usize, usize, usize)>| fan.iter().any(|&(b, c)| set.contains(&(node, b, c)));
            let name = fan.iter().map(|&(b, c)| sorted(mesh.blocks[b].cell(c))).min().unwrap_or_default();
            // A fan without a face of a surface is attached at the node alone (a pinched mesh) and is left unchanged.
            if on(&plus) || on(&minus) {
                fans.push((on(&plus), name, fan));
            }
        }
        fans.sort_unstable();
        for (_, _, fan) in fans.into_iter().skip(1) {
            let new = mesh.nodes.len() + copies.originals.len();
            copies.originals.push(node);
            copies.renamed.extend(fan.into_iter().map(|(b, c)| ((node, b, c), new)));
        }
    }
    copies
}

fn sorted(nodes: &[usize]) -> Vec<usize> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes
}

/// (node, block, cell) of all cells and nodes of faces on one side.
fn touched(surfaces: &[Vec<InnerFace>], side: usize) -> BTreeSet<(usize, usize, usize)> {
    let faces = surfaces.iter().flatten();
    faces
        .flat_map(|f| f.nodes[side].iter().map(move |&n| (n, f.sides[side].block, f.sides[side].cell)))
        .collect()
}

/// Cells around each node of the surfaces, by ascending node.
fn around<const D: usize>(mesh: &Mesh<D>, surfaces: &[Vec<InnerFace>]) -> BTreeMap<usize, NodeCells> {
    let mut around: BTreeMap<usize, NodeCells> =
        surfaces.iter().flatten().flat_map(|f| &f.nodes[0]).map(|&n| (n, NodeCells::new())).collect();
    let mut marked = vec![false; mesh.nodes.len()];
    around.keys().for_each(|&n| marked[n] = true);
    for (block, cells) in mesh.blocks.iter().enumerate() {
        for cell in 0..cells.len() {
            for &node in cells.cell(cell) {
                if marked[node]
                    && let Some(list) = around.get_mut(&node)
                {
                    list.push((block, cell));
                }
            }
        }
    }
    around
}

/// Groups the cells around a node: cells that share a face containing the node belong together, unless the face is cut.
fn fans_at<const D: usize>(
    mesh: &Mesh<D>,
    cut: &BTreeSet<Key>,
    node: usize,
    around: &NodeCells,
) -> Vec<NodeCells> {
    let mut group: Vec<usize> = (0..around.len()).collect();
    let mut owner: BTreeMap<Key, usize> = BTreeMap::new();
    for (k, &(block, cell)) in around.iter().enumerate() {
        for face in 0..mesh.blocks[block].kind.faces().len() {
            let nodes = face_nodes(mesh, &Side { block, cell, face });
            let key = key(D, &nodes);
            if !nodes.contains(&node) || cut.contains(&key) {
                continue;
            }
            if let Some(other) = owner.insert(key, k) {
                let (from, to) = (group[k], group[other]);
                group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
            }
        }
    }
    let mut fans: BTreeMap<usize, NodeCells> = BTreeMap::new();
    for (k, &cell) in around.iter().enumerate() {
        fans.entry(group[k]).or_default().push(cell);
    }
    fans.into_values().collect()
}

/// Assigns the new nodes to the cells, and all copies to the node sets.
pub(super) fn apply<const D: usize>(mesh: &mut Mesh<D>, copies: &Copies) {
    let first = mesh.nodes.len();
    for &original in &copies.originals {
        mesh.nodes.push(mesh.nodes[original]);
    }
    for (&(node, block, cell), &new) in &copies.renamed {
        let cells = &mut mesh.blocks[block];
        let n = cells.kind.nodes();
        for entry in &mut cells.connectivity[cell * n..(cell + 1) * n] {
            if *entry == node {
                *entry = new;
            }
        }
    }
    for set in mesh.node_sets.values_mut() {
        let members: BTreeSet<usize> = set.iter().copied().collect();
        let added = copies.originals.iter().enumerate().filter(|(_, n)| members.contains(n));
        set.extend(added.map(|(k, _)| first + k));
    }
}
