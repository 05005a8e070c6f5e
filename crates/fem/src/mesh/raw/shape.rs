//! Shapes of elements in mesh files: cells, their faces, and also lines and points.

use crate::element::{ElementKind, MOST_NODES};

/// Shape of an element of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shape {
    /// A node.
    Point,
    /// Line of 2 nodes.
    Line2,
    /// Line of 3 nodes: ends, middle.
    Line3,
    /// Shape of an element: a cell, or the face of one.
    Cell(ElementKind),
}

impl Shape {
    /// Name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Line2 => "line2",
            Self::Line3 => "line3",
            Self::Cell(kind) => kind.name(),
        }
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        match self {
            Self::Point => 1,
            Self::Line2 => 2,
            Self::Line3 => 3,
            Self::Cell(kind) => kind.nodes(),
        }
    }

    /// Number of corners: the first nodes.
    #[must_use]
    pub fn corners(self) -> usize {
        match self {
            Self::Point => 1,
            Self::Line2 | Self::Line3 => 2,
            Self::Cell(kind) => kind.corners(),
        }
    }

    /// Dimension of the shape.
    #[must_use]
    pub fn dimension(self) -> usize {
        match self {
            Self::Point => 0,
            Self::Line2 | Self::Line3 => 1,
            Self::Cell(kind) => kind.dimension(),
        }
    }

    /// The element of this shape, if there is one.
    #[must_use]
    pub fn element(self) -> Option<ElementKind> {
        match self {
            Self::Cell(kind) => Some(kind),
            Self::Point | Self::Line2 | Self::Line3 => None,
        }
    }

    /// The order of nodes that reverses a plane shape: the same corners, traversed in the other direction.
    #[must_use]
    pub fn reversed(self) -> &'static [usize] {
        self.element().map_or(&[], |element| element.definition().reversed)
    }

    /// Reorders the nodes of an element: `order` gives for each its position in the old order, and is empty for no change.
    pub(crate) fn reorder(self, order: &[usize], nodes: &mut [u64]) {
        let mut old = [0; MOST_NODES];
        let old = &mut old[..self.nodes()];
        old.copy_from_slice(nodes);
        for (node, &from) in nodes.iter_mut().zip(order) {
            *node = old[from];
        }
    }
}
