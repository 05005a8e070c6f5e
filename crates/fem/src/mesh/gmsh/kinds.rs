//! Element types, and Gmsh's order of nodes in terms of VTK's.

use super::scan::Scan;
use crate::element::ElementKind;
use crate::mesh::error::{MeshError, Place};
use crate::mesh::raw::{Shape, UnreadElements};
use std::collections::BTreeMap;

/// A type of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// One that is read.
    Read(Shape),
    /// One that is known and not read.
    Unread(UnreadKind),
}

/// A type that is not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct UnreadKind {
    number: i64,
    dimension: usize,
    nodes: usize,
    name: &'static str,
}

/// Types that are not read (Gmsh reference manual, "Low order elements" and "High-order elements").
const OTHERS: [UnreadKind; 21] = [
    other(7, 3, 5, "pyramid"),
    other(13, 3, 18, "wedge"),
    other(14, 3, 14, "pyramid"),
    other(19, 3, 13, "pyramid"),
    other(20, 2, 9, "triangle"),
    other(21, 2, 10, "triangle"),
    other(22, 2, 12, "triangle"),
    other(23, 2, 15, "triangle"),
    other(24, 2, 15, "incomplete triangle"),
    other(25, 2, 21, "triangle"),
    other(26, 1, 4, "line"),
    other(27, 1, 5, "line"),
    other(28, 1, 6, "line"),
    other(29, 3, 20, "tetrahedron"),
    other(30, 3, 35, "tetrahedron"),
    other(31, 3, 56, "tetrahedron"),
    other(36, 2, 16, "quadrilateral"),
    other(37, 2, 25, "quadrilateral"),
    other(38, 2, 36, "quadrilateral"),
    other(92, 3, 64, "hexahedron"),
    other(93, 3, 125, "hexahedron"),
];

const fn other(number: i64, dimension: usize, nodes: usize, name: &'static str) -> UnreadKind {
    UnreadKind { number, dimension, nodes, name }
}

impl UnreadKind {
    fn name(self) -> String {
        format!("{} ({} of {} nodes)", self.number, self.name, self.nodes)
    }
}

impl Kind {
    /// The type of a number; `None` for one without meaning.
    pub(super) fn from_number(number: i64) -> Option<Self> {
        let shape = match number {
            1 => Some(Shape::Line2),
            8 => Some(Shape::Line3),
            15 => Some(Shape::Point),
            _ => ElementKind::ALL.into_iter().find(|e| e.definition().gmsh.names == number).map(Shape::Cell),
        };
        let other = || OTHERS.into_iter().find(|o| o.number == number).map(Self::Unread);
        shape.map(Self::Read).or_else(other)
    }

    /// Number of nodes.
    pub(super) fn nodes(self) -> usize {
        match self {
            Self::Read(shape) => shape.nodes(),
            Self::Unread(other) => other.nodes,
        }
    }

    /// Dimension of the element.
    pub(super) fn dimension(self) -> usize {
        match self {
            Self::Read(shape) => shape.dimension(),
            Self::Unread(other) => other.dimension,
        }
    }

    /// Reorders the nodes of an element to the order of VTK. Both list the mid-nodes by edges, but with the edges in different
    /// orders; the tests compare them with the midpoints.
    pub(super) fn reorder(self, nodes: &mut [u64]) {
        if let Self::Read(shape) = self {
            let order = shape.element().map_or(&[][..], |element| element.definition().gmsh.order);
            shape.reorder(order, nodes);
        }
    }
}

/// Refusal of an element whose type has no meaning.
pub(super) fn unknown(scan: &Scan<'_>, at: usize, element: u64, number: i64) -> MeshError {
    let (section, place) = (scan.section_name(), scan.place_of(at));
    let kind = format!("{number} (no type of Gmsh that is known here)");
    MeshError::UnsupportedElement { section, place, element, kind }
}

/// First place of each type that is not read.
#[derive(Default)]
pub(super) struct Places(BTreeMap<UnreadKind, (String, Place)>);

impl Places {
    /// Notes where an element of this type stands.
    pub(super) fn note(&mut self, scan: &Scan<'_>, at: usize, kind: Kind) {
        if let Kind::Unread(other) = kind {
            self.0.entry(other).or_insert_with(|| (scan.section_name(), scan.place_of(at)));
        }
    }

    /// Elements that are not read, with their numbers and the positions of their groups in the file.
    pub(super) fn unread(
        &self,
        kind: UnreadKind,
        tags: &[u64],
        numbered: Vec<usize>,
    ) -> Option<UnreadElements> {
        let (section, place) = self.0.get(&kind)?.clone();
        Some(UnreadElements {
            kind: kind.name(),
            dimension: Some(kind.dimension),
            section,
            place,
            count: tags.len(),
            first: tags.iter().copied().min()?,
            groups: BTreeMap::new(),
            numbered,
        })
    }
}
