//! Identification of elements of face groups with faces of cells.

use super::{Options, RawMesh};
use crate::mesh::error::MeshError;
use crate::mesh::{Mesh, OmittedElements, Side};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Corners of a face, ascending; the fourth of a triangle and the third and fourth of an edge are absent.
type Key = [usize; 4];

/// A node that belongs to no cell.
pub(super) const UNUSED: usize = usize::MAX;

/// Named faces, and elements of their groups that are faces of no cell.
type Faces = (BTreeMap<String, Vec<Side>>, BTreeMap<String, OmittedElements>);

/// A requested face.
struct FaceRequest<'a> {
    key: Key,
    /// Number of its corners.
    corners: usize,
    /// All nodes, ascending.
    nodes: Vec<usize>,
    /// The only element whose face is meant, if given.
    owner: Option<u64>,
    /// Number of the element that names the face.
    element: u64,
    /// Type of this element.
    kind: &'static str,
    /// Sets it belongs to.
    names: Rc<[&'a str]>,
    /// Number of cells that have it.
    found: usize,
}

impl FaceRequest<'_> {
    /// The first of its sets, for an error.
    fn group(&self) -> String {
        self.names.first().map_or_else(String::new, |n| (*n).to_string())
    }
}

fn key(corners: impl Iterator<Item = usize>) -> Key {
    let mut key = [UNUSED; 4];
    for (k, c) in key.iter_mut().zip(corners) {
        *k = c;
    }
    key.sort_unstable();
    key
}

fn sorted(mut nodes: Vec<usize>) -> Vec<usize> {
    nodes.sort_unstable();
    nodes
}

impl RawMesh {
    /// The named faces of a mesh. `connectivity` holds, for each block of the file, the nodes of its elements in the
    /// numbering of the mesh, or [`UNUSED`]; `cells` the numbers of the mesh's cells.
    ///
    /// A face between two cells belongs to both: both sides are in the set, with the lower (block, cell, face) first.
    pub(super) fn side_sets<const D: usize>(
        &self,
        mesh: &Mesh<D>,
        connectivity: &[Vec<usize>],
        index: impl Fn(u64) -> usize,
        cells: &[Vec<u64>],
        names: &[Vec<String>],
        options: &Options,
    ) -> Result<Faces, MeshError> {
        let mut requests = self.grouped_faces::<D>(connectivity, names);
        for (name, sides) in &self.surfaces {
            let names: Rc<[&str]> = Rc::new([name.as_str()]);
            for side in sides {
                let nodes = sorted(side.corners.iter().map(|&n| index(n)).collect());
                let (key, corners) = (key(nodes.iter().copied()), nodes.len());
                let (owner, names) = (Some(side.element), Rc::clone(&names));
                let (element, kind) = (side.element, "face");
                requests.push(FaceRequest { key, corners, nodes, owner, element, kind, names, found: 0 });
            }
        }
        requests.sort_by_key(|w| (w.key, w.element));
        let mut sets: BTreeMap<String, Vec<Side>> = BTreeMap::new();
        for (b, block) in mesh.blocks.iter().enumerate() {
            for (cell, &tag) in cells[b].iter().enumerate() {
                let nodes = block.cell(cell);
                for (face, local) in block.kind.faces().iter().enumerate() {
                    let all: Vec<usize> = local.nodes.iter().map(|&a| nodes[a]).collect();
                    let side = Side { block: b, cell, face };
                    collect(&mut requests, &all, local.kind.corners(), tag, side, &mut sets)?;
                }
            }
        }
        if !options.leave_out {
            no_orphans(&requests)?;
        }
        Ok((sets, left_out(&requests)))
    }

    /// Elements of the face groups.
    fn grouped_faces<'a, const D: usize>(
        &self,
        connectivity: &[Vec<usize>],
        names: &'a [Vec<String>],
    ) -> Vec<FaceRequest<'a>> {
        let mut requests = Vec::new();
        for (block, connectivity) in self.blocks.iter().zip(connectivity) {
            if block.shape.dimension() + 1 != D || block.groups.is_empty() {
                continue;
            }
            let names: Rc<[&str]> =
                block.groups.iter().flat_map(|&g| names[g].iter().map(String::as_str)).collect();
            for (nodes, &element) in connectivity.chunks_exact(block.shape.nodes()).zip(&block.tags) {
                let corners = block.shape.corners();
                let (key, names) = (key(nodes[..corners].iter().copied()), Rc::clone(&names));
                let nodes = sorted(nodes.to_vec());
                let kind = block.shape.name();
                requests.push(FaceRequest {
                    key,
                    corners,
                    nodes,
                    owner: None,
                    element,
                    kind,
                    names,
                    found: 0,
                });
            }
        }
        requests
    }
}

/// Adds a side once to each set that requests it. Faces of equal order must agree in all nodes: the two sides of a crack of one
/// element share the corners but not the middle.
fn collect(
    requests: &mut [FaceRequest<'_>],
    all: &[usize],
    corners: usize,
    cell: u64,
    side: Side,
    sets: &mut BTreeMap<String, Vec<Side>>,
) -> Result<(), MeshError> {
    let key = key(all[..corners].iter().copied());
    let from = requests.partition_point(|w| w.key < key);
    let matching = requests[from..].iter_mut().take_while(|w| w.key == key);
    let mut nodes: Option<Vec<usize>> = None;
    for w in matching {
        let same_order = w.nodes.len() == all.len();
        if w.corners != corners
            || w.owner.is_some_and(|o| o != cell)
            || same_order && w.nodes != *nodes.get_or_insert_with(|| sorted(all.to_vec()))
        {
            continue;
        }
        w.found += 1;
        if w.found > 2 {
            return Err(MeshError::Crowded { group: w.group(), element: w.element, cell });
        }
        for name in w.names.iter() {
            let sides = sets.entry((*name).to_string()).or_default();
            if sides.last() != Some(&side) {
                sides.push(side);
            }
        }
    }
    Ok(())
}

/// Elements of face groups that are faces of no cell.
fn left_out(requests: &[FaceRequest<'_>]) -> BTreeMap<String, OmittedElements> {
    let mut groups: BTreeMap<String, OmittedElements> = BTreeMap::new();
    for w in requests.iter().filter(|w| w.found == 0) {
        for name in w.names.iter() {
            let new = OmittedElements { kind: w.kind.to_string(), count: 0, element: w.element, read: true };
            let left = groups.entry((*name).to_string()).or_insert(new);
            left.count += 1;
            left.element = left.element.min(w.element);
        }
    }
    groups
}

/// Refuses face groups with elements that are faces of no cell; names the first.
fn no_orphans(requests: &[FaceRequest<'_>]) -> Result<(), MeshError> {
    let lost = || requests.iter().filter(|w| w.found == 0);
    let Some(first) = lost().min_by_key(|w| w.element) else {
        return Ok(());
    };
    let group = first.group();
    let count = lost().filter(|w| w.names.contains(&group.as_str())).count();
    Err(MeshError::Orphan { group, element: first.element, count })
}
