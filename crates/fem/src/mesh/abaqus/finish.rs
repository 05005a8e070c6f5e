//! The data of a file as groups, faces and sets of nodes.

use super::lines::Keyword;
use super::numbers::Instances;
use super::scope::{Element, ElementOrSet, NodesOf, Scope, SurfaceLine, UnreadElements};
use super::sets::Name;
use super::shapes;
use crate::mesh::error::{MeshError, Place};
use crate::mesh::raw::{self, RawBlock, RawGroup, RawMesh, RawSide, Shape};
use std::collections::{BTreeMap, BTreeSet};

/// Makes the data of a mesh. `last` is the last keyword, for errors.
///
/// # Errors
/// Elements and sets that do not exist, and elements that are defined twice.
pub(super) fn mesh(mut file: Scope, instances: &Instances, last: &Keyword) -> Result<RawMesh, MeshError> {
    if file.nodes.is_empty() {
        return Err(MeshError::MissingSection { section: "*NODE" });
    }
    let index = ElementIndex::new(&file)?;
    // A set that serves a surface alone would only divide the cells further.
    let served: BTreeSet<String> = file
        .surfaces
        .iter()
        .filter_map(|line| match &line.of {
            ElementOrSet::Set(set) => Some(set.to_uppercase()),
            ElementOrSet::Element(_) => None,
        })
        .collect();
    let surfaces = surfaces(&mut file, &index)?;
    file.element_sets.hide(&served);
    let (groups, memberships, unread) = groups(&mut file, &index, instances, last)?;
    let node_sets = node_sets(&mut file, &index, last)?;
    let mut aliases = BTreeMap::new();
    let surfaces = named(surfaces.into_iter().collect(), &mut aliases);
    let node_sets = named(node_sets, &mut aliases);
    let groups = alone(groups, &mut aliases);
    let blocks = blocks(&file, memberships);
    let mesh = RawMesh {
        nodes: file.nodes,
        blocks,
        groups,
        surfaces,
        node_sets,
        repeats: false,
        ..RawMesh::default()
    };
    Ok(numbered(RawMesh { unread, aliases, ..mesh }, instances))
}

/// Elements by their numbers.
struct ElementIndex {
    /// Numbers, ascending, each with its position.
    order: Vec<(u64, usize)>,
    /// Numbers of all elements, also of those that are not read, ascending.
    tags: Vec<u64>,
    /// Numbers of elements that are not read, ascending, each with the position of its type.
    unread: Vec<(u64, usize)>,
}

impl ElementIndex {
    fn new(file: &Scope) -> Result<Self, MeshError> {
        let mut order: Vec<(u64, usize)> =
            file.elements.iter().enumerate().map(|(e, x)| (x.tag, e)).collect();
        order.sort_unstable();
        if let Some(w) = order.windows(2).find(|w| w[0].0 == w[1].0) {
            return Err(MeshError::DuplicateElement { element: super::numbers::local(w[0].0) });
        }
        let types = file.unread.iter().enumerate();
        let mut unread: Vec<(u64, usize)> =
            types.flat_map(|(k, unread)| unread.tags.iter().map(move |&tag| (tag, k))).collect();
        unread.sort_unstable();
        let mut tags: Vec<u64> = order.iter().map(|o| o.0).collect();
        if !unread.is_empty() {
            tags.extend(unread.iter().map(|u| u.0));
            tags.sort_unstable();
            tags.dedup();
        }
        Ok(Self { order, tags, unread })
    }

    /// Position of an element that a set names; the type of one that is not read otherwise.
    fn position(&self, element: u64, set: &str) -> Result<Result<usize, usize>, MeshError> {
        let at = |list: &[(u64, usize)]| {
            list.binary_search_by_key(&element, |o| o.0).ok().map(|index| list[index].1)
        };
        match (at(&self.order), at(&self.unread)) {
            (Some(index), _) => Ok(Ok(index)),
            (None, Some(kind)) => Ok(Err(kind)),
            (None, None) => {
                let element = super::numbers::local(element);
                Err(MeshError::DanglingElement { set: set.to_string(), element })
            }
        }
    }
}

/// Faces of all surfaces.
fn surfaces(file: &mut Scope, index: &ElementIndex) -> Result<BTreeMap<Name, Vec<RawSide>>, MeshError> {
    let mut surfaces: BTreeMap<Name, Vec<RawSide>> = BTreeMap::new();
    for SurfaceLine { name, of, face, line, keyword } in std::mem::take(&mut file.surfaces) {
        let elements = match of {
            ElementOrSet::Element(element) => vec![element],
            ElementOrSet::Set(set) => {
                let numbers = file.element_sets.numbers(&set, &index.tags, &keyword)?;
                numbers.ok_or_else(|| file.element_sets.unknown(&set, line, &keyword))?
            }
        };
        let set = name.own.clone();
        let sides = surfaces.entry(name).or_default();
        // Sides of shells and beams are no faces of cells.
        let Some(face) = face else { continue };
        for element in elements {
            let Ok(at) = index.position(element, &set)? else { continue };
            let Some(local) = shapes::faces(file.elements[at].shape).get(face - 1) else {
                let text = format!("S{face} of element {}", super::numbers::local(element));
                return Err(keyword.syntax(line, "a face that the element has", &text));
            };
            let nodes = file.nodes_of(at);
            sides.push(RawSide { element, corners: local.iter().map(|&a| nodes[a]).collect() });
        }
    }
    Ok(surfaces)
}

/// Sets of nodes.
fn node_sets(
    file: &mut Scope,
    index: &ElementIndex,
    last: &Keyword,
) -> Result<Vec<(Name, Vec<u64>)>, MeshError> {
    let mut known: Vec<u64> = file.nodes.iter().map(|n| n.tag).collect();
    known.sort_unstable();
    let mut sets = Vec::new();
    for name in file.node_sets.names() {
        if let Some(numbers) = file.node_sets.numbers(&name.full(), &known, last)? {
            sets.push((name, numbers));
        }
    }
    for NodesOf { name, set, keyword } in std::mem::take(&mut file.nodes_of) {
        let numbers = file.element_sets.numbers(&set, &index.tags, &keyword)?;
        let numbers = numbers.ok_or_else(|| file.element_sets.unknown(&set, keyword.line, &keyword))?;
        let mut nodes = Vec::new();
        for element in numbers {
            if let Ok(at) = index.position(element, &set)? {
                nodes.extend_from_slice(file.nodes_of(at));
            }
        }
        sets.push((name, nodes));
    }
    Ok(sets)
}

/// Groups by name and dimension, the groups of each element, and the elements that are not read.
#[allow(clippy::type_complexity)]
fn groups(
    file: &mut Scope,
    index: &ElementIndex,
    instances: &Instances,
    last: &Keyword,
) -> Result<(Vec<(Name, RawGroup)>, Vec<Vec<usize>>, Vec<raw::UnreadElements>), MeshError> {
    let mut groups: Vec<(Name, RawGroup)> = Vec::new();
    let mut memberships = vec![Vec::new(); file.elements.len()];
    let mut unread: Vec<raw::UnreadElements> = file.unread.iter().map(raw_unread).collect();
    let mut taken = BTreeSet::new();
    let mut member = |name: &Name, elements: Vec<u64>, groups: &mut Vec<(Name, RawGroup)>| {
        let mut of_dimension = [None; 4];
        for element in elements {
            let at = match index.position(element, &name.own)? {
                Ok(at) => at,
                Err(kind) => {
                    let sets = &mut unread[kind].groups;
                    sets.entry(name.full()).or_default().push(element);
                    continue;
                }
            };
            let dimension = file.elements[at].shape.dimension();
            let group = *of_dimension[dimension].get_or_insert_with(|| {
                groups.push((name.clone(), RawGroup { dimension, tag: None, name: None }));
                groups.len() - 1
            });
            memberships[at].push(group);
        }
        Ok::<(), MeshError>(())
    };
    let names = file.element_sets.names();
    taken.extend(names.iter().map(|name| name.full().to_uppercase()));
    // The cells of an instance come first: sets of parts divide them.
    for (k, instance) in
        (1u64..).zip(&instances.names).filter(|(_, name)| !taken.contains(&name.to_uppercase()))
    {
        let from = index.tags.partition_point(|&tag| super::numbers::instance(tag) < k);
        let own = index.tags[from..].iter().copied();
        let own = own.take_while(|&tag| super::numbers::instance(tag) == k).collect();
        member(&Name { own: instance.clone(), instance: None }, own, &mut groups)?;
    }
    for name in names {
        let numbers = file.element_sets.numbers(&name.full(), &index.tags, last)?;
        member(&name, numbers.unwrap_or_default(), &mut groups)?;
    }
    Ok((groups, memberships, unread))
}

/// Elements of a type that is not read, before their sets are known.
fn raw_unread(unread: &UnreadElements) -> raw::UnreadElements {
    raw::UnreadElements {
        kind: unread.kind.clone(),
        dimension: shapes::dimension(&unread.kind),
        section: unread.keyword.name.clone(),
        place: Place::Line(unread.keyword.line),
        count: unread.tags.len(),
        first: unread.tags.iter().copied().min().unwrap_or(0),
        groups: BTreeMap::new(),
        numbered: Vec::new(),
    }
}

/// Elements of the same shape in the same groups.
fn blocks(file: &Scope, memberships: Vec<Vec<usize>>) -> Vec<RawBlock> {
    let mut blocks: BTreeMap<(Shape, Vec<usize>), RawBlock> = BTreeMap::new();
    for (e, groups) in memberships.into_iter().enumerate() {
        let Element { tag, shape, .. } = file.elements[e];
        let block = blocks.entry((shape, groups.clone())).or_insert_with(|| RawBlock {
            shape,
            groups,
            entity: None,
            tags: Vec::new(),
            nodes: Vec::new(),
        });
        block.tags.push(tag);
        block.nodes.extend(file.nodes_of(e));
    }
    blocks.into_values().collect()
}

/// Names that only one set has, whatever its instance.
fn unique<'a>(names: impl Iterator<Item = &'a Name>) -> BTreeSet<String> {
    let mut holders: BTreeMap<String, BTreeSet<Option<&str>>> = BTreeMap::new();
    for name in names {
        holders.entry(name.own.to_uppercase()).or_default().insert(name.instance.as_deref());
    }
    holders.into_iter().filter(|(_, holders)| holders.len() == 1).map(|(name, _)| name).collect()
}

/// The name of a set: its own if only one has it, with its full name as another; else the full one.
fn name_of(name: &Name, unique: &BTreeSet<String>, aliases: &mut BTreeMap<String, String>) -> String {
    if !unique.contains(&name.own.to_uppercase()) {
        return name.full();
    }
    if name.instance.is_some() {
        aliases.insert(name.full(), name.own.clone());
    }
    name.own.clone()
}

fn named<T>(sets: Vec<(Name, Vec<T>)>, aliases: &mut BTreeMap<String, String>) -> BTreeMap<String, Vec<T>> {
    let unique = unique(sets.iter().map(|(name, _)| name));
    let mut all: BTreeMap<String, Vec<T>> = BTreeMap::new();
    for (name, set) in sets {
        all.entry(name_of(&name, &unique, aliases)).or_default().extend(set);
    }
    all
}

fn alone(groups: Vec<(Name, RawGroup)>, aliases: &mut BTreeMap<String, String>) -> Vec<RawGroup> {
    let unique = unique(groups.iter().map(|(name, _)| name));
    let of =
        |(name, group): (Name, RawGroup)| RawGroup { name: Some(name_of(&name, &unique, aliases)), ..group };
    groups.into_iter().map(of).collect()
}

/// The same mesh with numbers that tell instances apart.
fn numbered(mut mesh: RawMesh, instances: &Instances) -> RawMesh {
    if instances.names.is_empty() {
        return mesh;
    }
    let elements = || mesh.blocks.iter().flat_map(|b| &b.tags);
    let all = || elements().copied().chain(mesh.nodes.iter().map(|n| n.tag));
    let largest = all().map(super::numbers::local).max().unwrap_or(0);
    let beside = all().any(|tag| super::numbers::instance(tag) == 0);
    let (new, origins) = instances.decimal(largest, beside);
    let renumber = |tag: &mut u64| *tag = new(*tag);
    mesh.nodes.iter_mut().for_each(|n| renumber(&mut n.tag));
    for block in &mut mesh.blocks {
        block.tags.iter_mut().chain(&mut block.nodes).for_each(renumber);
    }
    for side in mesh.surfaces.values_mut().flatten() {
        renumber(&mut side.element);
        side.corners.iter_mut().for_each(renumber);
    }
    mesh.node_sets.values_mut().flatten().for_each(renumber);
    // Of what is left out, messages give the numbers in the file.
    for unread in &mut mesh.unread {
        let all = std::iter::once(&mut unread.first).chain(unread.groups.values_mut().flatten());
        all.for_each(|tag| *tag = super::numbers::local(*tag));
    }
    mesh.origins = origins;
    mesh
}
