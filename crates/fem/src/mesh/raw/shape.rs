//! Shapes of elements as mesh files carry them: cells, their faces, and lines and points besides.

use crate::element::ElementKind;

/// Most nodes of a shape.
const MOST_NODES: usize = 27;

/// Shape of an element of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shape {
    /// A node.
    Point,
    /// Line of 2 nodes.
    Line2,
    /// Line of 3 nodes: ends, middle.
    Line3,
    /// Triangle of 3 nodes.
    Tri3,
    /// Triangle of 6 nodes.
    Tri6,
    /// Quadrilateral of 4 nodes.
    Quad4,
    /// Quadrilateral of 8 nodes.
    Quad8,
    /// Quadrilateral of 9 nodes.
    Quad9,
    /// Tetrahedron of 4 nodes.
    Tet4,
    /// Tetrahedron of 10 nodes.
    Tet10,
    /// Hexahedron of 8 nodes.
    Hex8,
    /// Hexahedron of 20 nodes.
    Hex20,
    /// Hexahedron of 27 nodes.
    Hex27,
    /// Wedge (prism) of 6 nodes.
    Wedge6,
    /// Wedge (prism) of 15 nodes.
    Wedge15,
}

impl Shape {
    /// All of them.
    pub const ALL: [Self; 15] = [
        Self::Point,
        Self::Line2,
        Self::Line3,
        Self::Tri3,
        Self::Tri6,
        Self::Quad4,
        Self::Quad8,
        Self::Quad9,
        Self::Tet4,
        Self::Tet10,
        Self::Hex8,
        Self::Hex20,
        Self::Hex27,
        Self::Wedge6,
        Self::Wedge15,
    ];

    /// Name; where an element of this shape exists, its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.table().0
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        self.table().1
    }

    /// Number of corners: the first nodes.
    #[must_use]
    pub fn corners(self) -> usize {
        self.table().2
    }

    /// Dimension of the shape.
    #[must_use]
    pub fn dimension(self) -> usize {
        self.table().3
    }

    /// The element of this shape, where one exists.
    #[must_use]
    pub fn element(self) -> Option<ElementKind> {
        ElementKind::ALL.into_iter().find(|k| k.name() == self.name())
    }

    /// Shape of an element.
    #[must_use]
    pub fn of(kind: ElementKind) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name() == kind.name())
    }

    /// The order of nodes that turns a plane shape over: the same corners, run through in the other sense.
    #[must_use]
    pub fn reversed(self) -> &'static [usize] {
        match self {
            Self::Tri3 => &[0, 2, 1],
            Self::Tri6 => &[0, 2, 1, 5, 4, 3],
            Self::Quad4 => &[0, 3, 2, 1],
            Self::Quad8 => &[0, 3, 2, 1, 7, 6, 5, 4],
            Self::Quad9 => &[0, 3, 2, 1, 7, 6, 5, 4, 8],
            _ => &[],
        }
    }

    /// Puts the nodes of an element into another order: `order` gives for each its place in the old one, and is empty where
    /// nothing changes.
    pub(crate) fn reorder(self, order: &[usize], nodes: &mut [u64]) {
        let mut old = [0; MOST_NODES];
        let old = &mut old[..self.nodes()];
        old.copy_from_slice(nodes);
        for (node, &from) in nodes.iter_mut().zip(order) {
            *node = old[from];
        }
    }

    /// Name, nodes, corners, dimension.
    fn table(self) -> (&'static str, usize, usize, usize) {
        match self {
            Self::Point => ("point", 1, 1, 0),
            Self::Line2 => ("line2", 2, 2, 1),
            Self::Line3 => ("line3", 3, 2, 1),
            Self::Tri3 => ("tri3", 3, 3, 2),
            Self::Tri6 => ("tri6", 6, 3, 2),
            Self::Quad4 => ("quad4", 4, 4, 2),
            Self::Quad8 => ("quad8", 8, 4, 2),
            Self::Quad9 => ("quad9", 9, 4, 2),
            Self::Tet4 => ("tet4", 4, 4, 3),
            Self::Tet10 => ("tet10", 10, 4, 3),
            Self::Hex8 => ("hex8", 8, 8, 3),
            Self::Hex20 => ("hex20", 20, 8, 3),
            Self::Hex27 => ("hex27", 27, 8, 3),
            Self::Wedge6 => ("wedge6", 6, 6, 3),
            Self::Wedge15 => ("wedge15", 15, 6, 3),
        }
    }
}
