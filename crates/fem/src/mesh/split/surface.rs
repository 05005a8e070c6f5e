//! Search for the cells on both sides of the faces of a surface.

use super::{SplitError, Surface};
use crate::mesh::{Mesh, Side, face_nodes};
use std::collections::{BTreeMap, BTreeSet};

/// Corners of a face, ascending; unused entries are filled with the largest number.
pub(super) type Key = [usize; 4];

/// A face between two cells.
#[derive(Clone, Debug)]
pub(super) struct InnerFace {
    /// Index in the list of the surface.
    pub index: usize,
    /// The cells' faces: minus, plus.
    pub sides: [Side; 2],
    /// Nodes of these faces as numbered before splitting, in the order of each cell.
    pub nodes: [Vec<usize>; 2],
    /// True if the path along the fault passes the face from its second end to its first (plane only).
    pub backwards: bool,
}

impl InnerFace {
    /// Position of the node with old number `old` in the list of a side.
    pub(super) fn place(&self, side: usize, old: usize) -> usize {
        self.nodes[side].iter().position(|&n| n == old).unwrap_or(0)
    }

    /// Nodes of the minus side: in the plane along the fault (end, middle if any, end), in space in the given order.
    pub(super) fn path(&self, dimension: usize) -> Vec<usize> {
        let mut nodes = self.nodes[0].clone();
        if dimension == 2 {
            // Faces list both ends first.
            nodes[1..].reverse();
            if self.backwards {
                nodes.reverse();
            }
        }
        nodes
    }

    /// Corners of the minus side, in order.
    pub(super) fn corners(&self, dimension: usize) -> &[usize] {
        let n = corners_of(dimension, self.nodes[0].len());
        &self.nodes[0][..n]
    }

    /// Exchanges minus and plus.
    pub(super) fn turn(&mut self) {
        self.sides.swap(0, 1);
        self.nodes.swap(0, 1);
    }
}

/// Corners of a face with `nodes` nodes.
pub(super) fn corners_of(dimension: usize, nodes: usize) -> usize {
    match (dimension, nodes) {
        (2, _) => 2,
        (_, 3 | 6) => 3,
        _ => 4,
    }
}

/// Key of the face with these nodes.
pub(super) fn key(dimension: usize, nodes: &[usize]) -> Key {
    let mut key = [usize::MAX; 4];
    let n = corners_of(dimension, nodes.len()).min(nodes.len());
    key[..n].copy_from_slice(&nodes[..n]);
    key.sort_unstable();
    key
}

/// Finds every face of every surface in the mesh; minus is the cell that has the face in the given direction.
pub(super) fn locate<const D: usize>(
    mesh: &Mesh<D>,
    surfaces: &[Surface<D>],
) -> Result<Vec<Vec<InnerFace>>, SplitError> {
    let wanted = wanted(mesh, surfaces)?;
    let found = sides_with(mesh, &wanted);
    surfaces
        .iter()
        .map(|surface| {
            let faces = surface.faces.iter().enumerate();
            faces.map(|(index, nodes)| inner(mesh, &found, surface, index, nodes)).collect()
        })
        .collect()
}

/// Keys of all faces, after checks that need no cells.
fn wanted<const D: usize>(mesh: &Mesh<D>, surfaces: &[Surface<D>]) -> Result<BTreeSet<Key>, SplitError> {
    let mut owner: BTreeMap<Key, &str> = BTreeMap::new();
    let mut names: Vec<&str> = Vec::new();
    for surface in surfaces {
        let name = &surface.name;
        if surface.faces.is_empty() {
            return Err(SplitError::Empty { surface: name.clone() });
        }
        for set in [format!("{name}.minus"), format!("{name}.plus")] {
            if mesh.side_sets.contains_key(&set) || names.contains(&name.as_str()) {
                return Err(SplitError::Exists { set });
            }
        }
        names.push(name);
        for (face, nodes) in surface.faces.iter().enumerate() {
            if !is_face_list(D, nodes.len()) {
                return Err(SplitError::NotAFace { surface: name.clone(), face, nodes: nodes.clone() });
            }
            if let Some(before) = owner.insert(key(D, nodes), name) {
                let before = before.to_string();
                return Err(SplitError::Twice { surface: name.clone(), face, nodes: nodes.clone(), before });
            }
        }
    }
    Ok(owner.into_keys().collect())
}

fn is_face_list(dimension: usize, nodes: usize) -> bool {
    match dimension {
        2 => matches!(nodes, 2 | 3),
        _ => matches!(nodes, 3 | 4 | 6 | 8 | 9),
    }
}

/// Sides of cells that are one of the `wanted` faces.
fn sides_with<const D: usize>(mesh: &Mesh<D>, wanted: &BTreeSet<Key>) -> BTreeMap<Key, Vec<Side>> {
    let mut marked = vec![false; mesh.nodes.len()];
    for &node in wanted.iter().flatten() {
        if let Some(mark) = marked.get_mut(node) {
            *mark = true;
        }
    }
    let mut found: BTreeMap<Key, Vec<Side>> = BTreeMap::new();
    for (block, cells) in mesh.blocks.iter().enumerate() {
        for cell in 0..cells.len() {
            let nodes = cells.cell(cell);
            // Most cells are far from every surface.
            if nodes.iter().filter(|&&n| marked[n]).count() < D {
                continue;
            }
            for face in 0..cells.kind.faces().len() {
                let side = Side { block, cell, face };
                let key = key(D, &face_nodes(mesh, &side));
                if wanted.contains(&key) {
                    found.entry(key).or_default().push(side);
                }
            }
        }
    }
    found
}

fn inner<const D: usize>(
    mesh: &Mesh<D>,
    found: &BTreeMap<Key, Vec<Side>>,
    surface: &Surface<D>,
    face: usize,
    nodes: &[usize],
) -> Result<InnerFace, SplitError> {
    let (surface, owned) = (surface.name.clone(), nodes.to_vec());
    let sides = match found.get(&key(D, nodes)).map(Vec::as_slice) {
        None => return Err(SplitError::NotAFace { surface, face, nodes: owned }),
        Some([_]) => return Err(SplitError::Boundary { surface, face, nodes: owned }),
        Some(&[a, b]) => [a, b],
        Some(more) => {
            return Err(SplitError::Crowded { surface, face, nodes: owned, cells: more.len() });
        }
    };
    let mut inner =
        InnerFace { index: face, sides, nodes: sides.map(|s| face_nodes(mesh, &s)), backwards: false };
    let n = corners_of(D, nodes.len());
    if !same_direction(&nodes[..n], inner.corners(D)) {
        inner.turn();
        if !same_direction(&nodes[..n], inner.corners(D)) {
            // The corners are not in sequence around the face (a quadrilateral given crosswise).
            return Err(SplitError::NotAFace { surface, face, nodes: owned });
        }
    }
    Ok(inner)
}

/// True if two lists of the same corners run in the same direction.
fn same_direction(a: &[usize], b: &[usize]) -> bool {
    let n = a.len();
    let Some(shift) = b.iter().position(|&node| node == a[0]) else { return false };
    if n == 2 {
        return shift == 0;
    }
    (0..n).all(|k| a[k] == b[(shift + k) % n])
}
