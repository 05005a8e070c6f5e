//! Meshes: nodes, blocks of cells of one kind, and named sets of cell faces.

pub mod abaqus;
mod boundary;
mod check;
pub mod coarsening;
pub mod curve;
mod error;
pub mod extrude;
pub mod fault;
pub mod generate;
pub mod gmsh;
mod locate;
mod meeting;
pub mod netcdf;
mod raw;
pub mod sheet;
pub mod spacing;
pub mod split;
pub mod stl;
pub mod triangles;

pub use error::{GroupName, Holder, MeshError, Part, Place};
pub use locate::{Location, locate};
pub use meeting::{cut, meeting};
pub use raw::{GroupTag, Options, RawBlock, RawGroup, RawMesh, RawNode, RawSide, Shape, UnreadElements};

use crate::element::{ElementKind, FaceKind};
use std::collections::BTreeMap;

/// Cells of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cells {
    /// Kind.
    pub kind: ElementKind,
    /// Nodes of all cells, one cell after another.
    pub connectivity: Vec<usize>,
}

impl Cells {
    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.connectivity.len() / self.kind.nodes()
    }

    /// True if there are no cells.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.connectivity.is_empty()
    }

    /// Nodes of one cell.
    #[must_use]
    pub fn cell(&self, cell: usize) -> &[usize] {
        let n = self.kind.nodes();
        &self.connectivity[cell * n..(cell + 1) * n]
    }
}

/// A face of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// Block of cells.
    pub block: usize,
    /// Cell in the block.
    pub cell: usize,
    /// Face of the cell.
    pub face: usize,
}

/// Elements of a group that do not belong to the mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OmittedElements {
    /// Their type.
    pub kind: String,
    /// Number of them.
    pub count: usize,
    /// Number in the file of the first.
    pub element: u64,
    /// True if elements of this type are read, but these are no faces of cells.
    pub read: bool,
}

/// A mesh in `D` dimensions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh<const D: usize> {
    /// Positions \[m\].
    pub nodes: Vec<[f64; D]>,
    /// Blocks of cells.
    pub blocks: Vec<Cells>,
    /// Named faces.
    pub side_sets: BTreeMap<String, Vec<Side>>,
    /// Named groups of cells, as ascending lists of blocks: a block is either in a group or not.
    pub cell_sets: BTreeMap<String, Vec<usize>>,
    /// Named nodes, ascending.
    pub node_sets: BTreeMap<String, Vec<usize>>,
    /// Elements of a file that are left out, by the names of their groups.
    pub left_out: BTreeMap<String, OmittedElements>,
}

impl<const D: usize> Mesh<D> {
    /// Adds another mesh unchanged: its nodes and blocks follow those here; its sets are named `prefix.set`.
    pub fn append(&mut self, other: Self, prefix: &str) {
        let (nodes, blocks) = (self.nodes.len(), self.blocks.len());
        self.nodes.extend(other.nodes);
        self.blocks.extend(other.blocks.into_iter().map(|mut b| {
            b.connectivity.iter_mut().for_each(|n| *n += nodes);
            b
        }));
        for (name, sides) in other.side_sets {
            let sides = sides.into_iter().map(|s| Side { block: s.block + blocks, ..s }).collect();
            self.side_sets.insert(format!("{prefix}.{name}"), sides);
        }
        for (name, set) in other.cell_sets {
            self.cell_sets.insert(format!("{prefix}.{name}"), set.iter().map(|b| b + blocks).collect());
        }
        for (name, set) in other.node_sets {
            self.node_sets.insert(format!("{prefix}.{name}"), set.iter().map(|n| n + nodes).collect());
        }
        self.left_out
            .extend(other.left_out.into_iter().map(|(name, left)| (format!("{prefix}.{name}"), left)));
    }

    /// Mesh of some blocks, with the nodes they use and the parts of the sets that touch them. A face between a selected block and another one thus keeps
    /// the side of the selected block. `blocks` ascend.
    #[must_use]
    pub fn part(&self, blocks: &[usize]) -> Self {
        let mut used = vec![false; self.nodes.len()];
        blocks.iter().flat_map(|&b| &self.blocks[b].connectivity).for_each(|&n| used[n] = true);
        let mut next = 0..;
        let number: Vec<Option<usize>> = used.iter().map(|&u| if u { next.next() } else { None }).collect();
        let new_block = |b: usize| blocks.binary_search(&b).ok();
        fn kept<T>(sets: impl Iterator<Item = (String, Vec<T>)>) -> BTreeMap<String, Vec<T>> {
            sets.filter(|(_, set)| !set.is_empty()).collect()
        }
        let sides = |set: &Vec<Side>| {
            set.iter().filter_map(|s| new_block(s.block).map(|block| Side { block, ..*s })).collect()
        };
        Self {
            nodes: self.nodes.iter().zip(&used).filter(|(_, used)| **used).map(|(x, _)| *x).collect(),
            blocks: blocks
                .iter()
                .map(|&b| {
                    let Cells { kind, connectivity } = &self.blocks[b];
                    Cells {
                        kind: *kind,
                        connectivity: connectivity.iter().filter_map(|&n| number[n]).collect(),
                    }
                })
                .collect(),
            side_sets: kept(self.side_sets.iter().map(|(name, set)| (name.clone(), sides(set)))),
            cell_sets: kept(
                self.cell_sets
                    .iter()
                    .map(|(name, set)| (name.clone(), set.iter().filter_map(|&b| new_block(b)).collect())),
            ),
            node_sets: kept(
                self.node_sets
                    .iter()
                    .map(|(name, set)| (name.clone(), set.iter().filter_map(|&n| number[n]).collect())),
            ),
            left_out: self.left_out.clone(),
        }
    }
}

/// Nodes of a face, in the order of [`ElementKind::faces`].
#[must_use]
pub fn face_nodes<const D: usize>(mesh: &Mesh<D>, side: &Side) -> Vec<usize> {
    let block = &mesh.blocks[side.block];
    let cell = block.cell(side.cell);
    block.kind.faces()[side.face].nodes.iter().map(|&a| cell[a]).collect()
}

/// A face of a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshFace {
    /// Kind.
    pub kind: FaceKind,
    /// Nodes in the order of the kind.
    pub nodes: Vec<usize>,
}

impl MeshFace {
    /// The face of a side.
    #[must_use]
    pub fn new<const D: usize>(mesh: &Mesh<D>, side: &Side) -> Self {
        Self { kind: face_kind(mesh, side), nodes: face_nodes(mesh, side) }
    }
}

/// Kind of a face.
#[must_use]
pub fn face_kind<const D: usize>(mesh: &Mesh<D>, side: &Side) -> FaceKind {
    mesh.blocks[side.block].kind.faces()[side.face].kind
}

/// Nodes of a set of faces, ascending, without repetition.
#[must_use]
pub fn nodes_of_sides<const D: usize>(mesh: &Mesh<D>, sides: &[Side]) -> Vec<usize> {
    let mut nodes: Vec<usize> = sides.iter().flat_map(|s| face_nodes(mesh, s)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
