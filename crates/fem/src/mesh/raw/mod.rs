//! Data of a mesh file before it becomes a mesh: nodes, elements of every dimension and groups, by the numbers of the file.

mod build;
mod groups;
mod omitted_elements;
mod options;
mod shape;
mod sides;

pub use omitted_elements::UnreadElements;
pub use options::{GroupTag, Options};
pub use shape::Shape;

use std::collections::BTreeMap;

/// A node of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawNode {
    /// Number.
    pub tag: u64,
    /// Position in the unit of the file.
    pub x: [f64; 3],
}

/// Elements of one shape in the same groups.
#[derive(Clone, Debug, PartialEq)]
pub struct RawBlock {
    /// Shape.
    pub shape: Shape,
    /// Groups, as indices into [`RawMesh::groups`], ascending.
    pub groups: Vec<usize>,
    /// The geometric entity that they discretise, if the format has entities; its orientation is that of all its elements.
    pub entity: Option<i64>,
    /// Numbers of the elements.
    pub tags: Vec<u64>,
    /// Numbers of the nodes of all elements, one element after another, in the order of VTK.
    pub nodes: Vec<u64>,
}

impl RawBlock {
    /// Nodes of one element.
    #[must_use]
    pub fn element(&self, element: usize) -> &[u64] {
        let n = self.shape.nodes();
        &self.nodes[element * n..(element + 1) * n]
    }
}

/// A group of elements of one dimension.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RawGroup {
    /// Dimension of its elements.
    pub dimension: usize,
    /// Number, if the format has one.
    pub tag: Option<i64>,
    /// Name, if it has one.
    pub name: Option<String>,
}

/// A face of an element, identified by the element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RawSide {
    /// Number of the element.
    pub element: u64,
    /// Numbers of the corners of the face.
    pub corners: Vec<u64>,
}

/// Data of a mesh file. Only the syntax has been checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawMesh {
    /// Nodes in the order of the file.
    pub nodes: Vec<RawNode>,
    /// Elements of all dimensions.
    pub blocks: Vec<RawBlock>,
    /// Groups of elements.
    pub groups: Vec<RawGroup>,
    /// Named faces of elements.
    pub surfaces: BTreeMap<String, Vec<RawSide>>,
    /// Named nodes.
    pub node_sets: BTreeMap<String, Vec<u64>>,
    /// True if an element in several groups is written once for each of them, under different numbers.
    pub repeats: bool,
    /// Elements of types that are not read.
    pub unread: Vec<UnreadElements>,
    /// Further names of sets: `instance.set`, and the name of the set.
    pub aliases: BTreeMap<String, String>,
    /// First numbers of instances but the first, for files that count each instance from one.
    pub origins: Vec<(u64, String)>,
}

impl RawMesh {
    /// Greatest dimension of the elements, of those that are not read, too.
    #[must_use]
    pub fn dimension(&self) -> usize {
        let read = self.blocks.iter().filter(|b| !b.tags.is_empty()).map(|b| b.shape.dimension());
        let unread = self.unread.iter().filter(|u| u.count > 0).filter_map(|u| u.dimension);
        read.chain(unread).max().unwrap_or(0)
    }
}
