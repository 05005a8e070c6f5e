//! Version 2.2: one list of nodes and one of elements; each element has the number of one physical group, and is listed once
//! for each of its groups.

use super::kinds::{self, Kind, Places};
use super::scan::{Coding, Scan};
use crate::mesh::error::MeshError;
use crate::mesh::raw::{RawBlock, RawGroup, RawMesh, RawNode};
use std::collections::{BTreeMap, BTreeSet};

/// Type, physical group (0 for none), geometric entity (0 for none).
type Key = (Kind, i64, i64);

/// Numbers and nodes of elements.
#[derive(Default)]
struct Elements {
    tags: Vec<u64>,
    nodes: Vec<u64>,
}

/// Data read so far.
#[derive(Default)]
pub(super) struct Reader {
    nodes: Option<Vec<RawNode>>,
    elements: Option<BTreeMap<Key, Elements>>,
    places: Places,
}

impl Reader {
    pub(super) fn section(&mut self, scan: &mut Scan<'_>, section: &str) -> Result<bool, MeshError> {
        match section {
            "$Nodes" => self.nodes(scan, false)?,
            "$ParametricNodes" => self.nodes(scan, true)?,
            "$Elements" => self.elements(scan)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn nodes(&mut self, scan: &mut Scan<'_>, parametric: bool) -> Result<(), MeshError> {
        scan.once(self.nodes.is_some())?;
        let count = counted(scan, "nodes", 4, 28)?;
        let mut nodes = Vec::with_capacity(count);
        for _ in 0..count {
            let tag = number(scan, "the number of a node")?;
            nodes.push(RawNode { tag, x: scan.coordinates()? });
            if parametric {
                let dimension = scan.dimension()?;
                scan.int("the number of an entity")?;
                for _ in 0..if dimension < 3 { dimension } else { 0 } {
                    scan.real("parametric coordinate")?;
                }
            }
        }
        self.nodes = Some(nodes);
        Ok(())
    }

    fn elements(&mut self, scan: &mut Scan<'_>) -> Result<(), MeshError> {
        scan.once(self.elements.is_some())?;
        let text = scan.coding == Coding::Ascii;
        let count = counted(scan, "elements", 4, 8)?;
        let mut elements = BTreeMap::new();
        let mut read = 0;
        while read < count {
            if text {
                let tag = number(scan, "the number of an element")?;
                let kind = kind(scan, Some(tag), &mut self.places)?;
                let tags = scan.count("tags of an element", 1, 4)?;
                element(scan, kind, tag, tags, &mut elements)?;
                read += 1;
            } else {
                read += binary_run(scan, count - read, (&mut elements, &mut self.places))?;
            }
        }
        self.elements = Some(elements);
        Ok(())
    }

    pub(super) fn finish(self) -> Result<RawMesh, MeshError> {
        let nodes = self.nodes.ok_or(MeshError::MissingSection { section: "$Nodes" })?;
        let elements = self.elements.ok_or(MeshError::MissingSection { section: "$Elements" })?;
        let all: BTreeSet<(usize, i64)> = elements
            .keys()
            .filter(|(_, physical, _)| *physical != 0)
            .map(|&(kind, physical, _)| (kind.dimension(), physical))
            .collect();
        let all: Vec<(usize, i64)> = all.into_iter().collect();
        let groups =
            all.iter().map(|&(dimension, tag)| RawGroup { dimension, tag: Some(tag), name: None }).collect();
        let mut mesh = RawMesh { nodes, groups, repeats: true, ..RawMesh::default() };
        for ((kind, physical, entity), Elements { tags, nodes }) in elements {
            let groups = all.binary_search(&(kind.dimension(), physical)).into_iter().collect();
            match kind {
                Kind::Read(shape) => {
                    mesh.blocks.push(RawBlock { shape, groups, entity: Some(entity), tags, nodes });
                }
                Kind::Unread(other) => mesh.unread.extend(self.places.unread(other, &tags, groups)),
            }
        }
        Ok(mesh)
    }
}

/// A count on a line of text, even in a binary file, where binary data follow it.
fn counted(scan: &mut Scan<'_>, what: &'static str, words: usize, bytes: usize) -> Result<usize, MeshError> {
    let count = scan.decimal(what)?;
    let count = u64::try_from(count).map_err(|_| scan.unexpected("a count"))?;
    if scan.coding != Coding::Ascii {
        scan.end_line()?;
    }
    scan.bounded(count, what, words, bytes)
}

/// A positive node or element number.
fn number(scan: &mut Scan<'_>, what: &'static str) -> Result<u64, MeshError> {
    let number = scan.int(what)?;
    u64::try_from(number).map_err(|_| scan.unexpected("a number that is not negative"))
}

/// A known element type.
fn kind(scan: &mut Scan<'_>, element: Option<u64>, places: &mut Places) -> Result<Kind, MeshError> {
    let at = scan.position();
    let number_of_kind = scan.int("a type of element")?;
    if let Some(kind) = Kind::from_number(number_of_kind) {
        places.note(scan, at, kind);
        return Ok(kind);
    }
    let element = match element {
        Some(tag) => tag,
        None => {
            // The numbers of elements and of their tags precede the first element.
            scan.int("elements")?;
            scan.int("tags of an element")?;
            number(scan, "the number of an element")?
        }
    };
    Err(kinds::unknown(scan, at, element, number_of_kind))
}

/// Binary elements of one type: a header for all, then the elements.
fn binary_run(
    scan: &mut Scan<'_>,
    left: usize,
    (elements, places): (&mut BTreeMap<Key, Elements>, &mut Places),
) -> Result<usize, MeshError> {
    let kind = kind(scan, None, places)?;
    let count = number(scan, "elements")?;
    let tags = number(scan, "tags of an element")?;
    let tags = scan.bounded(tags, "tags of an element", 1, 4)?;
    let count = scan.bounded(count, "elements", 1, 4 * (1 + tags + kind.nodes()))?;
    if count == 0 || count > left {
        return Err(MeshError::Count {
            section: scan.section_name(),
            what: "elements",
            announced: left as u64,
            held: count as u64,
        });
    }
    for _ in 0..count {
        let tag = number(scan, "the number of an element")?;
        element(scan, kind, tag, tags, elements)?;
    }
    Ok(count)
}

/// Tags and nodes of an element. The first tag is the physical group, the second the entity; partitions follow.
fn element(
    scan: &mut Scan<'_>,
    kind: Kind,
    tag: u64,
    tags: usize,
    elements: &mut BTreeMap<Key, Elements>,
) -> Result<(), MeshError> {
    let (mut physical, mut entity) = (0, 0);
    for k in 0..tags {
        let value = scan.int("a tag of an element")?;
        match k {
            0 => physical = value.saturating_abs(),
            1 => entity = value,
            _ => {}
        }
    }
    let list = elements.entry((kind, physical, entity)).or_default();
    list.tags.push(tag);
    let first = list.nodes.len();
    for _ in 0..kind.nodes() {
        list.nodes.push(number(scan, "the number of a node")?);
    }
    kind.reorder(&mut list.nodes[first..]);
    Ok(())
}
