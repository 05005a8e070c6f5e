//! The table of evolution laws, which scenes, the book, the factory and the acceptance tests read.

use super::definition::{Definition, TableEvolution};
use crate::each_evolution;

/// An operation on the type of an evolution.
pub trait Visit {
    /// Result of the operation.
    type Product;

    /// Visits the type.
    fn visit<E: TableEvolution + 'static>(self) -> Self::Product;
}

/// Rows of the table.
#[must_use]
pub fn definitions() -> Vec<&'static Definition> {
    let mut rows = Vec::new();
    each_evolution!(Law => rows.push(&<Law as TableEvolution>::DEFINITION));
    rows
}

/// Row of this name.
#[must_use]
pub fn definition(name: &str) -> Option<&'static Definition> {
    definitions().into_iter().find(|row| row.name == name)
}

/// Visits the type of this name; `None` if the table has no such name.
pub fn with<V: Visit>(name: &str, visit: V) -> Option<V::Product> {
    each_evolution!(Law => {
        if <Law as TableEvolution>::DEFINITION.name == name {
            return Some(visit.visit::<Law>());
        }
    });
    None
}
