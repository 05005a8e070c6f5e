//! Entities of one level of a file: the file itself with its assembly, a part, or an instance.

use super::lines::Keyword;
use super::numbers;
use super::placement::Placement;
use super::sets::{Name, Sets};
use crate::mesh::MeshError;
use crate::mesh::raw::{RawNode, Shape};
use std::rc::Rc;

/// An element: its nodes begin at `first` in the connectivity.
#[derive(Clone, Copy)]
pub(super) struct Element {
    pub tag: u64,
    pub shape: Shape,
    pub first: usize,
}

/// Elements of a type that is not read.
#[derive(Clone)]
pub(super) struct UnreadElements {
    /// Type.
    pub kind: String,
    pub keyword: Rc<Keyword>,
    pub tags: Vec<u64>,
}

/// An element, or a set of elements.
#[derive(Clone)]
pub(super) enum ElementOrSet {
    Element(u64),
    Set(String),
}

/// A data line of a surface: a face of an element or of the elements of a set; `None` if it has no face that is read.
#[derive(Clone)]
pub(super) struct SurfaceLine {
    pub name: Name,
    pub of: ElementOrSet,
    pub face: Option<usize>,
    pub line: usize,
    pub keyword: Rc<Keyword>,
}

/// A set of the nodes of the elements of a set.
#[derive(Clone)]
pub(super) struct NodesOf {
    pub name: Name,
    pub set: String,
    pub keyword: Rc<Keyword>,
}

/// Content of one level of a file.
#[derive(Clone)]
pub(super) struct Scope {
    pub nodes: Vec<RawNode>,
    pub elements: Vec<Element>,
    pub connectivity: Vec<u64>,
    pub node_sets: Sets,
    pub element_sets: Sets,
    pub nodes_of: Vec<NodesOf>,
    pub surfaces: Vec<SurfaceLine>,
    pub unread: Vec<UnreadElements>,
}

/// Numbers that copies of parts may hold for each byte of the file: far more than an assembly of many instances of a small part needs.
const COPIES_PER_BYTE: usize = 16;

impl Scope {
    /// Nothing yet, in a file of this many bytes.
    pub(super) fn for_file(bytes: usize) -> Self {
        Self {
            nodes: Vec::new(),
            elements: Vec::new(),
            connectivity: Vec::new(),
            node_sets: Sets::for_file(bytes),
            element_sets: Sets::for_file(bytes),
            nodes_of: Vec::new(),
            surfaces: Vec::new(),
            unread: Vec::new(),
        }
    }

    /// Nodes of an element.
    pub(super) fn nodes_of(&self, element: usize) -> &[u64] {
        let Element { shape, first, .. } = self.elements[element];
        &self.connectivity[first..first + shape.nodes()]
    }

    /// Adds a copy of a part that an instance places.
    pub(super) fn add(
        &mut self,
        part: &Self,
        number: u64,
        instance: &str,
        placement: &Placement,
        keyword: &Keyword,
        bytes: usize,
    ) -> Result<(), MeshError> {
        let within = |tag: u64| numbers::within(number, tag);
        let held = 4 * (self.nodes.len() + part.nodes.len()) + self.connectivity.len();
        if held + part.connectivity.len() > COPIES_PER_BYTE * bytes {
            return Err(keyword.unsupported("instances of parts grow beyond all measure of the file"));
        }
        self.nodes.extend(part.nodes.iter().map(|n| RawNode { tag: within(n.tag), x: placement.apply(n.x) }));
        let first = self.connectivity.len();
        self.connectivity.extend(part.connectivity.iter().copied().map(within));
        let moved = |e: &Element| Element { tag: within(e.tag), first: first + e.first, ..*e };
        self.elements.extend(part.elements.iter().map(moved));
        self.node_sets.copy(&part.node_sets, number, instance, keyword)?;
        self.element_sets.copy(&part.element_sets, number, instance, keyword)?;
        let named = |name: &Name| Name { instance: Some(instance.to_string()), ..name.clone() };
        self.nodes_of.extend(part.nodes_of.iter().map(|of| NodesOf {
            name: named(&of.name),
            set: format!("{instance}.{}", of.set),
            keyword: Rc::clone(&of.keyword),
        }));
        self.surfaces.extend(part.surfaces.iter().map(|line| SurfaceLine {
            name: named(&line.name),
            of: match &line.of {
                ElementOrSet::Element(tag) => ElementOrSet::Element(within(*tag)),
                ElementOrSet::Set(set) => ElementOrSet::Set(format!("{instance}.{set}")),
            },
            ..line.clone()
        }));
        self.unread.extend(part.unread.iter().map(|unread| UnreadElements {
            tags: unread.tags.iter().copied().map(within).collect(),
            ..unread.clone()
        }));
        Ok(())
    }
}
