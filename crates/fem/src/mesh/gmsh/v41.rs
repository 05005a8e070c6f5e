//! Version 4.1: nodes and elements in blocks, one for each geometric entity; the entities hold their physical groups.

use super::kinds::{self, Kind, Places};
use super::scan::Scan;
use crate::mesh::error::MeshError;
use crate::mesh::raw::{RawBlock, RawGroup, RawMesh, RawNode};
use std::collections::{BTreeMap, BTreeSet};

/// Largest number of physical groups of one entity. Each element of the entity is in the sets of all its groups, so that this
/// bounds the size of the mesh from a file of a given size; users have a handful.
const MOST_GROUPS: usize = 32;

/// Dimension and number of an entity.
type Entity = (usize, i64);

/// A block of elements of an entity whose groups are not yet known.
struct Block {
    entity: Entity,
    kind: Kind,
    tags: Vec<u64>,
    nodes: Vec<u64>,
}

/// Data read so far.
#[derive(Default)]
pub(super) struct Reader {
    /// Physical groups of the entities that have them.
    physical: BTreeMap<Entity, Vec<i64>>,
    nodes: Option<Vec<RawNode>>,
    blocks: Option<Vec<Block>>,
    places: Places,
}

impl Reader {
    pub(super) fn section(&mut self, scan: &mut Scan<'_>, section: &str) -> Result<bool, MeshError> {
        match section {
            "$Entities" => self.entities(scan, false)?,
            "$PartitionedEntities" => {
                scan.size("the number of partitions")?;
                let ghosts = scan.count("ghost entities", 2, 8)?;
                for _ in 0..ghosts {
                    scan.int("ghost entity")?;
                    scan.int("partition")?;
                }
                self.entities(scan, true)?;
            }
            "$Nodes" => self.nodes(scan)?,
            "$Elements" => self.elements(scan)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Reads points, curves, surfaces and volumes.
    fn entities(&mut self, scan: &mut Scan<'_>, partitioned: bool) -> Result<(), MeshError> {
        let mut counts = [0; 4];
        for count in &mut counts {
            // The smallest is a point: number, position, no group.
            *count = scan.count("entities", 5, 36)?;
        }
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                self.entity(scan, dimension, partitioned)?;
            }
        }
        Ok(())
    }

    fn entity(&mut self, scan: &mut Scan<'_>, dimension: usize, partitioned: bool) -> Result<(), MeshError> {
        let tag = scan.int("the number of an entity")?;
        if partitioned {
            scan.int("the dimension of the parent entity")?;
            scan.int("the number of the parent entity")?;
            for _ in 0..scan.count("partitions", 1, 4)? {
                scan.int("partition")?;
            }
        }
        // A point has a position, other entities a box.
        for _ in 0..if dimension == 0 { 3 } else { 6 } {
            scan.real("coordinate of an entity")?;
        }
        let count = scan.count("physical groups", 1, 4)?;
        if count > MOST_GROUPS {
            let (section, place) = (scan.section_name(), scan.place());
            let reason = "an entity in so many physical groups is no part of a mesh";
            return Err(MeshError::Unsupported { section, place, reason });
        }
        let mut groups = Vec::with_capacity(count);
        for _ in 0..count {
            // A negative number denotes the entity with reversed orientation.
            groups.push(scan.int("the number of a physical group")?.saturating_abs());
        }
        if dimension > 0 {
            for _ in 0..scan.count("bounding entities", 1, 4)? {
                scan.int("the number of a bounding entity")?;
            }
        }
        if !groups.is_empty() {
            self.physical.insert((dimension, tag), groups);
        }
        Ok(())
    }

    fn nodes(&mut self, scan: &mut Scan<'_>) -> Result<(), MeshError> {
        scan.once(self.nodes.is_some())?;
        let blocks = scan.count("blocks of nodes", 4, 20)?;
        let announced = scan.count("nodes", 4, 32)?;
        scan.size("the least number of a node")?;
        scan.size("the greatest number of a node")?;
        let mut nodes: Vec<RawNode> = Vec::with_capacity(announced);
        for _ in 0..blocks {
            let dimension = scan.dimension()?;
            scan.int("the number of an entity")?;
            // Parametric nodes have as many additional coordinates as the dimension of their entity.
            let further = if scan.int("whether nodes are parametric")? == 0 { 0 } else { dimension };
            let count = scan.count("nodes", 4 + further, 32 + 8 * further)?;
            let first = nodes.len();
            for _ in 0..count {
                nodes.push(RawNode { tag: scan.size("the number of a node")?, x: [0.0; 3] });
            }
            for node in &mut nodes[first..] {
                node.x = scan.coordinates()?;
                for _ in 0..further {
                    scan.real("parametric coordinate")?;
                }
            }
        }
        let (announced, held) = (announced as u64, nodes.len() as u64);
        self.nodes = Some(nodes);
        agree(scan, "nodes", announced, held)
    }

    fn elements(&mut self, scan: &mut Scan<'_>) -> Result<(), MeshError> {
        scan.once(self.blocks.is_some())?;
        let count = scan.count("blocks of elements", 4, 20)?;
        let announced = scan.count("elements", 2, 16)?;
        scan.size("the least number of an element")?;
        scan.size("the greatest number of an element")?;
        let mut blocks: Vec<Block> = Vec::new();
        let mut places = BTreeMap::new();
        let mut held = 0;
        for _ in 0..count {
            let mut block = block(scan, &mut self.places)?;
            held += block.tags.len() as u64;
            // Blocks of one type and entity are merged: a file may divide them as finely as it likes.
            let place = *places.entry((block.entity, block.kind)).or_insert(blocks.len());
            match blocks.get_mut(place) {
                Some(first) => {
                    first.tags.append(&mut block.tags);
                    first.nodes.append(&mut block.nodes);
                }
                None => blocks.push(block),
            }
        }
        self.blocks = Some(blocks);
        agree(scan, "elements", announced as u64, held)
    }

    pub(super) fn finish(self) -> Result<RawMesh, MeshError> {
        let nodes = self.nodes.ok_or(MeshError::MissingSection { section: "$Nodes" })?;
        let blocks = self.blocks.ok_or(MeshError::MissingSection { section: "$Elements" })?;
        let groups_of = |e: &Entity| self.physical.get(e).map_or(&[][..], Vec::as_slice);
        let all: BTreeSet<(usize, i64)> =
            blocks.iter().flat_map(|b| groups_of(&b.entity).iter().map(|&tag| (b.entity.0, tag))).collect();
        let all: Vec<(usize, i64)> = all.into_iter().collect();
        let groups =
            all.iter().map(|&(dimension, tag)| RawGroup { dimension, tag: Some(tag), name: None }).collect();
        let mut mesh = RawMesh { nodes, groups, ..RawMesh::default() };
        for Block { entity, kind, tags, nodes } in blocks {
            let groups: BTreeSet<usize> = groups_of(&entity)
                .iter()
                .filter_map(|&tag| all.binary_search(&(entity.0, tag)).ok())
                .collect();
            let groups = groups.into_iter().collect();
            match kind {
                Kind::Read(shape) => {
                    mesh.blocks.push(RawBlock { shape, groups, entity: Some(entity.1), tags, nodes });
                }
                Kind::Unread(other) => mesh.unread.extend(self.places.unread(other, &tags, groups)),
            }
        }
        Ok(mesh)
    }
}

/// One block of `$Elements`.
fn block(scan: &mut Scan<'_>, places: &mut Places) -> Result<Block, MeshError> {
    let dimension = scan.dimension()?;
    let entity = scan.int("the number of an entity")?;
    let at = scan.position();
    let number = scan.int("a type of element")?;
    let count = scan.size("elements")?;
    let Some(kind) = Kind::from_number(number) else {
        let element = scan.size("the number of an element")?;
        return Err(kinds::unknown(scan, at, element, number));
    };
    places.note(scan, at, kind);
    if kind.dimension() != dimension {
        return Err(scan.unexpected("elements of the dimension of their entity"));
    }
    let count = scan.bounded(count, "elements", 1 + kind.nodes(), 8 * (1 + kind.nodes()))?;
    let mut tags = Vec::with_capacity(count);
    let mut nodes = Vec::with_capacity(count * kind.nodes());
    for _ in 0..count {
        tags.push(scan.size("the number of an element")?);
        read_nodes(scan, kind, &mut nodes)?;
    }
    Ok(Block { entity: (dimension, entity), kind, tags, nodes })
}

/// The nodes of an element, in the order of VTK.
fn read_nodes(scan: &mut Scan<'_>, kind: Kind, nodes: &mut Vec<u64>) -> Result<(), MeshError> {
    let first = nodes.len();
    for _ in 0..kind.nodes() {
        nodes.push(scan.size("the number of a node")?);
    }
    kind.reorder(&mut nodes[first..]);
    Ok(())
}

fn agree(scan: &Scan<'_>, what: &'static str, announced: u64, held: u64) -> Result<(), MeshError> {
    if announced == held {
        return Ok(());
    }
    Err(MeshError::Count { section: scan.section_name(), what, announced, held })
}
