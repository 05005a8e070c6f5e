//! Construction of a mesh from the data of a file.

use super::sides::UNUSED;
use super::{Options, RawBlock, RawMesh, RawNode};
use crate::element::ElementKind;
use crate::mesh::boundary::single;
use crate::mesh::check::{self, Sense};
use crate::mesh::error::{Holder, MeshError, Part};
use crate::mesh::{Cells, Mesh, OmittedElements, face_nodes};
use std::collections::BTreeMap;

/// Largest distance from the plane z = 0 over the extent of the mesh \[-\] that counts as rounding by the program that wrote
/// it.
const PLANE: f64 = 1e-12;

/// Node numbers in ascending order, each with its position in the file.
struct Index(Vec<(u64, usize)>);

impl Index {
    fn new(nodes: &[RawNode]) -> Result<Self, MeshError> {
        let mut index: Vec<(u64, usize)> = nodes.iter().enumerate().map(|(n, node)| (node.tag, n)).collect();
        index.sort_unstable();
        match index.windows(2).find(|w| w[0].0 == w[1].0) {
            Some(w) => Err(MeshError::DuplicateNode { node: w[0].0 }),
            None => Ok(Self(index)),
        }
    }

    fn get(&self, tag: u64) -> Option<usize> {
        self.0.binary_search_by_key(&tag, |e| e.0).ok().map(|at| self.0[at].1)
    }
}

/// An element of the file: block and index in the block.
type Member = (usize, usize);

/// The cells of each block of the mesh: groups in the file, kind, elements.
type Members = BTreeMap<(Vec<usize>, ElementKind), Vec<Member>>;

impl RawMesh {
    /// Builds and checks the mesh, in metres.
    ///
    /// There is one block for each kind of cell and each combination of groups of cells, so that a block lies in a group as a
    /// whole. Cells in no group form blocks in no set. Elements one dimension lower make the `side_sets`: a face between two
    /// cells belongs to both, and both its sides are in the set. Elements of still lower dimension and sets of nodes make the
    /// `node_sets`. The same name on several dimensions therefore remains separate. Nodes that no cell uses are removed; the
    /// others keep their order. Plane entities that are clockwise throughout are reversed.
    ///
    /// # Errors
    /// See [`MeshError`], for elements, nodes, groups and parts.
    pub fn into_mesh<const D: usize>(self, options: &Options) -> Result<Mesh<D>, MeshError> {
        let origins = self.origins.clone();
        self.build(options).map_err(|error| match &origins[..] {
            [] => error,
            _ => MeshError::Numbered { error: Box::new(error), origins },
        })
    }

    fn build<const D: usize>(self, options: &Options) -> Result<Mesh<D>, MeshError> {
        options.check()?;
        let index = Index::new(&self.nodes)?;
        self.check_coordinates()?;
        let mut connectivity = self.resolve(&index)?;
        self.check_dimension::<D>()?;
        let names = self.group_names(options)?;
        for unread in &self.unread {
            unread.check(self.dimension(), &names, options)?;
        }
        self.orient::<D>(&mut connectivity, &self.asked(options, &names))?;
        let members = self.members::<D>(&connectivity)?;
        let (mut mesh, of_mesh) = self.cells::<D>(&members, &connectivity, options.length_unit);
        for nodes in connectivity.iter_mut().flatten() {
            *nodes = of_mesh[*nodes];
        }
        let tags: Vec<Vec<u64>> =
            members.values().map(|m| m.iter().map(|&(b, e)| self.blocks[b].tags[e]).collect()).collect();
        let number = |tag: u64| index.get(tag).map_or(UNUSED, |n| of_mesh[n]);
        for (block, (groups, _)) in members.keys().enumerate() {
            for name in groups.iter().flat_map(|&g| &names[g]) {
                mesh.cell_sets.entry(name.clone()).or_default().push(block);
            }
        }
        mesh.cell_sets.values_mut().for_each(Vec::dedup);
        (mesh.side_sets, mesh.left_out) =
            self.side_sets(&mesh, &connectivity, number, &tags, &names, options)?;
        self.node_sets((&index, &of_mesh), &connectivity, &names, (&mut mesh, options))?;
        for (alias, name) in &self.aliases {
            copy(&mut mesh.cell_sets, name, alias);
            copy(&mut mesh.side_sets, name, alias);
            copy(&mut mesh.node_sets, name, alias);
        }
        self.check_groups(&mesh, options)?;
        for unread in &self.unread {
            unread.leave_out(&mut mesh, &names);
        }
        if !options.allow_free_parts {
            check_parts(&mesh, &tags, options)?;
        }
        Ok(mesh)
    }

    /// True for each block of the file that is asked for.
    fn asked(&self, options: &Options, names: &[Vec<String>]) -> Vec<bool> {
        let is = |name: &String| {
            let asked = |asked: &String| asked == name || self.aliases.get(asked) == Some(name);
            options.only.iter().flatten().any(asked)
        };
        let block = |block: &RawBlock| block.groups.iter().any(|&g| names[g].iter().any(is));
        self.blocks.iter().map(|b| options.only.is_none() || block(b)).collect()
    }

    fn check_coordinates(&self) -> Result<(), MeshError> {
        for node in &self.nodes {
            if let Some(axis) = node.x.iter().position(|c| !c.is_finite()) {
                return Err(MeshError::Coordinate { node: node.tag, axis, value: node.x[axis] });
            }
        }
        Ok(())
    }

    /// Connectivity by positions of nodes in the file instead of their numbers.
    fn resolve(&self, index: &Index) -> Result<Vec<Vec<usize>>, MeshError> {
        let resolve = |block: &RawBlock| {
            let n = block.shape.nodes();
            let place = |(k, &node): (usize, &u64)| {
                let holder = || Holder::Element(block.tags[k / n]);
                index.get(node).ok_or_else(|| MeshError::DanglingNode { holder: holder(), node })
            };
            block.nodes.iter().enumerate().map(place).collect()
        };
        self.blocks.iter().map(resolve).collect()
    }

    fn check_dimension<const D: usize>(&self) -> Result<(), MeshError> {
        let found = self.dimension();
        if self.blocks.iter().all(|b| b.tags.is_empty()) {
            return Err(self.unread.iter().max_by_key(|unread| unread.dimension).map_or(
                MeshError::NoElements,
                |unread| MeshError::UnsupportedKind {
                    section: unread.section.clone(),
                    place: unread.place,
                    kind: unread.kind.clone(),
                },
            ));
        }
        if found != D {
            return Err(MeshError::Dimension { found, wanted: D });
        }
        let extent = |axis: usize| {
            let of = |f: fn(f64, f64) -> f64, from| self.nodes.iter().map(|n| n.x[axis]).fold(from, f);
            of(f64::max, f64::NEG_INFINITY) - of(f64::min, f64::INFINITY)
        };
        let tolerance = PLANE * extent(0).max(extent(1));
        match self.nodes.iter().find(|n| D == 2 && n.x[2].abs() > tolerance) {
            Some(n) => Err(MeshError::OffPlane { node: n.tag, z: n.x[2] }),
            None => Ok(()),
        }
    }

    /// Reverses plane entities that are clockwise throughout, and refuses elements that are inverted, folded or flat.
    fn orient<const D: usize>(
        &self,
        connectivity: &mut [Vec<usize>],
        asked: &[bool],
    ) -> Result<(), MeshError> {
        let mut senses: BTreeMap<ElementKind, Sense> = BTreeMap::new();
        let mut wrong: Vec<(usize, usize, f64)> = Vec::new();
        for (b, block) in self.blocks.iter().enumerate().filter(|(_, b)| b.shape.dimension() == D) {
            let Some(kind) = block.shape.element().filter(|_| asked[b]) else {
                continue;
            };
            let sense = senses.entry(kind).or_insert_with(|| check::sense(kind, block.shape.corners()));
            for (e, nodes) in connectivity[b].chunks_exact(kind.nodes()).enumerate() {
                let least = check::least(sense, &self.positions::<D>(nodes));
                if least <= 0.0 {
                    wrong.push((b, e, least));
                }
            }
        }
        if wrong.is_empty() {
            return Ok(());
        }
        let turned = self.turn_entities::<D>(connectivity, &senses, &wrong);
        wrong.retain(|(b, ..)| self.blocks[*b].entity.is_none_or(|e| !turned.contains(&e)));
        let Some(&(b, e, least)) = wrong.iter().min_by_key(|(b, e, _)| self.blocks[*b].tags[*e]) else {
            return Ok(());
        };
        let block = &self.blocks[b];
        Err(MeshError::Inverted {
            element: block.tags[e],
            kind: block.shape.name(),
            least,
            count: wrong.len(),
        })
    }

    /// Reverses the entities with wrong elements whose elements are all valid afterwards.
    fn turn_entities<const D: usize>(
        &self,
        connectivity: &mut [Vec<usize>],
        senses: &BTreeMap<ElementKind, Sense>,
        wrong: &[(usize, usize, f64)],
    ) -> Vec<i64> {
        let mut entities: Vec<i64> = wrong.iter().filter_map(|(b, ..)| self.blocks[*b].entity).collect();
        entities.sort_unstable();
        entities.dedup();
        entities.retain(|&entity| {
            let blocks: Vec<usize> = (0..self.blocks.len())
                .filter(|&b| self.blocks[b].entity == Some(entity) && self.blocks[b].shape.dimension() == D)
                .collect();
            let turns = D == 2
                && blocks.iter().all(|&b| {
                    let shape = self.blocks[b].shape;
                    let Some(sense) = shape.element().and_then(|k| senses.get(&k)) else {
                        return false;
                    };
                    connectivity[b].chunks_exact(shape.nodes()).all(|nodes| {
                        let nodes: Vec<usize> = shape.reversed().iter().map(|&a| nodes[a]).collect();
                        check::least(sense, &self.positions::<D>(&nodes)) > 0.0
                    })
                });
            if turns {
                for b in blocks {
                    let shape = self.blocks[b].shape;
                    for nodes in connectivity[b].chunks_exact_mut(shape.nodes()) {
                        let old = nodes.to_vec();
                        nodes.iter_mut().zip(shape.reversed()).for_each(|(n, &a)| *n = old[a]);
                    }
                }
            }
            turns
        });
        entities
    }

    fn positions<const D: usize>(&self, nodes: &[usize]) -> Vec<[f64; D]> {
        nodes.iter().map(|&n| std::array::from_fn(|c| self.nodes[n].x[c])).collect()
    }

    /// The elements that form cells, by groups and kind.
    fn members<const D: usize>(&self, connectivity: &[Vec<usize>]) -> Result<Members, MeshError> {
        let repeats = if self.repeats { self.repeated::<D>(connectivity) } else { BTreeMap::new() };
        let mut members = Members::new();
        for (b, block) in self.blocks.iter().enumerate() {
            let Some(&first) = block.tags.first().filter(|_| block.shape.dimension() == D) else {
                continue;
            };
            let kind = block
                .shape
                .element()
                .ok_or(MeshError::NoElement { element: first, kind: block.shape.name() })?;
            let once = (0..block.tags.len()).map(|e| (b, e)).filter(|m| !repeats.contains_key(m));
            members.entry((block.groups.clone(), kind)).or_default().extend(once);
            for (&m, groups) in repeats.range((b, 0)..(b + 1, 0)) {
                if let Some(groups) = groups {
                    members.entry((groups.clone(), kind)).or_default().push(m);
                }
            }
        }
        members.retain(|_, list| !list.is_empty());
        Ok(members)
    }

    /// Cells that are written several times: the first with the groups of all, the others with `None`.
    fn repeated<const D: usize>(&self, connectivity: &[Vec<usize>]) -> BTreeMap<Member, Option<Vec<usize>>> {
        let nodes = |&(b, e): &Member| {
            let n = self.blocks[b].shape.nodes();
            &connectivity[b][e * n..(e + 1) * n]
        };
        let mut all: Vec<Member> = (0..self.blocks.len())
            .filter(|&b| self.blocks[b].shape.dimension() == D)
            .flat_map(|b| (0..self.blocks[b].tags.len()).map(move |e| (b, e)))
            .collect();
        all.sort_unstable_by(|a, b| nodes(a).cmp(nodes(b)).then(a.cmp(b)));
        let mut repeated = BTreeMap::new();
        for same in all.chunk_by(|a, b| nodes(a) == nodes(b)).filter(|same| same.len() > 1) {
            let mut groups: Vec<usize> =
                same.iter().flat_map(|m| self.blocks[m.0].groups.iter().copied()).collect();
            groups.sort_unstable();
            groups.dedup();
            repeated.insert(same[0], Some(groups));
            repeated.extend(same[1..].iter().map(|&m| (m, None)));
        }
        repeated
    }

    /// Nodes and blocks, and the number in the mesh of each node of the file.
    fn cells<const D: usize>(
        &self,
        members: &Members,
        connectivity: &[Vec<usize>],
        unit: f64,
    ) -> (Mesh<D>, Vec<usize>) {
        let nodes = |&(b, e): &Member| {
            let n = self.blocks[b].shape.nodes();
            connectivity[b][e * n..(e + 1) * n].iter().copied()
        };
        let mut of_mesh = vec![UNUSED; self.nodes.len()];
        members.values().flatten().flat_map(nodes).for_each(|n| of_mesh[n] = 0);
        let mut mesh = Mesh::default();
        for (node, number) in self.nodes.iter().zip(&mut of_mesh).filter(|(_, number)| **number == 0) {
            *number = mesh.nodes.len();
            mesh.nodes.push(std::array::from_fn(|c| unit * node.x[c]));
        }
        for ((_, kind), list) in members {
            let connectivity = list.iter().flat_map(nodes).map(|n| of_mesh[n]).collect();
            mesh.blocks.push(Cells { kind: *kind, connectivity });
        }
        (mesh, of_mesh)
    }

    /// Sets of nodes, and the nodes of elements more than one dimension lower than the cells.
    fn node_sets<const D: usize>(
        &self,
        (index, of_mesh): (&Index, &[usize]),
        connectivity: &[Vec<usize>],
        names: &[Vec<String>],
        (mesh, options): (&mut Mesh<D>, &Options),
    ) -> Result<(), MeshError> {
        let mut sets: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (block, connectivity) in
            self.blocks.iter().zip(connectivity).filter(|(b, _)| b.shape.dimension() + 1 < D)
        {
            let elements = || connectivity.chunks_exact(block.shape.nodes());
            let lost = |nodes: &[usize]| nodes.contains(&UNUSED);
            let count = elements().filter(|nodes| lost(nodes)).count();
            let first = elements().zip(&block.tags).filter(|(nodes, _)| lost(nodes)).map(|(_, tag)| *tag);
            for (name, element) in
                block.groups.iter().flat_map(|&g| &names[g]).zip(std::iter::repeat(first.min()))
            {
                if let Some(element) = element {
                    if !options.leave_out {
                        return Err(MeshError::Orphan { group: name.clone(), element, count });
                    }
                    let kind = block.shape.name().to_string();
                    mesh.left_out.insert(name.clone(), OmittedElements { kind, count, element, read: true });
                }
                let set = sets.entry(name.clone()).or_default();
                set.extend(elements().filter(|nodes| !lost(nodes)).flatten());
            }
        }
        for (name, tags) in &self.node_sets {
            let set = sets.entry(name.clone()).or_default();
            for &node in tags {
                let holder = || Holder::Set(name.clone());
                let at = index.get(node).ok_or_else(|| MeshError::DanglingNode { holder: holder(), node })?;
                set.extend(Some(of_mesh[at]).filter(|&n| n != UNUSED));
            }
        }
        sets.retain(|_, set| {
            set.sort_unstable();
            set.dedup();
            !set.is_empty()
        });
        mesh.node_sets = sets;
        Ok(())
    }

    fn check_groups<const D: usize>(&self, mesh: &Mesh<D>, options: &Options) -> Result<(), MeshError> {
        let present = self.present();
        if present.is_empty() {
            let cells = mesh.blocks.iter().map(Cells::len).sum();
            return Err(MeshError::NoGroups { cells, wanted: options.required.clone() });
        }
        let known = |name: &String| {
            mesh.cell_sets.contains_key(name)
                || mesh.side_sets.contains_key(name)
                || mesh.node_sets.contains_key(name)
        };
        match options.required.iter().find(|name| !known(name)) {
            Some(name) => Err(MeshError::MissingGroup { name: name.clone(), present }),
            None => Ok(()),
        }
    }
}

/// Gives a set a further name, unless another has it.
fn copy<T: Clone>(sets: &mut BTreeMap<String, T>, name: &str, alias: &str) {
    if let (Some(set), false) = (sets.get(name).cloned(), sets.contains_key(alias)) {
        sets.insert(alias.to_string(), set);
    }
}

/// Refuses parts of the cells that are asked for that hang free, and nodes that hang.
fn check_parts<const D: usize>(
    mesh: &Mesh<D>,
    tags: &[Vec<u64>],
    options: &Options,
) -> Result<(), MeshError> {
    if let Some(only) = &options.only {
        let mut blocks: Vec<usize> =
            only.iter().filter_map(|name| mesh.cell_sets.get(name)).flatten().copied().collect();
        blocks.sort_unstable();
        blocks.dedup();
        if blocks.len() < mesh.blocks.len() {
            let tags: Vec<Vec<u64>> = blocks.iter().map(|&b| tags[b].clone()).collect();
            return free_parts(&mesh.part(&blocks), &tags);
        }
    }
    free_parts(mesh, tags)
}

fn free_parts<const D: usize>(mesh: &Mesh<D>, tags: &[Vec<u64>]) -> Result<(), MeshError> {
    let boundary = single(mesh).map_err(|sides| {
        let mut elements = sides.map(|side| tags[side.block][side.cell]);
        elements.sort_unstable();
        let at = mesh.nodes[face_nodes(mesh, &sides[0])[0]].to_vec();
        MeshError::Overlapping { elements, at }
    })?;
    let parts = check::Parts::new(mesh);
    if let Some(check::Hanging { at, cell: (block, cell), count }) = check::hanging(mesh, &parts, &boundary) {
        return Err(MeshError::HangingNodes { at: at.to_vec(), element: tags[block][cell], count });
    }
    let Some(touch) = check::free_part(mesh, &parts, &boundary) else {
        return Ok(());
    };
    let part = |extent: check::Extent| {
        let within = |blocks: &Vec<usize>| blocks.iter().any(|b| extent.blocks.contains(b));
        let groups = mesh.cell_sets.iter().filter(|(_, b)| within(b)).map(|(name, _)| name.clone()).collect();
        Part { groups, cells: extent.cells, element: tags[extent.first.0][extent.first.1] }
    };
    Err(MeshError::FreePart { free: part(touch.free), other: part(touch.other), pairs: touch.pairs })
}
