//! Names of groups.

use super::{Options, RawGroup, RawMesh};
use crate::mesh::error::{GroupName, MeshError};
use std::collections::BTreeSet;

impl RawGroup {
    /// Name, or number if there is none.
    fn own_name(&self) -> String {
        self.name.clone().unwrap_or_else(|| self.tag.unwrap_or(0).to_string())
    }

    /// Number by which options refer to the group: N of `material-id:N`, otherwise that of the file.
    fn number(&self) -> Option<i64> {
        let dialect = self.name.as_ref().and_then(|n| n.strip_prefix("material-id:"));
        dialect.and_then(|n| n.trim().parse().ok()).or(self.tag)
    }
}

impl RawMesh {
    /// All names of each group.
    ///
    /// # Errors
    /// [`MeshError::MissingTag`] if a number in the options belongs to no group with elements.
    pub(in crate::mesh) fn group_names(&self, options: &Options) -> Result<Vec<Vec<String>>, MeshError> {
        let used = self.used_groups();
        let mut names: Vec<Vec<String>> = self.groups.iter().map(|g| vec![g.own_name()]).collect();
        for (name, wanted) in &options.tags {
            let mut found = false;
            for &g in &used {
                let group = &self.groups[g];
                if group.number() == Some(wanted.tag) && wanted.dimension.is_none_or(|d| d == group.dimension)
                {
                    names[g].push(name.clone());
                    found = true;
                }
            }
            if !found {
                let present: BTreeSet<i64> = used.iter().filter_map(|&g| self.groups[g].number()).collect();
                return Err(MeshError::MissingTag {
                    name: name.clone(),
                    tag: wanted.tag,
                    present: present.into_iter().collect(),
                });
            }
        }
        Ok(names)
    }

    /// Groups with elements.
    fn used_groups(&self) -> BTreeSet<usize> {
        let read = self.blocks.iter().filter(|b| !b.tags.is_empty()).flat_map(|b| &b.groups);
        read.chain(self.unread.iter().flat_map(|u| &u.numbered)).copied().collect()
    }

    /// All named items in the file.
    #[must_use]
    pub fn present(&self) -> Vec<GroupName> {
        let dimension = self.dimension();
        let groups = self
            .used_groups()
            .into_iter()
            .map(|g| GroupName { dimension: self.groups[g].dimension, name: self.groups[g].own_name() });
        let surfaces = self
            .surfaces
            .keys()
            .map(|name| GroupName { dimension: dimension.saturating_sub(1), name: name.clone() });
        let nodes = self.node_sets.keys().map(|name| GroupName { dimension: 0, name: name.clone() });
        let all: BTreeSet<GroupName> = groups.chain(surfaces).chain(nodes).collect();
        all.into_iter().rev().collect()
    }
}
