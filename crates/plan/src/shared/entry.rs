//! Entries of the tables of a scene.

use std::collections::BTreeMap;

/// An entry of a table of the scene with its name, such as a fault or an interface.
#[derive(Debug)]
pub struct Entry<'s, T> {
    /// Name in the scene.
    pub name: &'s str,
    /// Table of keys.
    pub spec: &'s T,
}

impl<T> Clone for Entry<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Entry<'_, T> {}

impl<'s, T> Entry<'s, T> {
    /// Entry with this name.
    pub const fn new(name: &'s str, spec: &'s T) -> Self {
        Self { name, spec }
    }

    /// All entries of a table, in the order of their names.
    pub fn all(table: &'s BTreeMap<String, T>) -> Vec<Self> {
        table.iter().map(|(name, spec)| Self { name, spec }).collect()
    }
}
