//! Elements of a file that do not belong to its mesh.

use super::options::Options;
use crate::mesh::error::{MeshError, Place};
use crate::mesh::{LeftOut, Mesh};
use std::collections::BTreeMap;

/// Elements of a type that is not read.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    /// Type, as the format names it.
    pub kind: String,
    /// True if bodies are made of this type, so that a body without them has a hole.
    pub body: bool,
    /// Section or keyword.
    pub section: String,
    /// Position.
    pub place: Place,
    /// Number of elements.
    pub count: usize,
    /// The least of their numbers.
    pub first: u64,
    /// Elements in each set that has some.
    pub groups: BTreeMap<String, Vec<u64>>,
}

impl Unread {
    /// True if the body asks for these elements, by a set or since it takes all cells.
    fn is_asked(&self, options: &Options) -> bool {
        let is = |set: &String, asked: &String| {
            set == asked || set.strip_suffix(asked.as_str()).is_some_and(|instance| instance.ends_with('.'))
        };
        match &options.only {
            None => true,
            Some(asked) => asked.iter().any(|asked| self.groups.keys().any(|set| is(set, asked))),
        }
    }

    /// Refuses elements of bodies that are asked for; takes note of others.
    pub(super) fn leave_out<const D: usize>(
        &self,
        mesh: &mut Mesh<D>,
        options: &Options,
    ) -> Result<(), MeshError> {
        if self.count == 0 {
            return Ok(());
        }
        if self.body && self.is_asked(options) {
            return Err(MeshError::UnsupportedKind {
                section: self.section.clone(),
                place: self.place,
                kind: self.kind.clone(),
            });
        }
        let left = |elements: &[u64]| LeftOut {
            kind: self.kind.clone(),
            count: elements.len(),
            element: elements.iter().copied().min().unwrap_or(self.first),
            read: false,
        };
        for (set, elements) in &self.groups {
            mesh.left_out.insert(set.clone(), left(elements));
        }
        if self.groups.is_empty() {
            let all = LeftOut { count: self.count, ..left(&[]) };
            mesh.left_out.insert(format!("{} (in no set)", self.kind), all);
        }
        Ok(())
    }
}
