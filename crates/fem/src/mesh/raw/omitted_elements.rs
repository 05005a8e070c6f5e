//! Elements of a file that do not belong to its mesh.

use super::options::Options;
use crate::mesh::error::{MeshError, Place};
use crate::mesh::{Mesh, OmittedElements};
use std::collections::BTreeMap;

/// Elements of a type that is not read.
#[derive(Clone, Debug, PartialEq)]
pub struct UnreadElements {
    /// Type, as the format names it.
    pub kind: String,
    /// Dimension, if it is known: bodies are made of elements of the greatest, so that a body without them has a hole.
    pub dimension: Option<usize>,
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
    /// Groups of the file, by position, that have all of them.
    pub numbered: Vec<usize>,
}

impl UnreadElements {
    /// Names of the sets that have some of these elements.
    fn sets<'a>(&'a self, names: &'a [Vec<String>]) -> impl Iterator<Item = &'a String> {
        self.groups.keys().chain(self.numbered.iter().flat_map(|&g| &names[g]))
    }

    /// True if the body asks for these elements, by a set or since it takes all cells.
    fn is_asked(&self, names: &[Vec<String>], options: &Options) -> bool {
        let is = |set: &String, asked: &String| {
            set == asked || set.strip_suffix(asked.as_str()).is_some_and(|instance| instance.ends_with('.'))
        };
        match &options.only {
            None => true,
            Some(asked) => asked.iter().any(|asked| self.sets(names).any(|set| is(set, asked))),
        }
    }

    /// Refuses elements of the dimension of bodies that are asked for. The groups of the file have these `names`.
    pub(super) fn check(
        &self,
        dimension: usize,
        names: &[Vec<String>],
        options: &Options,
    ) -> Result<(), MeshError> {
        let in_body = self.count > 0 && self.dimension.is_some_and(|d| d >= dimension);
        if !in_body || !self.is_asked(names, options) {
            return Ok(());
        }
        let (section, place, kind) = (self.section.clone(), self.place, self.kind.clone());
        Err(MeshError::UnsupportedKind { section, place, kind })
    }

    /// Takes note of elements that no body has.
    pub(super) fn leave_out<const D: usize>(&self, mesh: &mut Mesh<D>, names: &[Vec<String>]) {
        let mut note = |set: String, count: usize, element: u64| {
            let new = OmittedElements { kind: self.kind.clone(), count, element, read: false };
            let all = mesh.left_out.entry(set).or_insert_with(|| OmittedElements { count: 0, ..new.clone() });
            all.count += new.count;
            all.element = all.element.min(new.element);
        };
        for (set, elements) in &self.groups {
            note(set.clone(), elements.len(), elements.iter().copied().min().unwrap_or(self.first));
        }
        for set in self.numbered.iter().flat_map(|&g| &names[g]) {
            note(set.clone(), self.count, self.first);
        }
        if self.count > 0 && self.sets(names).next().is_none() {
            note(format!("{} (in no set)", self.kind), self.count, self.first);
        }
    }
}
