//! Options of the reader of a mesh file.

use crate::mesh::MeshError;
use std::collections::BTreeMap;

/// The number of a group, for files that identify their groups by numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GroupTag {
    /// Number of the physical group, or N of a group named `material-id:N`.
    pub tag: i64,
    /// Dimension of the group; if `None`, the name applies to the groups of this number on every dimension.
    pub dimension: Option<usize>,
}

impl From<i64> for GroupTag {
    fn from(tag: i64) -> Self {
        Self { tag, dimension: None }
    }
}

/// Options for making a mesh from the data of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Length of the file's unit \[m\]: 1000 for a mesh in kilometres.
    pub length_unit: f64,
    /// Names given to groups by their numbers, in addition to the names of the file.
    pub tags: BTreeMap<String, GroupTag>,
    /// Groups that must exist, of cells, faces or nodes.
    pub required: Vec<String>,
    /// True if a part may touch another without being tied to it and without a named face there. Otherwise such a part is an
    /// error ([`MeshError::FreePart`]).
    pub allow_free_parts: bool,
    /// Groups of cells that are asked for; all cells if `None`. The other cells need not be admissible.
    pub only: Option<Vec<String>>,
    /// True if elements of groups that belong to no cell are left out ([`Mesh::left_out`](crate::mesh::Mesh::left_out)).
    /// Otherwise they are an error ([`MeshError::Orphan`]).
    pub leave_out: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            length_unit: 1.0,
            tags: BTreeMap::new(),
            required: Vec::new(),
            allow_free_parts: false,
            only: None,
            leave_out: false,
        }
    }
}

impl Options {
    /// Adds required groups.
    #[must_use]
    pub fn requiring<'a>(mut self, names: impl IntoIterator<Item = &'a str>) -> Self {
        self.required.extend(names.into_iter().map(str::to_string));
        self
    }

    pub(in crate::mesh) fn check(&self) -> Result<(), MeshError> {
        if self.length_unit.is_finite() && self.length_unit > 0.0 {
            Ok(())
        } else {
            Err(MeshError::LengthUnit { metres: self.length_unit })
        }
    }
}
